#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

/// A member as text, whatever it is; empty: there is none.
std::string text_of(const Json& object, const char* member) {
  const auto found = object.find(member);
  if (found == object.end() || found->is_null()) return {};
  if (found->is_string()) return found->get<std::string>();
  return found->dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string audit_line(const Json& act) {
  return fmt::format("{}  {} {}", text_of(act, "time"), text_of(act, "who"), text_of(act, "act"));
}

std::string log_line(const Json& line) {
  return fmt::format("[{}] [{}] [{}] {}", text_of(line, "time"), text_of(line, "part"),
                     text_of(line, "level"), text_of(line, "message"));
}

constexpr const char* figure_columns =
    "{:<24}  {:>8}  {:>8}  {:>5}  {:>6}  {:>8}  {:>10}  {:>9}  {:>8}  {:>7}";

std::string figure_line(const Json& sample) {
  const auto text = [&](const char* member) { return text_of(sample, member); };
  return fmt::format(figure_columns, text("time"), text("tick_ms"), text("tick_ms_max"), text("late"),
                     text("pieces"), text("sessions"), text("sent_bytes_s"), text("memory_mb"),
                     text("requests"), text("refused"));
}

std::string setting_line(const Json& setting) {
  std::string may_be = text_of(setting, "may_be");
  if (setting.contains("choices") && setting["choices"].is_array())
    for (const Json& choice : setting["choices"])
      may_be += (may_be.empty() ? "" : ", ") + (choice.is_string() ? choice.get<std::string>() : "?");
  if (setting.contains("least"))
    may_be = fmt::format("{} to {} {}", text_of(setting, "least"), text_of(setting, "greatest"),
                         text_of(setting, "unit"));
  return fmt::format("{:<20} {:<12} {}: {}", text_of(setting, "name"), text_of(setting, "value"), may_be,
                     text_of(setting, "help"));
}

std::string line_of(const Json& object, LinesOf of) {
  switch (of) {
    case LinesOf::audit:
      return audit_line(object);
    case LinesOf::log:
      return log_line(object);
    case LinesOf::figures:
      return figure_line(object);
    case LinesOf::settings:
      return setting_line(object);
  }
  return {};
}

Result<Json> objects_of(const std::string& lines) {
  Json all = Json::array();
  for (size_t from = 0; from < lines.size();) {
    const size_t end = std::min(lines.find('\n', from), lines.size());
    Json object = Json::parse(lines.begin() + static_cast<std::ptrdiff_t>(from),
                              lines.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    if (!object.is_object()) return fail("a line of the server's answer is no object of JSON");
    all.push_back(std::move(object));
    from = end + 1;
  }
  return all;
}

}  // namespace

Result<std::string> lines_json(const std::string& lines) {
  return TRY(objects_of(lines)).dump(2, ' ', true, Json::error_handler_t::replace) + "\n";
}

Result<std::string> lines_text(const std::string& lines, LinesOf of) {
  std::string text;
  if (of == LinesOf::figures)
    text = fmt::format(figure_columns, "time", "tick ms", "most", "late", "pieces", "sessions", "bytes/s",
                       "memory MB", "requests", "refused") +
           "\n";
  for (const Json& object : TRY(objects_of(lines))) text += rules_lines(line_of(object, of));
  return text;
}

}  // namespace scree
