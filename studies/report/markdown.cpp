#include <fmt/format.h>

#include "studies/report/formats.h"
#include "studies/report/inline_text.h"

namespace scree {
namespace {

std::string row_of(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + inline_markdown(cell, MarkdownPlace::cell) + " |";
  return row + "\n";
}

std::string table_of(const ReportTable& table) {
  std::string text;
  if (!table.caption.empty()) text += inline_markdown(table.caption, MarkdownPlace::paragraph) + "\n\n";
  text += row_of(table.header) + "|";
  for (size_t i = 0; i < table.header.size(); ++i) text += "---|";
  text += "\n";
  for (const auto& row : table.rows) text += row_of(row);
  return text + "\n";
}

std::string paragraphs(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += inline_markdown(text, MarkdownPlace::paragraph) + "\n\n";
  return out;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_rows(const Machine& machine) {
  return {{"processor", machine.processor},
          {"threads", std::to_string(machine.threads)},
          {"memory", fmt::format("{:.1f} GiB", machine.memory_gib)},
          {"compiler", machine.compiler},
          {"system", machine.system}};
}

std::string report_markdown(const StudyReport& report, const Machine& machine) {
  const auto title = [](const std::string& text) { return inline_markdown(text, MarkdownPlace::cell); };
  std::string text = "# " + title(report.title) + "\n\n";
  if (!report.command.empty())
    text += inline_markdown("Made by `" + report.command + "`.", MarkdownPlace::paragraph) + "\n\n";
  text += paragraphs(report.summary);
  ReportTable of_machine{"The machine that it was made on:", {"", ""}, {}};
  for (const auto& [name, value] : machine_rows(machine)) of_machine.rows.push_back({name, value});
  text += table_of(of_machine);
  for (const ReportSection& section : report.sections) {
    text += "## " + title(section.title) + "\n\n" + paragraphs(section.text);
    for (const ReportTable& table : section.tables) text += table_of(table);
    for (const Plot& plot : section.plots)
      text += fmt::format("![{0}]({1}/{2}.svg)\n\n[{2}.csv]({1}/{2}.csv)\n\n", title(plot.title), report.name,
                          plot.name);
  }
  text.pop_back();
  return text;
}

}  // namespace scree
