#include "studies/report/report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <set>
#include <sstream>

#include "bench/support/text_file.h"
#include "studies/report/formats.h"
#include "studies/report/gnuplot.h"

namespace scree {
namespace {

constexpr int significant_digits = 3;

bool is_file_name(const std::string& name) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  return !name.empty() && std::ranges::all_of(name, fits);
}

bool is_drawn(const Plot& plot, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (!plot.log_x || x > 0.0) && (!plot.log_y || y > 0.0);
}

Result<void> check_plot(const Plot& plot) {
  if (!is_file_name(plot.name))
    return fail("the plot's name '" + plot.name + "' has other characters than a-z, 0-9 and -");
  for (const PlotSeries& series : plot.series)
    for (const auto& [x, y] : series.points)
      if (is_drawn(plot, x, y)) return {};
  return fail("the plot " + plot.name + " has no point that can be drawn");
}

Result<void> check_tables(const ReportSection& section) {
  for (const ReportTable& table : section.tables)
    for (const auto& row : table.rows)
      if (row.size() != table.header.size())
        return fail(fmt::format("a table of '{}' has a row of {} cells, and a header of {}", section.title,
                                row.size(), table.header.size()));
  return {};
}

Result<void> check_report(const StudyReport& report) {
  if (!is_file_name(report.name))
    return fail("the report's name '" + report.name + "' has other characters than a-z, 0-9 and -");
  std::set<std::string> names;
  for (const ReportSection& section : report.sections) {
    TRY(check_tables(section));
    for (const Plot& plot : section.plots) {
      TRY(check_plot(plot));
      if (!names.insert(plot.name).second) return fail("two plots are named " + plot.name);
    }
  }
  return {};
}

Result<std::string> draw_svg(const Plot& plot, const std::filesystem::path& path) {
  std::error_code none;
  std::filesystem::remove(path, none);  // an old one is not to be taken for what gnuplot drew
  if (Result<void> drawn = run_gnuplot(gnuplot_script(plot, path.string())); !drawn)
    return fail("the plot " + plot.name + " was not drawn: " + drawn.error().message);
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || text.str().find("<svg") == std::string::npos)
    return fail("the plot " + plot.name + " was not drawn: gnuplot wrote no SVG to " + path.string());
  return text.str();
}

}  // namespace

std::string figure(double value) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0.0 ? "∞" : "−∞";
  if (value == 0.0) return "0";
  // Its decimal exponent once it is rounded: 9.996 is 10.0.
  const std::string rounded = fmt::format("{:.{}e}", value, significant_digits - 1);
  const int exponent = std::stoi(rounded.substr(rounded.find('e') + 1));
  const int decimals = std::max(significant_digits - 1 - exponent, 0);
  std::string text = fmt::format("{:.{}f}", std::stod(rounded), decimals);
  const size_t first = text.starts_with('-') ? 1 : 0;
  for (size_t at = std::min(text.find('.'), text.size()); at > first + 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

Result<void> check_plots_can_be_drawn() {
  return run_gnuplot("exit\n");
}

Result<void> write_report(const StudyReport& report, const std::string& folder) {
  namespace fs = std::filesystem;
  TRY(check_report(report));
  const fs::path plots = fs::path(folder) / report.name;
  std::error_code error;
  fs::create_directories(plots, error);
  if (error) return fail("cannot make the folder " + plots.string() + ": " + error.message());
  std::vector<std::string> svgs;
  for (const ReportSection& section : report.sections)
    for (const Plot& plot : section.plots) {
      TRY(write_text_file(plots / (plot.name + ".csv"), plot_csv(plot)));
      Result<std::string> svg = draw_svg(plot, plots / (plot.name + ".svg"));
      TRY(svg);
      svgs.push_back(std::move(*svg));
    }
  const Machine machine = this_machine();
  const std::string base = (fs::path(folder) / report.name).string();
  TRY(write_text_file(base + ".md", report_markdown(report, machine)));
  return write_text_file(base + ".html", report_html(report, machine, svgs));
}

}  // namespace scree
