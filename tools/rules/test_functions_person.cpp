// What tests do with persons, and what these see and hear.
#include <cmath>
#include <glm/geometric.hpp>

#include "server/rules/values.h"
#include "shared/base/kind_table.h"
#include "tools/rules/test_script.h"

namespace scree {

namespace {

/// Until a person who joined has to stand.
constexpr int standing_ticks_max = 60;

Result<void> stand_up(TestWorld& world, uint64_t session, const std::optional<glm::vec3>& at_m) {
  if (at_m)
    world.ask(0, RulesRequest{SetPlayer{.session = session, .place_m = at_m}});
  else
    world.ask(session, StandRequest{});
  for (int i = 0; i < standing_ticks_max; ++i) {
    world.step();
    if (world.place_of(session)) return {};
  }
  return fail("the person does not stand: the rules may not allow it");
}

Result<void> join(TestCall& call) {
  TestWorld* const world = TRY(call.world());
  const std::string name(TRY(call.argument(1, "name").text()));
  const ScriptValue options = call.argument(2, "options");
  Role role = Role::builder;
  std::string team;
  std::optional<glm::vec3> at_m;
  if (!options.is_nil())
    TRY(options.each([&](const ScriptValue& key, const ScriptValue& value) -> Result<void> {
      const std::string_view option = TRY(key.text());
      if (option == "team") {
        team = TRY(value.text());
      } else if (option == "at") {
        at_m = TRY(read_vec(value));
      } else if (option == "role") {
        const auto named = kind_named<Role>(TRY(value.text()));
        if (!named) return value.refuse("a role is viewer, carver, builder, director or admin");
        role = *named;
      } else {
        return key.refuse("options of who joins are role, team and at");
      }
      return {};
    }));
  const uint64_t session = world->join(name, role, team);
  world->step();
  const bool walks = world->world().config().service.persons == Persons::walk;
  if (at_m && !walks) return fail("only in a world whose persons walk does somebody stand at a place");
  if (walks && (at_m || !world->place_of(session))) TRY(stand_up(*world, session, at_m));
  call.results().handle({person_type, session});
  return {};
}

Result<void> leave(TestCall& call) {
  const uint64_t session = TRY(call.person(1));
  TestWorld* const world = TRY(call.world());
  world->leave(session);
  world->step();
  return {};
}

/// The direction over the ground from the feet to a place, of length 1 or, near it, less.
glm::vec3 way_to(const PersonPlace& from, glm::vec3 to_m) {
  glm::vec3 way = to_m - from.walker.feet_m;
  way.y = 0.0F;
  const float length_m = glm::length(way);
  return length_m > 1.0F ? way / length_m : way;
}

struct Walk {
  std::optional<glm::vec3> to_m;
  WalkRequest input;
};

Result<Walk> read_walk(const ScriptValue& table) {
  Walk walk;
  TRY(table.each([&](const ScriptValue& key, const ScriptValue& value) -> Result<void> {
    const std::string_view name = TRY(key.text());
    if (name == "to")
      walk.to_m = TRY(read_vec(value));
    else if (name == "go")
      walk.input.input.go = TRY(read_vec(value));
    else if (name == "look")
      walk.input.look = TRY(read_unit(value));
    else if (name == "fast")
      walk.input.input.fast = TRY(value.boolean());
    else if (name == "jump")
      walk.input.input.jump = TRY(value.boolean());
    else
      return key.refuse("a walk has go or to, look, fast and jump");
    return {};
  }));
  return walk;
}

Result<void> walk(TestCall& call) {
  const uint64_t session = TRY(call.person(1));
  Walk walk = TRY(read_walk(call.argument(2, "how")));
  const double seconds = TRY(call.argument(3, "seconds").number());
  TestWorld* const world = TRY(call.world());
  const auto ticks = static_cast<int>(std::lround(seconds * world->rate_hz()));
  for (int i = 0; i < ticks; ++i) {
    const auto place = world->place_of(session);
    if (!place) return fail("the person is not on foot");
    if (walk.to_m) walk.input.input.go = way_to(*place, *walk.to_m);
    world->walk(session, walk.input);
    world->step();
  }
  return {};
}

Result<void> say(TestCall& call) {
  const uint64_t session = TRY(call.person(1));
  TestWorld* const world = TRY(call.world());
  world->say(session, std::string(TRY(call.argument(2, "text").text())));
  world->step();
  world->step();  // what the rules answer is told a tick later
  return {};
}

Result<void> send(TestCall& call) {
  const uint64_t session = TRY(call.person(1));
  const std::string_view bytes = TRY(call.argument(3, "bytes").text());
  ChannelData data{std::string(TRY(call.argument(2, "channel").text())), {bytes.begin(), bytes.end()}};
  TRY(validate(data));
  TestWorld* const world = TRY(call.world());
  world->send(session, std::move(data));
  world->step();
  world->step();
  return {};
}

void write_sign(ScriptWriter& to, const Sign& sign, const TestWorld& world) {
  const auto text = [&](std::string_view name, std::string_view value) {
    to.name(name);
    to.text(value);
  };
  to.open_table();
  text("name", sign.name);
  text("text", sign.text);
  text("kind", row_of(sign.kind).name);
  to.name("share");
  to.number(sign.share);
  if (sign.kind == SignKind::marker) {
    to.name("at");
    to.vector(sign.place_m.x, sign.place_m.y, sign.place_m.z);
  }
  if (sign.until != 0) {
    to.name("left");
    to.number((static_cast<double>(sign.until) - static_cast<double>(world.tick())) / world.rate_hz());
  }
  to.close_table();
}

Result<void> signs(TestCall& call) {
  const uint64_t session = TRY(call.person(1));
  TestWorld* const world = TRY(call.world());
  call.results().open_table();
  for (const Sign& sign : world->signs_of(session)) write_sign(call.results(), sign, *world);
  call.results().close_table();
  return {};
}

/// Also of somebody who is gone.
Result<const TestPerson*> ever_here(const TestCall& call) {
  const uint64_t session = TRY(call.argument(1, "person").handle(person_type));
  const TestPerson* const person = TRY(call.world())->person(session);
  if (person == nullptr) return fail("there never was such a person in this world");
  return person;
}

Result<void> lines(TestCall& call) {
  const TestPerson* const person = TRY(ever_here(call));
  call.results().open_table();
  for (const std::string& line : person->lines) call.results().text(line);
  call.results().close_table();
  return {};
}

Result<void> messages(TestCall& call) {
  const TestPerson* const person = TRY(ever_here(call));
  ScriptWriter& to = call.results();
  to.open_table();
  for (const ChannelData& data : person->messages) {
    to.open_table();
    to.name("channel");
    to.text(data.channel);
    to.name("bytes");
    to.text({reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size()});
    to.close_table();
  }
  to.close_table();
  return {};
}

Result<void> here(TestCall& call) {
  call.results().boolean(TRY(ever_here(call))->here);
  return {};
}

Result<void> team(TestCall& call) {
  const uint64_t session = TRY(call.person(1));
  call.results().text(TRY(call.world())->team_of(session));
  return {};
}

Result<void> where(TestCall& call) {
  const uint64_t session = TRY(call.person(1));
  const auto there = TRY(call.world())->place_of(session);
  if (there)
    write_vec(call.results(), there->walker.feet_m);
  else
    call.results().nil();
  return {};
}

constexpr TestFunction person_rows[] = {
    {"join", "name: string, options?: join_options", "person",
     "Somebody joins: with `role` (builder as usual), `team`, and in a world whose persons walk `at`.", join},
    {"leave", "person: person", "", "The person's connection ends.", leave},
    {"here", "person: person", "boolean", "Whether the person is still connected.", here},
    {"team", "person: person", "string", "The person's team.", team},
    {"where", "person: person", "vec?", "Where the feet are, of who is on foot.", where},
    {"walk", "person: person, how: walk, seconds: number", "",
     "The person walks: `go` is a direction, or `to` a place; with `look`, `fast` and `jump`.", walk},
    {"say", "person: person, text: string", "", "The person says a line.", say},
    {"send", "person: person, channel: string, bytes: string", "",
     "The person's program sends bytes to the rules.", send},
    {"signs", "person: person", "sign[]",
     "What the person's screen shows: `name`, `text`, `kind`, `share`, `at`, and `left` in seconds.", signs},
    {"lines", "person: person", "string[]", "All lines that the person got.", lines},
    {"messages", "person: person", "message[]", "All bytes that the person's program got.", messages},
};

}  // namespace

std::span<const TestFunction> test_person_functions() {
  return person_rows;
}

}  // namespace scree
