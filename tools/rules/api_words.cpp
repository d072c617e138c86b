#include "tools/rules/api_words.h"

#include "shared/base/check.h"

namespace scree {

namespace {

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

WordedField field_of_text(std::string_view text) {
  const size_t colon = text.find(": ");
  CHECK(colon != std::string_view::npos, "a field in a row of rules is `name: type`");
  WordedField field;
  field.name = trimmed(text.substr(0, colon));
  if (field.name.ends_with('?')) {
    field.name.pop_back();
    field.optional = true;
  }
  std::string_view rest = text.substr(colon + 2);
  if (const size_t words = rest.find(" -- "); words != std::string_view::npos) {
    field.what = trimmed(rest.substr(words + 4));
    rest = rest.substr(0, words);
  }
  field.type = trimmed(rest);
  return field;
}

/// Cut at the commas outside brackets.
std::vector<std::string_view> cut_at_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  int depth = 0;
  size_t begin = 0;
  for (size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ',';
    if (c == '(' || c == '<' || c == '{') ++depth;
    if (c == ')' || c == '>' || c == '}') --depth;
    if (c != ',' || (depth != 0 && i < text.size())) continue;
    if (const std::string_view part = trimmed(text.substr(begin, i - begin)); !part.empty())
      parts.push_back(part);
    begin = i + 1;
  }
  return parts;
}

}  // namespace

std::vector<WordedField> arguments_of(std::string_view text) {
  std::vector<WordedField> fields;
  for (const std::string_view part : cut_at_commas(text)) fields.push_back(field_of_text(part));
  return fields;
}

std::vector<WordedField> fields_of_type(std::string_view text) {
  std::vector<WordedField> fields;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    fields.push_back(field_of_text(text.substr(0, end)));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return fields;
}

std::vector<std::string> types_of(std::string_view text) {
  const auto parts = cut_at_commas(text);
  return {parts.begin(), parts.end()};
}

std::string whole_name(const ApiFunction& row) {
  return std::string(row.table) + (row.table.empty() || row.table.ends_with(':') ? "" : ".") +
         std::string(row.name);
}

std::string name_of(const WordedField& field) {
  return field.name + (field.optional ? "?" : "");
}

std::string indented(std::string_view text, std::string_view indent) {
  std::string all;
  for (const char c : text) {
    all += c;
    if (c == '\n') all += indent;
  }
  return all;
}

}  // namespace scree
