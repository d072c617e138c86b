#include "tools/rules/reference_text.h"

#include <span>
#include <sstream>
#include <utility>

#include "server/rules/api.h"
#include "tools/rules/api_words.h"
#include "tools/rules/test_script.h"

namespace scree {

namespace {

constexpr size_t line_characters_max = 118;

/// Characters, not bytes: the page has "m³".
size_t characters_in(std::string_view text) {
  size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
  return count;
}

/// In lines that fit the page; those after the first begin with `indent`.
std::string wrapped(const std::string& text, const std::string& indent = "") {
  std::istringstream words(text);
  std::string all, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && characters_in(line) + 1 + characters_in(word) > line_characters_max) {
      all += line + "\n";
      line = indent + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
  }
  return all + line + "\n";
}

std::string item(const std::string& text) {
  return wrapped("- " + text, "  ");
}

std::string example_block(std::string_view example) {
  return "\n```lua\n" + std::string(example) + "\n```\n";
}

std::string signature(const std::string& name, std::string_view arguments, std::string_view returns) {
  std::string text = name + "(" + std::string(arguments) + ")";
  if (!returns.empty()) text += " → " + std::string(returns);
  return text;
}

std::string name_in_scripts(const ApiFunction& row) {
  const bool is_plain = row.table.empty() || row.table.ends_with(':');
  return std::string(row.table) + (is_plain ? "" : ".") + std::string(row.name);
}

std::string function_section(const ApiFunction& row) {
  const std::string name = name_in_scripts(row);
  std::string text = "\n### " + name + "\n\n`" + signature(name, row.arguments, row.returns) + "`\n\n" +
                     wrapped(std::string(row.what) + (row.at_load ? " Files may call it as they load." : ""));
  return text + example_block(row.example);
}

std::string event_section(const ApiEvent& event) {
  std::string text = "\n### on." + std::string(event.name) + "\n\n" + wrapped(std::string(event.what));
  text += "\n" +
          wrapped("The handler gets `" + std::string(event.arguments) + "`" +
                  (event.returns.empty() ? "." : ", and may return `" + std::string(event.returns) + "`."));
  return text + example_block(event.example);
}

std::string type_section(const ApiType& type) {
  std::string text = "\n### " + std::string(type.name) + "\n\n" + wrapped(std::string(type.what));
  const std::vector<WordedField> fields = fields_of_type(type.fields);
  if (fields.empty()) return text;
  text += "\n";
  for (const WordedField& field : fields)
    text +=
        item("`" + name_of(field) + ": " + field.type + "`" + (field.what.empty() ? "" : " – " + field.what));
  return text;
}

/// As the page's heading of that name is linked to.
std::string link_to(const std::string& name) {
  std::string anchor;
  for (const char c : name)
    if (c != '.' && c != ':') anchor += c;
  return "[" + name + "](#" + anchor + ")";
}

/// All events and functions, by table.
std::string index_of_names() {
  std::string events, text, names;
  for (const ApiEvent& event : api_events())
    events += (events.empty() ? "" : ", ") + link_to("on." + std::string(event.name));
  std::string_view table;
  for (const ApiFunction& row : all_api()) {
    if (row.table == "on") continue;
    if (row.table != table && !names.empty()) text += item(std::exchange(names, {}));
    table = row.table;
    names += (names.empty() ? "" : ", ") + link_to(name_in_scripts(row));
  }
  return item(events) + text + item(names);
}

std::string test_rows(std::span<const TestFunction> rows, const std::string& before) {
  std::string text;
  for (const TestFunction& row : rows)
    text += item("`" + signature(before + std::string(row.name), row.arguments, row.returns) + "` – " +
                 std::string(row.what));
  return text;
}

}  // namespace

std::string reference_text() {
  std::string text =
      "# Reference of rules\n\n<!-- Made by `scree rules reference`; a test compares it, and runs each "
      "example. "
      "-->\n\n" +
      wrapped(
          "All that rules find, beside the library of Lua ([rules](rules.md) has the guide). A `?` marks "
          "what "
          "may be left out, or be nil. Lengths are metres, masses kg, times seconds of the world. Examples "
          "run "
          "within `on.start` of a flat world.") +
      "\n" + index_of_names() + "\n## Events\n";
  for (const ApiEvent& event : api_events()) text += event_section(event);
  text += "\n## Functions\n";
  for (const ApiFunction& row : all_api())
    if (row.table != "on") text += function_section(row);
  text += "\n## Tables\n";
  for (const ApiType& type : api_types()) text += type_section(type);
  text += "\n## In tests\n\n" + wrapped("What files of `tests/` find: `scree rules test` runs them.") + "\n";
  text += test_rows(test_globals(), "");
  for (const auto part : {test_world_functions(), test_person_functions(), test_lua_functions()})
    text += test_rows(part, "t:");
  return text;
}

}  // namespace scree
