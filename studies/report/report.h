// What a study found, as a value: sections of text, tables and plots. Written as Markdown, as one page of
// HTML, each plot as SVG (drawn by gnuplot) and as CSV.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shared/base/result.h"

namespace scree {

/// A table of text, with the same marks as in paragraphs; numbers are written by those who know what they are
/// worth (see figure()).
struct ReportTable {
  std::string caption;
  std::vector<std::string> header;             ///< with units: "frame, ms"
  std::vector<std::vector<std::string>> rows;  ///< each as wide as the header
};

/// A number with three significant digits, without an exponent.
std::string figure(double value);

enum class SeriesStyle {
  line,
  points,
  line_and_points,
  bars,
  fit  ///< a line through what the series before it has, in its colour
};

struct PlotSeries {
  std::string name;  ///< in the legend
  SeriesStyle style = SeriesStyle::line_and_points;
  std::vector<std::pair<double, double>> points;
  std::vector<double> spread = {};  ///< half of what the runs of each point lie apart; empty: not known
};

/// What happened in a session, by the paper's colours (section 3.3).
enum class PlotEventKind {
  physics,       ///< red: the terrain's collision shapes were made anew
  edit,          ///< yellow: the user changed the terrain
  method,        ///< blue: another way to draw
  recombination  ///< green: pieces became terrain
};

struct PlotEvent {
  PlotEventKind kind = PlotEventKind::edit;
  double x = 0.0;
};

struct Plot {
  std::string name;  ///< of its files: lower case, digits and dashes
  std::string title;
  std::string x_label;  ///< with its unit: "voxel size, m"
  std::string y_label;
  bool log_x = false;
  bool log_y = false;
  std::vector<PlotSeries> series;
  std::vector<PlotEvent> events = {};     ///< drawn as coloured marks, with a legend of their own
  std::vector<std::string> x_names = {};  ///< of bars: what stands at x = 0, 1, …
  std::optional<std::pair<double, double>> y_range = {};
};

/// In this order: text, tables, plots.
struct ReportSection {
  std::string title;
  std::vector<std::string> text;  ///< paragraphs; Markdown's `code`, **strong** and links
  std::vector<ReportTable> tables = {};
  std::vector<Plot> plots = {};
};

struct StudyReport {
  std::string name;  ///< of its files: "paper"
  std::string title;
  std::string command;  ///< that makes it
  std::vector<std::string> summary;
  std::vector<ReportSection> sections;
};

/// Writes NAME.md, NAME.html, NAME/PLOT.svg and NAME/PLOT.csv into the folder, which is made if need be, with
/// the machine's description (machine.h). The HTML page is whole in itself. Fails where a file cannot be
/// written, or gnuplot is missing or fails, saying so.
Result<void> write_report(const StudyReport& report, const std::string& folder);

/// Fails as write_report() would where gnuplot is missing or does not run: to be asked before measuring for
/// minutes.
Result<void> check_plots_can_be_drawn();

}  // namespace scree
