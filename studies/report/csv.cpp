#include <cmath>
#include <fmt/format.h>

#include "studies/report/event_style.h"
#include "studies/report/formats.h"
#include "studies/report/inline_text.h"

namespace scree {
namespace {

/// By RFC 4180.
std::string field(std::string_view text) {
  const std::string line = one_line(text);
  if (line.find_first_of(",\"") == std::string::npos && !line.starts_with(' ') && !line.ends_with(' '))
    return line;
  std::string out = "\"";
  for (const char c : line) out.append(c == '"' ? 2 : 1, c);
  return out + "\"";
}

std::string finite(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

std::string name_at(const Plot& plot, double x) {
  const bool named = x >= 0.0 && x < static_cast<double>(plot.x_names.size());
  return named ? field(plot.x_names[static_cast<size_t>(x)]) : std::string();
}

}  // namespace

std::string plot_csv(const Plot& plot) {
  bool spread = false;
  for (const PlotSeries& series : plot.series) spread = spread || !series.spread.empty();
  const bool names = !plot.x_names.empty();
  std::string csv = fmt::format("series,{}{},{}{}\n", field(plot.x_label), names ? ",name" : "",
                                field(plot.y_label), spread ? ",half the spread" : "");
  for (const PlotSeries& series : plot.series)
    for (size_t i = 0; i < series.points.size(); ++i) {
      const auto& [x, y] = series.points[i];
      csv += field(series.name) + "," + finite(x) + (names ? "," + name_at(plot, x) : "") + "," + finite(y);
      if (spread) csv += "," + (i < series.spread.size() ? finite(series.spread[i]) : "");
      csv += "\n";
    }
  for (const PlotEvent& event : plot.events)
    csv += fmt::format("event: {},{}{},{}\n", style_of(event.kind).name, finite(event.x), names ? "," : "",
                       spread ? "," : "");
  return csv;
}

}  // namespace scree
