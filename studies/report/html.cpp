#include <algorithm>
#include <fmt/format.h>

#include "studies/report/formats.h"
#include "studies/report/inline_text.h"

namespace scree {
namespace {

/// gnuplot draws on white; in the dark a plot's brightness is turned round, and its hues stay.
constexpr std::string_view style = R"CSS(
:root { color-scheme: light dark; --paper: #fdfdfc; --ink: #1d2125; --soft: #5c656e; --line: #d9dde1; --tint: #f1f3f5; --link: #0b5cad; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #16191c; --ink: #e4e7ea; --soft: #9aa4ae; --line: #343a40; --tint: #202428; --link: #7cb8f5; }
  figure svg { filter: invert(0.915) hue-rotate(180deg); }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.25rem 4rem; max-width: 62rem; background: var(--paper); color: var(--ink);
  font: 16px/1.55 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.8rem; line-height: 1.2; margin: 0 0 1rem; }
h2 { font-size: 1.3rem; margin: 2.8rem 0 .6rem; padding-top: .8rem; border-top: 1px solid var(--line); }
p { margin: .7rem 0; max-width: 48rem; }
a { color: var(--link); }
code { font: .9em ui-monospace, "DejaVu Sans Mono", monospace; background: var(--tint); padding: .1em .3em; border-radius: 3px; }
nav ol { columns: 2 22rem; padding-left: 1.4rem; font-size: .95rem; }
.wide { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: .92rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--soft); padding-bottom: .4rem; }
th, td { text-align: left; vertical-align: top; padding: .35rem .8rem .35rem 0; border-bottom: 1px solid var(--line); }
th { color: var(--soft); font-weight: 600; }
figure { margin: 1.4rem 0; }
figure svg { width: 100%; height: auto; display: block; border-radius: 6px; border: 1px solid #dddddd; }
@media print { h2 { break-after: avoid; } figure, table { break-inside: avoid; } }
)CSS";

std::string cells(const std::vector<std::string>& texts, std::string_view element) {
  std::string row = "<tr>";
  for (const std::string& text : texts) row += fmt::format("<{0}>{1}</{0}>", element, inline_html(text));
  return row + "</tr>\n";
}

/// The page's width without its margins (the style's 62rem), and what a letter takes in a table, and a cell
/// beside its letters: in DejaVu Sans, which is a wide font.
constexpr size_t page_px = 952, letter_px = 9, cell_px = 13;

/// The length of the longest word, which a browser does not break.
size_t longest_word(const std::string& text) {
  size_t longest = 0, letters = 0;
  for (const char c : text) {
    const bool goes_on = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;  // of a letter of several bytes
    if (!goes_on) ++letters;
    if (c == ' ') letters = 0;
    longest = std::max(longest, letters);
    if (c == '-') letters = 0;
  }
  return longest;
}

size_t least_px(const ReportTable& table, size_t column) {
  size_t letters = longest_word(table.header[column]);
  for (const auto& row : table.rows) letters = std::max(letters, longest_word(row[column]));
  return letters * letter_px + cell_px;
}

/// The table itself where it fits the page; else its columns in as many tables as it takes, each with the
/// first column.
std::vector<ReportTable> fitting(const ReportTable& table) {
  std::vector<std::vector<size_t>> parts(1);
  size_t width = 0;
  for (size_t column = 0; column < table.header.size(); ++column) {
    const size_t more = least_px(table, column);
    if (width + more > page_px && parts.back().size() > 1) {
      parts.push_back({0});
      width = least_px(table, 0);
    }
    width += more;
    parts.back().push_back(column);
  }
  if (parts.size() == 1) return {table};
  std::vector<ReportTable> tables;
  for (const std::vector<size_t>& columns : parts) {
    ReportTable& part = tables.emplace_back();
    part.caption = tables.size() == 1 ? table.caption : table.caption + ", continued";
    const auto of = [&](const std::vector<std::string>& cells) {
      std::vector<std::string> some;
      for (const size_t column : columns) some.push_back(cells[column]);
      return some;
    };
    part.header = of(table.header);
    for (const auto& row : table.rows) part.rows.push_back(of(row));
  }
  return tables;
}

std::string table_html(const ReportTable& table) {
  std::string html = "<div class=\"wide\"><table>\n";
  if (!table.caption.empty()) html += "<caption>" + inline_html(table.caption) + "</caption>\n";
  if (!table.header.empty()) html += "<thead>" + cells(table.header, "th") + "</thead>\n";
  html += "<tbody>\n";
  for (const auto& row : table.rows) html += cells(row, "td");
  return html + "</tbody></table></div>\n";
}

std::string paragraphs_html(const std::vector<std::string>& texts) {
  std::string html;
  for (const std::string& text : texts) html += "<p>" + inline_html(text) + "</p>\n";
  return html;
}

/// Without what stands before it in a file of its own.
std::string inlined(const std::string& svg) {
  const size_t start = svg.find("<svg");
  return start == std::string::npos ? std::string() : svg.substr(start);
}

}  // namespace

std::string report_html(const StudyReport& report, const Machine& machine,
                        const std::vector<std::string>& svgs) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      html_escaped(one_line(report.title)) + "</title>\n<style>";
  html += style;
  html += "</style>\n</head>\n<body>\n<h1>" + inline_html(report.title) + "</h1>\n";
  if (!report.command.empty())
    html += "<p>Made by <code>" + html_escaped(one_line(report.command)) + "</code>.</p>\n";
  html += paragraphs_html(report.summary);
  ReportTable of_machine{"The machine that it was made on", {}, {}};
  for (const auto& [name, value] : machine_rows(machine)) of_machine.rows.push_back({name, value});
  html += table_html(of_machine) + "<nav><ol>\n";
  for (size_t i = 0; i < report.sections.size(); ++i)
    html += fmt::format("<li><a href=\"#s{}\">{}</a></li>\n", i + 1, inline_html(report.sections[i].title));
  html += "</ol></nav>\n";
  size_t drawn = 0;
  for (size_t i = 0; i < report.sections.size(); ++i) {
    const ReportSection& section = report.sections[i];
    html += fmt::format("<section id=\"s{}\">\n<h2>{}</h2>\n", i + 1, inline_html(section.title));
    html += paragraphs_html(section.text);
    for (const ReportTable& table : section.tables)
      for (const ReportTable& part : fitting(table)) html += table_html(part);
    for (const Plot& plot : section.plots)
      html += "<figure role=\"img\" aria-label=\"" + html_escaped(one_line(plot.title)) + "\">\n" +
              inlined(svgs.at(drawn++)) + "</figure>\n";
    html += "</section>\n";
  }
  return html + "</body>\n</html>\n";
}

}  // namespace scree
