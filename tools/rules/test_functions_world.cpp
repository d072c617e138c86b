// What tests do with the world: make it, ask for things in it, let time pass, end it.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "server/formats/world_value.h"
#include "server/rules/api.h"
#include "server/rules/request_table.h"
#include "server/rules/sandbox/json_values.h"
#include "server/world/settings.h"
#include "shared/base/check.h"
#include "shared/base/kind_table.h"
#include "tools/rules/test_script.h"

namespace scree {

namespace {

constexpr double longest_s = 3600.0;
/// Until a request has to be answered.
constexpr int reply_ticks_max = 600;

Result<std::string> setting_text(const ScriptValue& value) {
  if (value.is_boolean()) return std::string(TRY(value.boolean()) ? "true" : "false");
  if (value.is_text()) return std::string(TRY(value.text()));
  return fmt::format("{:g}", TRY(value.number()));
}

Result<void> read_settings(const ScriptValue& table, WorldConfig& config) {
  return table.each([&](const ScriptValue& key, const ScriptValue& value) -> Result<void> {
    std::string name(TRY(key.text()));
    std::ranges::replace(name, '_', '-');
    const std::string text = TRY(setting_text(value));
    if (const Result<void> done = set(config, {name, text}); !done) return value.refuse(done.error().message);
    return {};
  });
}

Result<void> read_option(std::string_view name, const ScriptValue& value, WorldConfig& config) {
  if (name == "terrain") {
    const auto kind = kind_named<TerrainKind>(TRY(value.text()));
    if (!kind) return value.refuse("a terrain is flat, noise or canyon");
    config.terrain.kind = *kind;
  } else if (name == "voxel") {
    config.terrain.voxel_size_m = static_cast<float>(TRY(value.number()));
  } else if (name == "seed") {
    config.terrain.random_seed = static_cast<uint32_t>(TRY(value.integer()));
  } else if (name == "persons") {
    if (const auto done = set(config, {"persons", std::string(TRY(value.text()))}); !done)
      return value.refuse(done.error().message);
  } else if (name == "settings") {
    return read_settings(value, config);
  } else {
    return value.refuse("options of a world are terrain, voxel, seed, persons and settings");
  }
  return {};
}

Result<void> make(TestCall& call) {
  const ScriptValue options = call.argument(1, "options");
  return make_world(call.test(), options.is_nil() ? nullptr : &options);
}

Result<int> ticks_of(const TestCall& call, const ScriptValue& seconds) {
  const double s = TRY(seconds.number());
  if (!(s >= 0.0 && s <= longest_s)) return seconds.refuse("a test waits 0 to 3,600 s at once");
  const auto world = TRY(call.world());
  return static_cast<int>(std::lround(s * world->rate_hz()));
}

Result<void> step(TestCall& call) {
  const ScriptValue ticks = call.argument(1, "ticks");
  const int64_t count = ticks.is_nil() ? 1 : TRY(ticks.integer());
  TestWorld* const world = TRY(call.world());
  if (count < 0 || count > static_cast<int64_t>(longest_s * world->rate_hz()))
    return ticks.refuse("a test waits 0 to 3,600 s at once");
  for (int64_t i = 0; i < count; ++i) world->step();
  return {};
}

Result<void> seconds(TestCall& call) {
  const int ticks = TRY(ticks_of(call, call.argument(1, "seconds")));
  TestWorld* const world = TRY(call.world());
  for (int i = 0; i < ticks; ++i) world->step();
  return {};
}

Result<void> rate(TestCall& call) {
  call.results().integer(TRY(call.world())->rate_hz());
  return {};
}

Result<void> tick(TestCall& call) {
  call.results().integer(static_cast<int64_t>(TRY(call.world())->tick()));
  return {};
}

/// What is read as a script's own request is about the world's store; a person's is about his own.
void use_own_store(Request& request, const ScriptValue& fields) {
  const auto said = fields.field("store");
  if (!said || !said->is_nil()) return;
  if (auto* const dig = std::get_if<DigRequest>(&request)) dig->store = {};
  if (auto* const place = std::get_if<PlaceRequest>(&request)) place->store = {};
}

/// Asks, and waits for the reply.
Result<void> ask(TestCall& call, std::string_view kind, const ScriptValue& fields) {
  TestWorld* const world = TRY(call.world());
  const uint64_t session = call.argument(1, "person").is_nil() ? 0 : TRY(call.person(1));
  RulesMoment moment = world->moment();
  Request request = TRY(read_request(kind, fields, moment));
  if (session != 0) use_own_store(request, fields);
  const uint32_t number = world->ask(session, std::move(request));
  for (int i = 0; i < reply_ticks_max; ++i) {
    world->step();
    if (const auto reply = world->take_reply(session, number)) {
      write_reply(call.results(), *reply, world->moment());
      return {};
    }
  }
  return fail(fmt::format("there is no reply to the {} after {} ticks", kind, reply_ticks_max));
}

bool is_request_kind(std::string_view kind) {
  const auto kinds = test_request_kinds();
  return std::ranges::find(kinds, kind) != kinds.end();
}

Result<void> request(TestCall& call) {
  const ScriptValue kind = call.argument(2, "kind");
  const std::string name(TRY(kind.text()));
  if (!is_request_kind(name)) {
    std::string all;
    for (const std::string_view known : test_request_kinds())
      all += (all.empty() ? "" : ", ") + std::string(known);
    return kind.refuse("requests are " + all);
  }
  return ask(call, name, call.argument(3, "fields"));
}

template <size_t Index>
Result<void> request_of_kind(TestCall& call) {
  return ask(call, test_request_kinds()[Index], call.argument(2, "fields"));
}

Result<void> restart(TestCall& call) {
  TestWorld* const world = TRY(call.world());
  TRY(world->restart());
  world->step();
  return {};
}

Result<void> reload(TestCall& call) {
  return TRY(call.world())->reload();
}

Result<void> run(TestCall& call) {
  const ScriptValue rules = call.argument(2, "rules");
  const std::string name = rules.is_nil() ? std::string() : std::string(TRY(rules.text()));
  TestWorld* const world = TRY(call.world());
  call.results().text(world->run(name, std::string(TRY(call.argument(1, "line").text()))));
  return {};
}

Result<void> kept(TestCall& call) {
  const std::string key(TRY(call.argument(1, "key").text()));
  TestWorld* const world = TRY(call.world());
  for (const KeptValue& one : *world->world().game().kept) {
    const size_t slash = one.key.find('/');
    if (one.key.substr(slash + 1) == key) return write_json(call.results(), one.value);
  }
  call.results().nil();
  return {};
}

Result<void> ledger_error(TestCall& call) {
  call.results().integer(TRY(call.world())->ledger_error());
  return {};
}

Result<void> faults(TestCall& call) {
  call.test().faults_asked = true;
  call.results().integer(static_cast<int64_t>(TRY(call.world())->faults()));
  return {};
}

Result<void> log(TestCall& call) {
  call.results().open_table();
  for (const std::string& line : TRY(call.world())->log()) call.results().text(line);
  call.results().close_table();
  return {};
}

Result<void> cues(TestCall& call) {
  ScriptWriter& to = call.results();
  to.open_table();
  for (const TestCue& cue : TRY(call.world())->cues()) {
    to.open_table();
    to.name("kind");
    to.text(row_of(cue.cue.kind).name);
    to.name("at");
    to.vector(cue.cue.place_m.x, cue.cue.place_m.y, cue.cue.place_m.z);
    to.name("size");
    to.number(cue.cue.size_m);
    to.name("energy");
    to.number(cue.cue.energy_j);
    to.close_table();
  }
  to.close_table();
  return {};
}

constexpr TestFunction world_rows[] = {
    {"world", "options?: world_options", "",
     "Makes a world, with `terrain`, `voxel`, `seed`, `persons` and `settings`: flat, 0.25 m, and as usual. "
     "Without it, the first call that needs a world makes one.",
     make},
    {"step", "ticks?: integer", "", "Lets so many ticks pass; one as usual.", step},
    {"seconds", "seconds: number", "", "Lets time pass.", seconds},
    {"rate", "", "integer", "Ticks a second.", rate},
    {"tick", "", "integer", "The world's tick.", tick},
    {"request", "person: person?, kind: string, fields: table", "reply",
     "A person asks for something, with the fields of that kind; without a person, the server itself does. "
     "Time passes until there is a reply.",
     request},
    {"restart", "", "",
     "The server ends and starts again: the world and what was kept go on, persons have to join anew.",
     restart},
    {"reload", "", "", "The rules are read again, as by `scree rules reload`.", reload},
    {"run", "line: string, rules?: string", "string",
     "What a line of Lua gives in the rules, as text; a tick passes.", run},
    {"kept", "key: string", "any", "What the rules keep under a key.", kept},
    {"ledger_error", "", "integer", "Mass that is nowhere; 0 in a sound world.", ledger_error},
    {"faults", "", "integer",
     "Calls of the rules that failed. A test that never asks fails if there are any.", faults},
    {"log", "", "string[]", "What the rules printed, and their faults.", log},
    {"cues", "", "cue[]", "Sounds and puffs so far.", cues},
};

template <size_t... Index>
std::vector<TestFunction> request_rows(std::index_sequence<Index...>) {
  return {TestFunction{test_request_kinds()[Index], "person: person?, fields: table", "reply",
                       "As t:request of that kind.", request_of_kind<Index>}...};
}

/// The kind's name, where scripts can write such requests.
template <typename Kind>
void add_kind(std::vector<std::string_view>& kinds) {
  const std::string_view kind = kind_of(Request(Kind{}));
  const auto tables = request_field_tables();
  if (std::ranges::find(tables, kind, &FieldTable::name) != tables.end()) kinds.push_back(kind);
}

template <size_t... Index>
std::vector<std::string_view> writable_kinds(std::index_sequence<Index...>) {
  std::vector<std::string_view> kinds;
  (add_kind<std::variant_alternative_t<Index, Request>>(kinds), ...);
  return kinds;
}

/// The number of test_request_kinds(), which CHECKs it.
constexpr size_t kinds_written = 20;

}  // namespace

std::vector<std::string_view> test_request_kinds() {
  auto kinds = writable_kinds(std::make_index_sequence<std::variant_size_v<Request>>{});
  CHECK_EQ(kinds.size(), kinds_written);
  return kinds;
}

std::span<const TestFunction> test_world_functions() {
  static const std::vector<TestFunction> all = [] {
    std::vector<TestFunction> functions(std::begin(world_rows), std::end(world_rows));
    const auto kinds = request_rows(std::make_index_sequence<kinds_written>{});
    functions.insert(functions.end(), kinds.begin(), kinds.end());
    return functions;
  }();
  return all;
}

Result<void> make_world(RunningTest& test, const ScriptValue* options) {
  TestWorldOptions made{.folders = {test.folder}, .world = {}};
  made.world.terrain.kind = TerrainKind::flat;
  if (options != nullptr)
    TRY(options->each([&](const ScriptValue& key, const ScriptValue& value) -> Result<void> {
      return read_option(TRY(key.text()), value, made.world);
    }));
  if (test.world != nullptr) test.ticks += test.world->tick();
  test.world = TRY(TestWorld::create(std::move(made)));
  test.world->step();
  return {};
}

}  // namespace scree
