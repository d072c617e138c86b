#include "studies/scale/axis.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

#include "shared/base/quantile.h"

namespace scree {

namespace {

std::string law_text(const Curve& curve) {
  const auto law = curve.law();
  return law ? exponent_text(*law) : "–";
}

std::string end_text(const Curve& curve) {
  const auto law = curve.law_at_end();
  return law ? fmt::format("{:.2f}", law->exponent) : "–";
}

ReportTable laws_table(const Axis& axis) {
  ReportTable table{axis.title + ": exponents",
                    {"curve", "measure", "exponent, all sizes", "exponent, last three sizes", "smallest size",
                     "largest size"},
                    {}};
  for (const Curve& curve : axis.curves) {
    const auto points = curve.points();
    if (points.empty()) continue;
    table.rows.push_back({curve.name(), curve.measure(), law_text(curve), end_text(curve),
                          figure(points.front().value), figure(points.back().value)});
  }
  return table;
}

ReportTable points_table(const Axis& axis) {
  std::map<double, std::map<std::string, double>> by_size;
  ReportTable table{axis.title + ": what was measured", {axis.x_label}, {}};
  for (const Curve& curve : axis.curves) {
    table.header.push_back(curve.name() + ": " + curve.measure());
    for (const ScalePoint& point : curve.points()) by_size[point.size][curve.name()] = point.value;
  }
  for (const auto& [size, values] : by_size) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row.push_back(size_text(size));
    for (const Curve& curve : axis.curves) {
      const auto found = values.find(curve.name());
      row.push_back(found == values.end() ? "–" : figure(found->second));
    }
  }
  return table;
}

std::vector<std::pair<double, double>> pairs_of(const std::vector<ScalePoint>& points) {
  std::vector<std::pair<double, double>> pairs;
  for (const ScalePoint& point : points) pairs.emplace_back(point.size, point.value);
  return pairs;
}

/// "ms" of "processor time, ms": as names of metrics end.
std::string unit_of(const std::string& measure) {
  const size_t comma = measure.rfind(", ");
  return metric_name(comma == std::string::npos ? measure : measure.substr(comma + 2));
}

constexpr size_t few_curves = 3;  ///< whose laws have lines of their own: more would be a tangle

std::string legend_of(const Curve& curve) {
  const auto law = curve.law();
  return curve.name() + (law ? ": exponent " + exponent_text(*law) : "");
}

/// Its points, and its law as a line, or without `with_law` a line from point to point.
void add_series(Plot& plot, const Curve& curve, bool with_law) {
  const auto points = curve.points();
  std::vector<double> spreads = curve.spreads();
  if (std::ranges::all_of(spreads, [](double spread) { return spread == 0.0; })) spreads.clear();
  const auto law = curve.law();
  plot.series.push_back({with_law ? curve.name() : legend_of(curve),
                         with_law ? SeriesStyle::points : SeriesStyle::line_and_points, pairs_of(points),
                         std::move(spreads)});
  if (!with_law || !law) return;
  const double first = points.front().size, last = points.back().size;
  plot.series.push_back(
      {legend_of(curve), SeriesStyle::fit, {{first, law->at(first)}, {last, law->at(last)}}});
}

std::vector<Plot> plots_of(const Axis& axis) {
  std::vector<Plot> plots;
  const auto drawn = [](const Curve& curve) { return curve.points().size() > 1; };
  for (const Curve& curve : axis.curves) {
    if (!drawn(curve)) continue;
    auto plot = std::ranges::find(plots, curve.measure(), &Plot::y_label);
    if (plot == plots.end()) {
      Plot made;
      made.name = axis.name + (plots.empty() ? "" : fmt::format("-{}", plots.size() + 1));
      made.title = axis.title + ": " + curve.measure();
      made.x_label = axis.x_label;
      made.y_label = curve.measure();
      made.log_x = made.log_y = true;
      plot = plots.insert(plots.end(), std::move(made));
    }
    const auto together = static_cast<size_t>(std::ranges::count_if(
        axis.curves, [&](const Curve& other) { return drawn(other) && other.measure() == curve.measure(); }));
    add_series(*plot, curve, together <= few_curves);
  }
  return plots;
}

}  // namespace

std::vector<ScalePoint> Curve::points() const {
  std::vector<ScalePoint> points;
  for (const auto& [size, values] : values_)
    points.push_back({size, quantile(values, typical_ == Typical::median ? 0.5 : 0.0)});
  return points;
}

std::vector<double> Curve::spreads() const {
  std::vector<double> spreads;
  if (typical_ == Typical::least) return spreads;
  for (const auto& [size, values] : values_) {
    const auto [least, most] = std::ranges::minmax(values);
    spreads.push_back(0.5 * (most - least));
  }
  return spreads;
}

std::optional<PowerLaw> Curve::law_at_end() const {
  std::vector<ScalePoint> all = points();
  const auto law = fit_power_law(all);
  if (law && law->exponent < 0.0) std::ranges::reverse(all);
  return fit_power_law(std::span(all).last(std::min<size_t>(3, all.size())));
}

Curve& Axis::curve(const std::string& curve_name, const std::string& measure, Typical typical) {
  const auto found = std::ranges::find(curves, curve_name, &Curve::name);
  return found != curves.end() ? *found : curves.emplace_back(curve_name, measure, typical);
}

std::vector<Wall> walls_of(const Axis& axis) {
  std::vector<Wall> walls;
  for (const Curve& curve : axis.curves)
    if (curve.limit())
      walls.push_back({axis.title, curve.name(), curve.limit()->name, axis.x_unit,
                       crossing(curve.points(), curve.limit()->value)});
  return walls;
}

ReportSection section_of(const Axis& axis) {
  ReportSection section{axis.title, axis.text, {laws_table(axis), points_table(axis)}, plots_of(axis)};
  section.tables.insert(section.tables.end(), axis.tables.begin(), axis.tables.end());
  return section;
}

void add_figures(const Axis& axis, BenchReport& figures) {
  for (const Curve& curve : axis.curves) {
    const std::string name = metric_name(axis.name + " " + curve.name());
    for (const ScalePoint& point : curve.points())
      figures.metric(
          fmt::format("{}_{}_at_{}", name, unit_of(curve.measure()), metric_name(size_text(point.size))),
          point.value);
    const auto law = curve.law();
    if (law) {
      figures.metric(name + "_exponent", law->exponent);
      if (std::isfinite(law->within)) figures.metric(name + "_exponent_within", law->within);
    }
    if (curve.flat())
      figures.check(name + "_exponent", law && law->exponent <= *curve.flat(),
                    fmt::format("{}, wanted at most {}", law_text(curve), *curve.flat()));
  }
  for (const Check& check : axis.checks) figures.checks.push_back(check);
}

std::string exponent_text(const PowerLaw& law) {
  return std::isfinite(law.within) ? fmt::format("{:.3f} ± {:.3f}", law.exponent, law.within)
                                   : fmt::format("{:.3f}", law.exponent);
}

std::string size_text(double size) {
  return fmt::format("{:.6g}", size);
}

std::string metric_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0)
      name += static_cast<char>(std::tolower(byte));
    else if (c != ',' && !name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

}  // namespace scree
