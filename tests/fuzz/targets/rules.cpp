// Calls of the functions that scripts find, with any arguments, in handlers of a small world; and texts that
// are run as Lua.
//
// Holds: each line has an answer, the ledger balances after every tick, a tick gets no more commands than it
// may, and what rules keep stays within its limits.
#include "server/rules/rules.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

#include "server/formats/world_value.h"
#include "server/rules/api.h"
#include "server/rules/request_table.h"
#include "server/world/world.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

constexpr int lines_most = 24;

/// Rules without a handler, in whose name the lines run. One for all inputs: a script is made anew for each.
class QuietRules {
 public:
  QuietRules()
      : folder_(std::filesystem::temp_directory_path() / ("scree_fuzz_rules_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_ / "fuzzed");
    std::ofstream(folder_ / "fuzzed" / "init.lua") << "made = {}\n";
  }
  ~QuietRules() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  QuietRules(const QuietRules&) = delete;
  QuietRules& operator=(const QuietRules&) = delete;

  std::unique_ptr<Rules> load() const {
    RulesOptions options;
    options.folders = {(folder_ / "fuzzed").string()};
    auto loaded = Rules::load(std::move(options));
    CHECK(loaded.has_value());
    return std::move(*loaded);
  }

 private:
  std::filesystem::path folder_;
};

std::string number_text(FuzzInput& input) {
  static constexpr const char* odd[] = {"0/0", "1/0", "-1/0", "math.mininteger", "1e300", "-0.0", "2^53"};
  if (input.below(6) == 0) return odd[input.below(static_cast<uint32_t>(std::size(odd)))];
  const int whole = static_cast<int>(input.byte()) - 100;
  return std::to_string(whole) + "/" + std::to_string(1 + input.below(9));
}

std::string text_text(FuzzInput& input) {
  static constexpr const char* words[] = {"box",   "sphere", "capsule", "rock",     "world", "red",
                                          "hinge", "pit",    "islands", "\\0\\255", ""};
  return "'" + std::string(words[input.below(static_cast<uint32_t>(std::size(words)))]) + "'";
}

std::string field_name(FuzzInput& input) {
  const auto tables = request_field_tables();
  const FieldTable& table = *tables[input.below(static_cast<uint32_t>(tables.size()))];
  if (table.rows.empty()) return "at";
  return std::string(table.rows[input.below(static_cast<uint32_t>(table.rows.size()))].name);
}

std::string value_text(FuzzInput& input, int depth) {
  switch (input.below(depth > 2 ? 8 : 10)) {
    case 0:
      return "nil";
    case 1:
      return input.flag() ? "true" : "false";
    case 2:
    case 3:
      return number_text(input);
    case 4:
      return text_text(input);
    case 5:
      return "vec(" + number_text(input) + "," + number_text(input) + "," + number_text(input) + ")";
    case 6:
      return input.flag() ? "bodies.all()[1]" : "persons.all()[1]";
    case 7:
      return "function(r) made[1] = r.body or made[1] end";
    default: {
      std::string table = "{";
      for (uint32_t i = input.below(5); i > 0; --i)
        table += "['" + field_name(input) + "']=" + value_text(input, depth + 1) + ",";
      return table + "}";
    }
  }
}

/// A call of any function, or of a method of what the world has.
std::string call_text(FuzzInput& input) {
  static const std::vector<ApiFunction> all = all_api();
  const ApiFunction& row = all[input.below(static_cast<uint32_t>(all.size()))];
  std::string text;
  if (row.table.ends_with(':'))
    text = "(" + value_text(input, 3) + "):" + std::string(row.name);
  else
    text = std::string(row.table) + (row.table.empty() ? "" : ".") + std::string(row.name);
  text += "(";
  for (uint32_t i = 0, count = input.below(5); i < count; ++i)
    text += (i == 0 ? "" : ",") + value_text(input, 0);
  return text + ")";
}

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  static const QuietRules quiet;
  FuzzInput input(data, size);
  const auto rules = quiet.load();
  size_t answers = 0, lines = 0;
  HostActs acts;
  acts.send = [&](uint64_t, const ServerMessage& message) {
    answers += std::holds_alternative<AdminListMessage>(message) ? 1 : 0;
  };
  rules->start(acts);
  rules->join({.session = 1, .name = "anna", .role = Role::builder, .meets = true});
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 1.0F};
  World world(config);
  while (!input.at_end() && lines < lines_most) {
    for (uint32_t i = 1 + input.below(3); i > 0 && !input.at_end(); --i) {
      std::string line = call_text(input);
      if (input.below(4) == 3) line = "for i = 1, 40 do pcall(function() " + line + " end) end";
      rules->control(1, static_cast<uint32_t>(++lines), {RulesControl::console, "", line});
    }
    TickCommands commands({});
    rules->before(world, commands);
    CHECK_LE(commands.added(), limits::rules_commands_max);
    const auto delta = world.step(commands.let_through());
    rules->after(*delta);
    CHECK_EQ(delta->ledger.error(), 0);
  }
  TickCommands commands({});
  rules->before(world, commands);
  CHECK_EQ(answers, lines);
  CHECK_LE(world.game().kept->size(), limits::kept_values_max);
  return 0;
}
