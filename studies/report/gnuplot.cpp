#include "studies/report/gnuplot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>
#include <span>

#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "studies/report/axis_ticks.h"
#include "studies/report/event_style.h"
#include "studies/report/inline_text.h"
#include "tools/film/process/child_process.h"

namespace scree {
namespace {

constexpr int width_px = 900;
constexpr int height_px = 460;
constexpr double gnuplot_s_max = 60.0;
constexpr int gnuplot_pause_ms = 20;

/// The colours of Okabe and Ito: people with any kind of colour vision tell them apart, on white.
constexpr std::array<std::string_view, 7> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#000000"};
/// gnuplot's numbers of filled marks: disc, square, triangle, diamond, …
constexpr std::array<int, 5> marks = {7, 5, 9, 13, 11};

/// In single quotes, gnuplot interprets nothing but two of them.
std::string script_string(std::string_view text) {
  std::string out = "'";
  for (const char c : one_line(text)) out.append(c == '\'' ? 2 : 1, c);
  return out + "'";
}

struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (!std::isfinite(value)) return;
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  bool empty() const { return lo > hi; }
};

Range x_of(const Plot& plot) {
  Range range;
  for (const PlotSeries& series : plot.series)
    for (const auto& [x, y] : series.points)
      if (!plot.log_x || x > 0.0) range.include(x);
  for (const PlotEvent& event : plot.events) range.include(event.x);
  return range;
}

/// With some room beside the first and the last point.
Range padded(Range range, bool log) {
  if (range.empty()) return {0.0, 1.0};
  if (log) {
    const double ratio = std::max(std::pow(range.hi / range.lo, 0.03), 1.02);
    return {range.lo / ratio, range.hi * ratio};
  }
  const double room = range.hi > range.lo ? 0.02 * (range.hi - range.lo) : 0.5;
  return {range.lo - room, range.hi + room};
}

bool has_bars(const Plot& plot) {
  return std::ranges::any_of(plot.series, [](const PlotSeries& s) { return s.style == SeriesStyle::bars; });
}

std::string ticks_script(char axis, const std::vector<double>& places) {
  std::string list;
  for (const double at : places)
    list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", at);  // a float's last digits are none
  return fmt::format("set {}tics ({})\n", axis, list);
}

/// An axis of logarithms gets round ends, and its own labels: in a range of less than two powers of ten
/// gnuplot names one or none.
std::string range_of_y(const Plot& plot) {
  Range y;
  for (const PlotSeries& series : plot.series)
    for (size_t i = 0; i < series.points.size(); ++i) {
      const double spread = i < series.spread.size() ? series.spread[i] : 0.0;
      for (const double value : {series.points[i].second - spread, series.points[i].second + spread})
        if (!plot.log_y || value > 0.0) y.include(value);
    }
  if (plot.log_y && !plot.y_range && !y.empty()) {
    const auto [lo, hi] = round_log_range(y.lo, y.hi);
    return fmt::format("set yrange [{}:{}]\n", lo, hi) + ticks_script('y', log_ticks(lo, hi));
  }
  if (plot.y_range) return fmt::format("set yrange [{}:{}]\n", plot.y_range->first, plot.y_range->second);
  return !plot.log_y && y.lo >= 0.0 ? "set yrange [0:*]\n" : "";
}

std::string head(const Plot& plot, const std::string& svg_file, const Range& x) {
  std::string id = plot.name;
  std::ranges::replace(id, '-', '_');
  std::string script = fmt::format(
      "set terminal svg size {},{} dynamic noenhanced background '#ffffff' font 'sans-serif,14' name '{}'\n"
      "set output {}\nset encoding utf8\n"
      "set border 3 lc rgb '#444444'\nset tics nomirror out\nset grid lc rgb "
      "'#d8d8d8' lt 1 lw 0.6\n"
      "set key outside bottom center horizontal Left reverse samplen 2.5 spacing 1.25 font ',13'\n"
      "set format '%.10g'\nset title {} font ',16'\nset xlabel {}.\"\\n\"\nset ylabel {}\n",
      width_px, height_px, id, script_string(svg_file), script_string(plot.title),
      script_string(plot.x_label), script_string(plot.y_label));
  if (plot.log_x) script += "set logscale x\n";
  if (plot.log_y) script += "set logscale y\n";
  script += fmt::format("set xrange [{}:{}] noextend\n", x.lo, x.hi);
  return script + range_of_y(plot);
}

/// On an axis of logarithms, the places that were measured, where they are enough and their labels have room;
/// else round numbers.
std::string measured_places(const Plot& plot, const Range& x) {
  constexpr double least_part = 0.06;  // of the axis, between two labels
  std::set<double> places;
  for (const PlotSeries& series : plot.series)
    for (const auto& [at, value] : series.points)
      if (at > 0.0) places.insert(at);
  if (places.empty()) return {};
  double last = 0.0;
  for (const double at : places) {
    if (last > 0.0 && std::log(at / last) < least_part * std::log(x.hi / x.lo))
      return ticks_script('x', log_ticks(x.lo, x.hi));
    last = at;
  }
  if (places.size() < ticks_least) return ticks_script('x', log_ticks(x.lo, x.hi));
  return ticks_script('x', {places.begin(), places.end()});
}

std::string names_on_x(const Plot& plot, const Range& x) {
  if (plot.x_names.empty()) return plot.log_x ? measured_places(plot, x) : "";
  size_t letters = 0;
  std::string tics;
  for (size_t i = 0; i < plot.x_names.size(); ++i) {
    letters += plot.x_names[i].size() + 2;
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", script_string(plot.x_names[i]), i);
  }
  constexpr size_t letters_side_by_side = 95;
  return fmt::format("set xtics ({}){}\n", tics, letters > letters_side_by_side ? " rotate by -35" : "");
}

/// A row of marks above the data for each kind of event there is, its name beside it, and a pale stripe
/// through the data below each mark.
std::string events(const Plot& plot, const Range& x) {
  if (plot.events.empty()) return {};
  constexpr double row = 0.055;  // of the data's height
  const double half = 0.0018 * (plot.log_x ? std::log(x.hi / x.lo) : x.hi - x.lo);
  const auto left = [&](double at) { return plot.log_x ? at * std::exp(-half) : at - half; };
  const auto right = [&](double at) { return plot.log_x ? at * std::exp(half) : at + half; };
  std::string script;
  int rows = 0;
  for (const PlotEventKind kind :
       {PlotEventKind::recombination, PlotEventKind::method, PlotEventKind::edit, PlotEventKind::physics}) {
    const EventStyle style = style_of(kind);
    const double low = 1.015 + row * rows;
    bool any = false;
    for (const PlotEvent& event : plot.events) {
      if (event.kind != kind) continue;
      any = true;
      script += fmt::format(
          "set object rectangle from first {0},graph 0 to first {1},graph 1 behind fc rgb '{2}' "
          "fs transparent solid 0.18 noborder\n"
          "set object rectangle from first {0},graph {3} to first {1},graph {4} noclip front fc rgb '{2}' "
          "fs solid 1 noborder\n",
          left(event.x), right(event.x), style.colour, low, low + row * 0.8);
    }
    if (!any) continue;
    script += fmt::format(
        "set object rectangle from graph 1.012,graph {0} to graph 1.024,graph {1} noclip front fc rgb '{2}' "
        "fs solid 1 noborder\n"
        "set label '{3}' at graph 1.032,graph {4} left font ',12' front\n",
        low, low + row * 0.8, style.colour, style.name, low + row * 0.4);
    ++rows;
  }
  script +=
      fmt::format("set rmargin 23\nset tmargin {}\nset title offset 0,{}\n", 2.6 + 1.15 * rows, 1.0 * rows);
  return script;
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "NaN";
}

std::string data_of(const Plot& plot) {
  std::string script;
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    script += fmt::format("$data{} << END_OF_DATA\n", i);
    for (size_t j = 0; j < series.points.size(); ++j)
      script += fmt::format("{} {} {}\n", number(series.points[j].first), number(series.points[j].second),
                            j < series.spread.size() ? number(series.spread[j]) : "0");
    script += "END_OF_DATA\n";
  }
  return script;
}

/// How the series of `$data<i>` is drawn, in the look of that number; `bars`: how many series share a place
/// on the x axis, `bar`: which of them this is.
std::string drawing_of(const PlotSeries& series, size_t i, size_t style, size_t bar, size_t bars) {
  const std::string_view colour = colours[style % colours.size()];
  // Series that share a colour differ by their dashes.
  const size_t dashes = style / colours.size() + 1;
  const int mark = marks[style % marks.size()];
  const std::string title = "title " + script_string(series.name);
  const double bar_width = 0.8 / static_cast<double>(std::max<size_t>(bars, 1));
  const double shift = (static_cast<double>(bar) - 0.5 * (static_cast<double>(bars) - 1.0)) * bar_width;
  std::string script;
  switch (series.style) {
    case SeriesStyle::line:
    case SeriesStyle::fit:
      script =
          fmt::format("$data{} using 1:2 with lines lw 1.6 dt {} lc rgb '{}' {}", i, dashes, colour, title);
      break;
    case SeriesStyle::points:
      script =
          fmt::format("$data{} using 1:2 with points pt {} ps 0.6 lc rgb '{}' {}", i, mark, colour, title);
      break;
    case SeriesStyle::line_and_points:
      script = fmt::format("$data{} using 1:2 with linespoints lw 2 dt {} pt {} ps 0.8 lc rgb '{}' {}", i,
                           dashes, mark, colour, title);
      break;
    case SeriesStyle::bars:
      script = fmt::format("$data{} using ($1+{}):2:({}) with boxes fs solid 0.85 noborder lc rgb '{}' {}", i,
                           shift, bar_width * 0.92, colour, title);
      break;
  }
  if (series.spread.empty()) return script;
  const double at = series.style == SeriesStyle::bars ? shift : 0.0;
  return script + fmt::format(
                      ", $data{} using ($1+{}):($2-$3):(0):(2*$3) with vectors heads size graph 0.006,90 "
                      "nofilled lw 1.4 lc rgb '{}' notitle",
                      i, at, series.style == SeriesStyle::bars ? "#222222" : colour);
}

}  // namespace

std::string gnuplot_script(const Plot& plot, const std::string& svg_file) {
  Range x = padded(x_of(plot), plot.log_x);
  if (has_bars(plot) || !plot.x_names.empty())
    x = {-0.6, std::max(x_of(plot).hi, static_cast<double>(plot.x_names.size()) - 1.0) + 0.6};
  std::string script =
      head(plot, svg_file, x) + names_on_x(plot, x) + events(plot, x) + data_of(plot) + "plot ";
  const auto is_bars = [](const PlotSeries& s) { return s.style == SeriesStyle::bars; };
  const auto bars = static_cast<size_t>(std::ranges::count_if(plot.series, is_bars));
  size_t bar = 0, styles = 0;
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    if (i > 0) script += ", \\\n  ";
    if (series.style != SeriesStyle::fit) ++styles;
    CHECK(styles > 0);  // a fit stands behind what it fits
    script += drawing_of(series, i, styles - 1, bar, bars);
    if (is_bars(series)) ++bar;
  }
  return script + "\n";
}

Result<void> run_gnuplot(const std::string& script) {
  auto child = ChildProcess::start({"gnuplot"},
                                   "which draws the plots: install Debian's package gnuplot-nox "
                                   "(./scree setup --bench does)");
  TRY(child);
  const double until_s = steady_now_s() + gnuplot_s_max;
  const auto late = [&] { return steady_now_s() > until_s; };
  std::span<const uint8_t> left(reinterpret_cast<const uint8_t*>(script.data()), script.size());
  while (!left.empty()) {
    const auto taken = TRY((*child)->give(left, gnuplot_pause_ms));
    left = left.subspan(taken);
    if (late()) return fail("gnuplot does not read its script");
  }
  (*child)->end_input();
  for (;;) {
    const auto ended = TRY((*child)->wait(gnuplot_pause_ms));
    if (ended) return {};
    if (late()) return fail("gnuplot does not come to an end");
  }
}

}  // namespace scree
