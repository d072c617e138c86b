#include "bench/results/result_file.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "shared/base/text.h"

namespace scree {

namespace {

using nlohmann::json;

constexpr uint32_t runs_max = 1000;
constexpr size_t text_bytes_max = 2000;  ///< of one text; longer ones are cut

/// A number of four significant digits; JSON has no number for what is not finite.
json rounded(double number) {
  if (!std::isfinite(number)) return nullptr;
  char text[32];
  std::snprintf(text, sizeof text, "%.3e", number);
  const double value = std::strtod(text, nullptr);
  if (value == std::trunc(value) && std::abs(value) < 1e15) return static_cast<int64_t>(value);
  return value;
}

/// As text that a reader takes.
std::string quoted(const std::string& text) {
  return json(showable(text, text_bytes_max)).dump();
}

/// {"a": 1, "b": 2} with each member on a line of its own.
class ObjectText {
 public:
  explicit ObjectText(std::string indent) : indent_(std::move(indent)) {}
  void add(const std::string& name, const std::string& value) {
    text_ += (text_.empty() ? "\n" : ",\n") + indent_ + "  " + quoted(name) + ": " + value;
  }
  std::string end() const { return text_.empty() ? "{}" : "{" + text_ + "\n" + indent_ + "}"; }

 private:
  std::string indent_;
  std::string text_;
};

std::string text_of(const std::map<std::string, std::string>& texts) {
  ObjectText object("  ");
  for (const auto& [name, value] : texts) object.add(name, quoted(value));
  return object.end();
}

std::string text_of(const Machine& machine) {
  ObjectText object("  ");
  object.add("compiler", quoted(machine.compiler));
  object.add("memory_gib", rounded(machine.memory_gib).dump());
  object.add("processor", quoted(machine.processor));
  object.add("system", quoted(machine.system));
  object.add("threads", std::to_string(machine.threads));
  return object.end();
}

/// The members of an object, each read once. The first fault is kept, and nothing is read after it.
class Members {
 public:
  Members(const json& object, std::string where, std::string& fault)
      : object_(object), where_(std::move(where)), fault_(fault) {
    if (!object.is_object()) complain("is no object");
  }

  /// Null where there is none of that name: a fault.
  const json* find(const char* name) {
    if (!fault_.empty()) return nullptr;
    const auto found = object_.find(name);
    if (found == object_.end()) complain(std::string("has no member \"") + name + "\"");
    if (!fault_.empty()) return nullptr;
    known_.insert(name);
    return &*found;
  }
  std::string text(const char* name) {
    const json* value = find(name);
    return value == nullptr ? std::string() : text_in(*value, name);
  }
  double number(const char* name) {
    const json* value = find(name);
    if (value == nullptr) return 0.0;
    if (value->is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (!value->is_number()) complain(std::string("\"") + name + "\" is not a number");
    return fault_.empty() ? value->get<double>() : 0.0;
  }
  /// From 1 on.
  uint32_t count(const char* name, uint32_t most) {
    const json* value = find(name);
    if (value == nullptr) return 1;
    if (value->is_number_unsigned() && value->get<uint64_t>() >= 1 && value->get<uint64_t>() <= most)
      return value->get<uint32_t>();
    complain(std::string("\"") + name + "\" is not a whole number from 1 to " + std::to_string(most));
    return 1;
  }
  bool truth(const char* name) {
    const json* value = find(name);
    if (value != nullptr && !value->is_boolean())
      complain(std::string("\"") + name + "\" is neither true nor false");
    return value != nullptr && value->is_boolean() && value->get<bool>();
  }
  std::map<std::string, std::string> texts(const char* name) {
    std::map<std::string, std::string> found;
    const json* value = find(name);
    if (value == nullptr) return found;
    if (!value->is_object()) complain(std::string("\"") + name + "\" is not an object");
    if (!fault_.empty()) return found;
    for (const auto& [key, text] : value->items()) found[checked(key)] = text_in(text, key);
    return found;
  }
  /// No member may be left that nobody reads.
  void end() {
    if (!fault_.empty()) return;
    for (const auto& [name, value] : object_.items())
      if (!known_.contains(name))
        return complain("has a member \"" + showable(name, 64) + "\" that is not known");
  }
  void complain(const std::string& what) {
    if (fault_.empty()) fault_ = where_ + " " + what;
  }
  /// A name or text that may be shown.
  const std::string& checked(const std::string& text) {
    if (const auto wrong = fault_of_text(text)) complain("has a text that " + std::string(*wrong));
    return text;
  }

 private:
  std::string text_in(const json& value, const std::string& name) {
    if (!value.is_string()) complain("\"" + showable(name, 64) + "\" is not a text");
    return fault_.empty() ? checked(value.get<std::string>()) : std::string();
  }

  const json& object_;
  std::string where_;
  std::string& fault_;
  std::set<std::string> known_;
};

Machine machine_in(const json& value, std::string& fault) {
  Members members(value, "the machine", fault);
  Machine machine;
  machine.compiler = members.text("compiler");
  machine.memory_gib = members.number("memory_gib");
  machine.processor = members.text("processor");
  machine.system = members.text("system");
  machine.threads = members.count("threads", 65536);
  members.end();
  return machine;
}

MetricRange range_in(const json& value, const std::string& where, std::string& fault) {
  Members members(value, where, fault);
  const MetricRange range{members.number("value"), members.number("min"), members.number("max")};
  members.end();
  const bool none = std::isnan(range.value) && std::isnan(range.min) && std::isnan(range.max);
  if (!none && !(range.min <= range.value && range.value <= range.max))
    members.complain("is not between its least and its most");
  return range;
}

StoredCheck check_in(const json& value, const std::string& where, std::string& fault) {
  Members members(value, where, fault);
  StoredCheck check;
  check.passed = members.truth("passed");
  check.detail = members.text("detail");
  members.end();
  return check;
}

bool is_file_name(const std::string& name) {
  return !name.empty() &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_") == std::string::npos;
}

/// Each member of the object `name` by `read`(value, where).
template <typename Value, typename Read>
void each_in(Members& members, const char* name, const std::string& what, std::map<std::string, Value>& found,
             const Read& read) {
  const json* object = members.find(name);
  if (object == nullptr) return;
  if (!object->is_object()) return members.complain(std::string("\"") + name + "\" is not an object");
  for (const auto& [key, value] : object->items())
    found[members.checked(key)] = read(value, what + " \"" + showable(key, 64) + "\"");
}

}  // namespace

std::string to_json(const StoredResult& result) {
  ObjectText metrics("  "), checks("  "), whole("");
  for (const auto& [name, range] : result.metrics)
    metrics.add(name, "{\"value\": " + rounded(range.value).dump() + ", \"min\": " +
                          rounded(range.min).dump() + ", \"max\": " + rounded(range.max).dump() + "}");
  for (const auto& [name, check] : result.checks)
    checks.add(name, std::string("{\"passed\": ") + (check.passed ? "true" : "false") +
                         ", \"detail\": " + quoted(check.detail) + "}");
  whole.add("format", std::to_string(result_format));
  whole.add("kind", quoted(std::string(name_of(result.kind))));
  whole.add("name", quoted(result.name));
  whole.add("runs", std::to_string(result.runs));
  whole.add("options", text_of(result.options));
  whole.add("machine", text_of(result.machine));
  whole.add("conditions", text_of(result.conditions));
  whole.add("metrics", metrics.end());
  whole.add("checks", checks.end());
  return whole.end() + "\n";
}

Result<StoredResult> parse_result(std::string_view text) {
  const json document = json::parse(text, nullptr, false);
  if (document.is_discarded()) return fail("it is not JSON, or it is cut short");
  if (!document.is_object() || !document.contains("format"))
    return fail("it is not a result of scree-bench: it names no format");
  if (document["format"] != result_format)
    return fail("it is of format " + showable(document["format"].dump(), 32) + "; this program reads " +
                std::to_string(result_format));
  std::string fault;
  Members members(document, "it", fault);
  members.find("format");
  StoredResult result;
  const std::string kind = members.text("kind");
  if (const auto known = kind_named<ResultKind>(kind))
    result.kind = *known;
  else
    members.complain("has an unknown kind");
  result.name = members.text("name");
  if (!is_file_name(result.name)) members.complain("has an invalid name");
  result.runs = members.count("runs", runs_max);
  result.options = members.texts("options");
  if (const json* machine = members.find("machine")) result.machine = machine_in(*machine, fault);
  result.conditions = members.texts("conditions");
  each_in(members, "metrics", "metric", result.metrics,
          [&](const json& value, const std::string& where) { return range_in(value, where, fault); });
  each_in(members, "checks", "check", result.checks,
          [&](const json& value, const std::string& where) { return check_in(value, where, fault); });
  members.end();
  if (!fault.empty()) return fail(fault);
  return result;
}

Result<void> write_result(const StoredResult& result, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  const std::string unfinished = path + "-unfinished";
  {
    std::ofstream out(unfinished, std::ios::binary);
    out << to_json(result);
    if (!out.flush()) return fail(path + ": cannot be written");
  }
  fs::rename(unfinished, path, error);
  return error ? fail(path + ": " + error.message()) : Result<void>();
}

Result<StoredResult> read_result(const std::string& path) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  if (error) return fail(path + ": " + error.message());
  if (bytes > result_bytes_max)
    return fail(path + ": it is too large for a result (" + std::to_string(result_bytes_max) + " bytes)");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) return fail(path + ": cannot be read");
  auto result = parse_result(text.view());
  if (!result) return fail(path + ": " + result.error().message);
  return result;
}

Result<std::map<std::string, StoredResult>> read_results(const std::string& folder) {
  std::error_code error;
  std::map<std::string, StoredResult> results;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".json") continue;
    auto result = read_result(entry.path().string());
    TRY(result);
    if (entry.path().stem() != result->name)
      return fail(entry.path().string() + ": it holds the result of '" + result->name + "'");
    results[result->name] = std::move(*result);
  }
  if (error) return fail(folder + ": " + error.message());
  if (results.empty()) return fail(folder + ": it has no results (NAME.json)");
  return results;
}

}  // namespace scree
