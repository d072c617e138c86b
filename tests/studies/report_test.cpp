// Reports of studies: numbers, text from outside in each format, and what is refused. Only what gnuplot draws
// needs gnuplot.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

#include "studies/report/axis_ticks.h"
#include "studies/report/formats.h"
#include "studies/report/gnuplot.h"
#include "studies/report/inline_text.h"
#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

/// In every format it would do something if it stood there as it is.
const std::string evil = "a<b>&\"c' | `d` \\ $(e)\n# f, *g* _h_ [i](javascript:j)";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool has_gnuplot() {
  return run_program("gnuplot --version").first == 0;
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Plot plain_plot(const std::string& name) {
  return {.name = name,
          .title = "Title",
          .x_label = "x, m",
          .y_label = "y, ms",
          .series = {{.name = "one", .points = {{1.0, 2.0}, {2.0, 3.0}}}}};
}

StudyReport report_of(std::vector<Plot> plots) {
  StudyReport report{.name = "sample",
                     .title = "A sample",
                     .command = "./scree bench sample",
                     .summary = {"Short."},
                     .sections = {}};
  report.sections.push_back({.title = "First", .text = {"A paragraph."}, .plots = std::move(plots)});
  return report;
}

TEST(Figure, has_three_significant_digits_and_no_exponent) {
  EXPECT_EQ(figure(0.0), "0");
  EXPECT_EQ(figure(1.0), "1.00");
  EXPECT_EQ(figure(2.345), "2.35");
  EXPECT_EQ(figure(9.999), "10.0");
  EXPECT_EQ(figure(99.96), "100");
  EXPECT_EQ(figure(999.6), "1,000");
  EXPECT_EQ(figure(-1234567.0), "-1,230,000");
  EXPECT_EQ(figure(-123.0), "-123");
  EXPECT_EQ(figure(0.000123456), "0.000123");
  EXPECT_EQ(figure(1e12), "1,000,000,000,000");
  EXPECT_EQ(figure(std::numeric_limits<double>::quiet_NaN()), "–");
  EXPECT_EQ(figure(std::numeric_limits<double>::infinity()), "∞");
}

TEST(MachineOf, slug_is_short_and_fit_for_a_file) {
  EXPECT_EQ(slug_of({.processor = "Intel(R) Xeon(R) Platinum 8375C CPU @ 2.90GHz", .threads = 2}),
            "intel-xeon-platinum-8375c-2");
  EXPECT_EQ(slug_of({.processor = "AMD Ryzen 9 5950X 16-Core Processor", .threads = 32}),
            "amd-ryzen-9-5950x-32");
  EXPECT_EQ(slug_of({.processor = "../../etc", .threads = 1}), "etc-1");
  EXPECT_EQ(slug_of({.processor = "", .threads = 4}), "unknown-4");
  EXPECT_LT(slug_of({.processor = std::string(1000, 'x'), .threads = 4}).size(), 80U);
}

TEST(MachineOf, this_one_has_threads_and_memory) {
  const Machine machine = this_machine();
  EXPECT_GE(machine.threads, 1U);
  EXPECT_GT(machine.memory_gib, 0.0);
  EXPECT_FALSE(machine.processor.empty());
  EXPECT_FALSE(machine.compiler.empty());
  EXPECT_TRUE(has(machine.system, " ")) << machine.system;
  EXPECT_EQ(slug_of(machine), slug_of(this_machine()));
}

TEST(InlineText, marks_become_elements) {
  EXPECT_EQ(inline_html("by `field`, **not `mesh`**, see [the page](paper.md#a)"),
            "by <code>field</code>, <strong>not <code>mesh</code></strong>, see <a href=\"paper.md#a\">the "
            "page</a>");
  EXPECT_EQ(
      inline_markdown("by `field`, **not `mesh`**, see [the page](https://a.b/c)", MarkdownPlace::paragraph),
      "by `field`, **not `mesh`**, see [the page](https://a.b/c)");
}

TEST(InlineText, marks_that_are_not_closed_are_text) {
  EXPECT_EQ(inline_html("a ` b ** c [d]( e"), "a ` b ** c [d]( e");
  EXPECT_EQ(inline_markdown("a ` b", MarkdownPlace::paragraph), "a \\` b");
}

TEST(InlineText, links_lead_to_pages_and_files_only) {
  for (const std::string target :
       {"javascript:alert", "data:text/html,x", "data:image/png,x", "file:/etc/passwd"})
    for (const std::string mark : {"", "!"}) {
      const std::string text = mark + "[x](" + target + ")";
      EXPECT_FALSE(has(inline_html(text), "=\"" + target)) << inline_html(text);
      EXPECT_FALSE(has(inline_markdown(text, MarkdownPlace::paragraph), "](" + target)) << target;
    }
}

TEST(InlineText, evil_text_is_only_text) {
  const std::string html = inline_html(evil);
  EXPECT_FALSE(has(html, "<b>"));
  EXPECT_FALSE(has(html, "javascript:j"));
  EXPECT_TRUE(has(html, "a&lt;b&gt;&amp;&quot;c' | <code>d</code>")) << html;
  const std::string cell = inline_markdown(evil + " `x|y`", MarkdownPlace::cell);
  EXPECT_FALSE(has(cell, "\n"));
  for (const char c : {'<', '|'})
    for (size_t at = cell.find(c); at != std::string::npos; at = cell.find(c, at + 1))
      EXPECT_EQ(cell.at(at - 1), '\\') << cell;
  EXPECT_TRUE(has(cell, "*g* *h* [i]()")) << cell;
}

TEST(InlineText, a_paragraph_starts_no_heading_list_or_quote) {
  EXPECT_EQ(inline_markdown("# a", MarkdownPlace::paragraph), "\\# a");
  EXPECT_EQ(inline_markdown("- a", MarkdownPlace::paragraph), "\\- a");
  EXPECT_EQ(inline_markdown("12. a", MarkdownPlace::paragraph), "12\\. a");
  EXPECT_EQ(inline_markdown("12.5 ms", MarkdownPlace::paragraph), "12.5 ms");
  EXPECT_EQ(inline_markdown("some_name is", MarkdownPlace::paragraph), "some\\_name is");
  EXPECT_EQ(inline_html("# a"), "# a");
  EXPECT_EQ(inline_html("  "), "");
  EXPECT_EQ(inline_html("`a` b"), "<code>a</code> b");
}

TEST(Csv, has_a_row_for_each_point_and_event) {
  Plot plot = plain_plot("p");
  plot.series.front().name = "a, \"b\"";
  plot.series.front().spread = {0.5, 0.25};
  plot.series.front().points.emplace_back(3.0, std::numeric_limits<double>::quiet_NaN());
  plot.events = {{PlotEventKind::edit, 1.5}};
  EXPECT_EQ(plot_csv(plot),
            "series,\"x, m\",\"y, ms\",half the spread\n"
            "\"a, \"\"b\"\"\",1,2,0.5\n\"a, \"\"b\"\"\",2,3,0.25\n\"a, \"\"b\"\"\",3,,\n"
            "event: terrain changed by the user,1.5,,\n");
}

TEST(Csv, names_what_stands_at_x) {
  Plot plot = plain_plot("p");
  plot.series.front().points = {{0.0, 1.0}, {1.0, 2.0}};
  plot.x_names = {"mesh", "field, fine"};
  EXPECT_EQ(plot_csv(plot), "series,\"x, m\",name,\"y, ms\"\none,0,mesh,1\none,1,\"field, fine\",2\n");
}

TEST(GnuplotScript, text_cannot_leave_its_string) {
  Plot plot = plain_plot("p");
  plot.title = plot.x_label = plot.series.front().name = "x'\nsystem 'touch evil'\n#`touch evil`";
  const std::string script = gnuplot_script(plot, "/tmp/it's.svg");
  EXPECT_TRUE(has(script, "set output '/tmp/it''s.svg'\n"));
  EXPECT_TRUE(has(script, "set title 'x'' system ''touch evil'' #`touch evil`'"));
  EXPECT_FALSE(has(script, "\nsystem"));
  EXPECT_TRUE(has(script, "noenhanced"));
}

TEST(GnuplotScript, an_axis_of_logarithms_names_the_places_that_were_measured) {
  Plot plot = plain_plot("p");
  plot.log_x = true;
  plot.series.front().points = {{64.0, 1.0}, {256.0, 1.0}, {4096.0, 1.0}};
  EXPECT_TRUE(has(gnuplot_script(plot, "p.svg"), "set xtics (64, 256, 4096)\n"));
  plot.series.front().points.emplace_back(65.0, 1.0);  // no room beside 64
  EXPECT_TRUE(has(gnuplot_script(plot, "p.svg"), "set xtics (100, 200, 500, 1000, 2000)\n"));
}

TEST(GnuplotScript, every_axis_of_logarithms_has_three_labels_at_least) {
  Plot plot = plain_plot("p");
  plot.log_x = plot.log_y = true;
  plot.series.front().points.clear();
  for (double x = 22.0; x < 35.0; x += 0.1) plot.series.front().points.emplace_back(x, 0.1 * x);
  const std::string script = gnuplot_script(plot, "p.svg");
  EXPECT_TRUE(has(script, "set xtics (25, 30, 35)\n")) << script.substr(0, 1500);
  EXPECT_TRUE(has(script, "set yrange [2:5]\nset ytics (2, 3, 4, 5)\n")) << script.substr(0, 1500);
}

TEST(GnuplotScript, a_fit_has_the_colour_of_what_it_fits) {
  Plot plot = plain_plot("p");
  plot.series.push_back({"law of a", SeriesStyle::fit, {{1.0, 2.0}, {2.0, 3.0}}});
  plot.series.push_back({"b", SeriesStyle::points, {{1.0, 2.0}}});
  const std::string script = gnuplot_script(plot, "p.svg");
  EXPECT_TRUE(has(script, "$data0 using 1:2 with linespoints lw 2 dt 1 pt 7 ps 0.8 lc rgb '#0072b2'"))
      << script;
  EXPECT_TRUE(has(script, "$data1 using 1:2 with lines lw 1.6 dt 1 lc rgb '#0072b2'")) << script;
  EXPECT_TRUE(has(script, "$data2 using 1:2 with points pt 5 ps 0.6 lc rgb '#d55e00'")) << script;
}

TEST(AxisTicks, are_round_few_and_within_the_range) {
  for (double lo : {1e-7, 0.013, 0.99, 1.0, 7.3, 5000.0})
    for (double ratio : {1.001, 1.02, 1.3, 2.0, 9.0, 50.0, 1e4, 1e12}) {
      const std::vector<double> ticks = log_ticks(lo, lo * ratio);
      EXPECT_GE(ticks.size(), ticks_least) << lo << " to " << lo * ratio;
      EXPECT_LE(ticks.size(), 12U) << lo << " to " << lo * ratio;
      EXPECT_TRUE(std::ranges::is_sorted(ticks));
      EXPECT_GE(ticks.front(), lo * 0.999999);
      EXPECT_LE(ticks.back(), lo * ratio * 1.000001);
      const auto [below, above] = round_log_range(lo, lo * ratio);
      EXPECT_TRUE(below <= lo * 1.000001 && above >= lo * ratio * 0.999999 && below < above);
    }
  EXPECT_EQ(round_log_range(2.0, 2.0), (std::pair{1.0, 5.0}));
}

TEST(Report, what_cannot_be_drawn_is_refused_before_anything_is_written) {
  const TestFolder folder;
  const std::string out = folder / "out";
  Plot empty = plain_plot("empty");
  empty.series.front().points.clear();
  Plot negative = plain_plot("negative");
  negative.log_y = true;
  negative.series.front().points = {{1.0, -1.0}};
  for (const auto& [plots, word] : std::vector<std::pair<std::vector<Plot>, std::string>>{
           {{plain_plot("../up")}, "'../up'"},
           {{plain_plot("")}, "''"},
           {{plain_plot("twice"), plain_plot("twice")}, "twice"},
           {{empty}, "empty"},
           {{negative}, "negative"}}) {
    const auto written = write_report(report_of(plots), out);
    ASSERT_FALSE(written.has_value()) << word;
    EXPECT_TRUE(has(written.error().message, word)) << written.error().message;
  }
  StudyReport ragged = report_of({});
  ragged.sections.front().tables = {{"", {"a", "b"}, {{"1"}}}};
  EXPECT_FALSE(write_report(ragged, out).has_value());
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Report, without_gnuplot_it_says_how_to_get_it) {
  const TestFolder folder;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder / "nothing").c_str(), 1);
  const auto written = write_report(report_of({plain_plot("p")}), folder / "out");
  const auto can_be_drawn = check_plots_can_be_drawn();
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(can_be_drawn.has_value());
  ASSERT_FALSE(written.has_value());
  EXPECT_TRUE(has(written.error().message, "gnuplot-nox")) << written.error().message;
}

TEST(Report, without_plots_it_needs_no_gnuplot) {
  const TestFolder folder;
  StudyReport report = report_of({});
  report.sections.front().tables = {{"A caption", {"name", "value, ms"}, {{evil, "1.5"}}}};
  ASSERT_TRUE(write_report(report, folder / "out").has_value());
  const std::string markdown = read_text(folder / "out/sample.md");
  EXPECT_TRUE(has(markdown, "# A sample\n\nMade by `./scree bench sample`.\n\nShort.\n"));
  EXPECT_TRUE(has(markdown, "## First\n\nA paragraph.\n\nA caption\n\n| name | value, ms |\n|---|---|\n| a"));
  const std::string html = read_text(folder / "out/sample.html");
  EXPECT_TRUE(has(html, "<h2>First</h2>"));
  EXPECT_TRUE(has(html, this_machine().compiler));
  EXPECT_FALSE(has(html, "<b>"));
}

TEST(Report, a_table_wider_than_the_page_is_split_in_it) {
  ReportTable wide{"Presets", {"preset"}, {{"laptop"}, {"desktop"}}};
  for (int i = 0; i < 15; ++i) {
    wide.header.push_back("memory" + std::to_string(i) + ", MB");
    for (auto& row : wide.rows) row.push_back(std::to_string(i) + ".5");
  }
  StudyReport report = report_of({});
  report.sections.front().tables = {wide};
  const std::string html = report_html(report, this_machine(), {});
  const auto count = [&](const std::string& part) {
    size_t found = 0;
    for (size_t at = html.find(part); at != std::string::npos; at = html.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<th>preset</th>"), 2U);
  EXPECT_EQ(count("<td>desktop</td>"), 2U);
  EXPECT_EQ(count("<caption>Presets, continued</caption>"), 1U);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(count("<th>memory" + std::to_string(i) + ", MB</th>"), 1U) << i;
  report.sections.front().tables.front().header.resize(6);
  for (auto& row : report.sections.front().tables.front().rows) row.resize(6);
  EXPECT_EQ(report_html(report, this_machine(), {}).find("continued"), std::string::npos);
}

TEST(Report, a_folder_that_cannot_be_made_is_told) {
  const TestFolder folder;
  std::ofstream(folder / "file") << "x";
  const auto written = write_report(report_of({}), folder / "file/out");
  ASSERT_FALSE(written.has_value());
  EXPECT_TRUE(has(written.error().message, "file/out")) << written.error().message;
}

TEST(Gnuplot, a_script_that_fails_is_told) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const auto ran = run_gnuplot("plot nonsense(\n");
  ASSERT_FALSE(ran.has_value());
  EXPECT_TRUE(has(ran.error().message, "gnuplot ended with status")) << ran.error().message;
}

TEST(Gnuplot, every_kind_of_plot_is_drawn_into_a_page_that_is_whole) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const TestFolder folder;
  Plot lines = plain_plot("lines");
  lines.title = lines.series.front().name = evil;
  lines.series.front().style = SeriesStyle::line;
  lines.events = {{PlotEventKind::physics, 1.2},
                  {PlotEventKind::edit, 1.4},
                  {PlotEventKind::method, 1.6},
                  {PlotEventKind::recombination, 1.8}};
  Plot points = plain_plot("points");
  points.log_x = points.log_y = true;
  points.series.front().style = SeriesStyle::points;
  points.series.front().points.emplace_back(0.0, 1.0);  // nowhere on such an axis
  points.series.push_back(
      {.name = "with spread", .points = {{1.0, 2.0}, {10.0, 20.0}}, .spread = {0.5, 2.0}});
  Plot bars = plain_plot("bars");
  bars.x_names = {"it's", "`b`"};
  bars.series = {
      {.name = "a", .style = SeriesStyle::bars, .points = {{0.0, 1.0}, {1.0, 2.0}}, .spread = {0.1, 0.1}},
      {.name = "b", .style = SeriesStyle::bars, .points = {{0.0, 2.0}, {1.0, 1.0}}}};
  const auto written = write_report(report_of({lines, points, bars}), folder / "it's out");
  ASSERT_TRUE(written.has_value()) << written.error().message;
  const std::string html = read_text(folder / "it's out/sample.html");
  for (const char* name : {"lines", "points", "bars"}) {
    const std::string svg = read_text(folder / ("it's out/sample/" + std::string(name) + ".svg"));
    EXPECT_TRUE(has(svg, "</svg>")) << name;
    EXPECT_TRUE(has(html, svg.substr(svg.find("<svg")))) << name;
  }
  const std::string drawn = read_text(folder / "it's out/sample/lines.svg");
  for (const char* colour :
       {"rgb(224,  49,  49)", "rgb(242, 183,   5)", "rgb(103,  65, 217)", "rgb( 47, 158,  68)"})
    EXPECT_TRUE(has(drawn, colour)) << colour;
  EXPECT_FALSE(has(html, "src="));
  EXPECT_FALSE(has(html, "<?xml"));
  EXPECT_FALSE(std::filesystem::exists("evil"));
}

}  // namespace
}  // namespace scree
