// Bodies: pieces, props and persons' bodies, by handles. One that is gone answers nil, and actions on it
// false: pieces become terrain at any time, and a script cannot know when.
#include <glm/geometric.hpp>

#include "server/rules/api/asking.h"
#include "server/rules/api/parts.h"
#include "server/rules/request_fields.h"
#include "server/rules/request_table.h"

namespace scree {

namespace {

Result<std::optional<BodyFacts>> own(RulesCall& call) {
  call.call.charge(work_of_body);
  return world_of(call).body(TRY(read_body(call.argument(1, "body"))));
}

/// Answers by a function of the facts and the results.
template <typename Write>
Result<void> answer(RulesCall& call, const Write& write) {
  if (const std::optional<BodyFacts> facts = TRY(own(call)))
    write(*facts, call.results());
  else
    call.results().nil();
  return {};
}

uint64_t person_of(RulesCall& call, PieceId body) {
  for (const PersonPlace& person : call.moment.places())
    if (person.body == body) return person.session;
  return 0;
}

Result<void> exists(RulesCall& call) {
  call.results().boolean(TRY(own(call)).has_value());
  return {};
}

Result<void> number(RulesCall& call) {
  call.results().integer(TRY(read_body(call.argument(1, "body"))));
  return {};
}

Result<void> kind(RulesCall& call) {
  return answer(call, [&](const BodyFacts& facts, ScriptWriter& to) {
    to.text(facts.is_piece ? "piece" : person_of(call, facts.id) != 0 ? "person" : "prop");
  });
}

Result<void> place(RulesCall& call) {
  return answer(call, [](const BodyFacts& facts, ScriptWriter& to) { write_vec(to, facts.pose.position_m); });
}

Result<void> turn(RulesCall& call) {
  return answer(call, [](const BodyFacts& facts, ScriptWriter& to) { write_turn(to, facts.pose.rotation); });
}

Result<void> velocity(RulesCall& call) {
  return answer(call, [](const BodyFacts& facts, ScriptWriter& to) { write_vec(to, facts.velocity_m_s); });
}

Result<void> spin(RulesCall& call) {
  return answer(call, [](const BodyFacts& facts, ScriptWriter& to) { write_vec(to, facts.spin_rad_s); });
}

Result<void> mass(RulesCall& call) {
  return answer(call, [](const BodyFacts& facts, ScriptWriter& to) { to.number(facts.mass_kg); });
}

Result<void> volume(RulesCall& call) {
  return answer(call, [&](const BodyFacts& facts, ScriptWriter& to) {
    if (facts.is_piece)
      to.number(cubic_metres(facts.mass, call.moment));
    else
      to.nil();
  });
}

Result<void> reach(RulesCall& call) {
  return answer(call, [](const BodyFacts& facts, ScriptWriter& to) { to.number(facts.reach_m); });
}

Result<void> owner(RulesCall& call) {
  return answer(call,
                [&](const BodyFacts& facts, ScriptWriter& to) { write_party(to, facts.owner, call.moment); });
}

Result<void> person(RulesCall& call) {
  return answer(call, [&](const BodyFacts& facts, ScriptWriter& to) {
    write_party(to, person_of(call, facts.id), call.moment);
  });
}

Result<void> tag(RulesCall& call) {
  return answer(
      call, [](const BodyFacts& facts, ScriptWriter& to) { to.integer(static_cast<int64_t>(facts.tag)); });
}

Result<void> kept(RulesCall& call) {
  return answer(call, [](const BodyFacts& facts, ScriptWriter& to) { to.boolean(facts.kept); });
}

/// Asks for something of a body that is there; false where it is gone.
template <typename Make>
Result<void> act(RulesCall& call, const Make& make) {
  const std::optional<BodyFacts> facts = TRY(own(call));
  if (facts) TRY(ask_world(call, TRY(make(*facts))));
  call.results().boolean(facts.has_value());
  return {};
}

Result<void> push(RulesCall& call) {
  return act(call, [&](const BodyFacts& facts) -> Result<Request> {
    const ScriptValue at = call.argument(3, "at");
    return PushRequest{facts.id, TRY(read_vec(call.argument(2, "impulse"))),
                       at.is_nil() ? facts.pose.position_m : TRY(read_vec(at))};
  });
}

/// The fields of a table that a method gets, over a request that names the body.
template <typename Ask>
Result<Request> with_fields(RulesCall& call, Ask ask, const FieldTable& fields) {
  const ScriptValue table = call.argument(2, fields.name);
  if (!table.is_nil()) TRY(read_fields(&ask, table, fields, call.moment, {}, FieldsNeeded::none));
  return Request(std::move(ask));
}

Result<void> move(RulesCall& call) {
  return act(call, [&](const BodyFacts& facts) {
    return with_fields(call, MovePropRequest{.prop = facts.id}, move_prop_fields);
  });
}

Result<void> shatter(RulesCall& call) {
  return act(call, [&](const BodyFacts& facts) {
    return with_fields(
        call,
        BreakRequest{
            .piece = facts.id, .at_m = facts.pose.position_m, .random_seed = random_seed_of(call.moment)},
        break_fields);
  });
}

Result<void> remove(RulesCall& call) {
  return act(call, [](const BodyFacts& facts) -> Result<Request> { return RemovePropRequest{facts.id}; });
}

Result<void> release(RulesCall& call) {
  return act(call, [](const BodyFacts& facts) -> Result<Request> { return ReleaseRequest{facts.id}; });
}

void write_bodies(RulesCall& call, const std::vector<PieceId>& ids) {
  call.call.charge(work_of_body * static_cast<int64_t>(ids.size()));
  call.results().open_table();
  for (const PieceId id : ids) write_body(call.results(), id);
  call.results().close_table();
}

Result<void> near(RulesCall& call) {
  const glm::vec3 at = TRY(read_vec(call.argument(1, "at")));
  const float radius = TRY(read_float(call.argument(2, "radius")));
  const World& world = world_of(call);
  std::vector<PieceId> ids = world.bodies_near(at - radius, at + radius);
  call.call.charge(work_of_body * static_cast<int64_t>(ids.size()));
  std::erase_if(ids, [&](PieceId id) {
    const auto facts = world.body(id);
    return !facts || !(glm::distance(facts->pose.position_m, at) <= radius);
  });
  write_bodies(call, ids);
  return {};
}

Result<void> all(RulesCall& call) {
  constexpr float beyond_m = 1e6F;
  write_bodies(call, world_of(call).bodies_near(glm::vec3(-beyond_m), glm::vec3(beyond_m)));
  return {};
}

Result<void> get(RulesCall& call) {
  const PieceId id = TRY(read_body(call.argument(1, "number")));
  if (world_of(call).body(id))
    write_body(call.results(), id);
  else
    call.results().nil();
  return {};
}

Result<void> add(RulesCall& call) {
  return ask_by_table(call, "add_prop");
}

constexpr ApiFunction list_rows[] = {
    {"bodies", "all", "", "body[]", "All bodies, by number: pieces, props and the bodies of persons on foot.",
     "log(#bodies.all() .. \" bodies\")", all},
    {"bodies", "near", "at: vec, radius: number", "body[]", "The bodies whose place lies in a ball.",
     "for _, body in ipairs(bodies.near(vec(0, 0, 0), 10)) do body:push(vec(0, 100, 0)) end", near},
    {"bodies", "get", "number: integer", "body?", "The body of a number, as `body:number()` gives it.",
     "assert(bodies.get(123456) == nil)", get},
    {"bodies", "add", "what: add_prop, reply?: fun(reply: reply)", "",
     "Adds a body of the game, such as a crate or a ball; the reply has it.",
     "bodies.add({ box = vec(0.5, 0.5, 0.5), at = vec(0, 3, 0), mass = 20, tag = 7 },\n"
     "  function(reply) if reply.body then reply.body:push(vec(50, 0, 0)) end end)\n"
     "bodies.add{ sphere = 0.3, at = vec(2, 3, 0), material = \"ice\", velocity = vec(0, 0, 4) }",
     add},
};

#define FOR_BODIES(call) "for _, body in ipairs(bodies.all()) do " call " end"

constexpr ApiFunction handle_rows[] = {
    {"body:", "exists", "", "boolean", "Whether it is still there: pieces at rest become terrain.",
     FOR_BODIES("assert(body:exists())"), exists},
    {"body:", "number", "", "integer", "Its number, which no other body ever gets.",
     FOR_BODIES("log(\"body \" .. body:number())"), number},
    {"body:", "kind", "", "string?", "`piece`, `prop` or `person`; nil, as all that follows: it is gone.",
     FOR_BODIES("assert(body:kind())"), kind},
    {"body:", "place", "", "vec?", "Where it is: the middle of a piece, the origin of a prop.",
     FOR_BODIES("if body:place().y < -20 then log(\"deep\") end"), place},
    {"body:", "turn", "", "turn?", "How it is turned.", FOR_BODIES("local t = body:turn()"), turn},
    {"body:", "velocity", "", "vec?", "m/s.",
     FOR_BODIES("if body:velocity():length() > 20 then log(\"fast\") end"), velocity},
    {"body:", "spin", "", "vec?", "rad/s.", FOR_BODIES("local s = body:spin()"), spin},
    {"body:", "mass", "", "number?", "kg.", FOR_BODIES("if body:mass() > 1000 then log(\"heavy\") end"),
     mass},
    {"body:", "volume", "", "number?", "m³ of a piece's rock; nil of props.",
     FOR_BODIES("local v = body:volume() or 0"), volume},
    {"body:", "reach", "", "number?", "How far it reaches from its place, metres.",
     FOR_BODIES("local r = body:reach()"), reach},
    {"body:", "owner", "", "person?", "Who made it, by a carve or a fall; nil: nobody, or he has left.",
     FOR_BODIES("local by = body:owner() if by then log(by:name()) end"), owner},
    {"body:", "person", "", "person?", "Whose body it is; nil: it is no person's.",
     FOR_BODIES("local who = body:person() if who then who:say(\"you\") end"), person},
    {"body:", "tag", "", "integer?", "The number that the game gave a prop; 0: none.",
     FOR_BODIES("if body:tag() == 7 then log(\"the crate\") end"), tag},
    {"body:", "kept", "", "boolean?", "Whether a piece stays a piece until it is released.",
     FOR_BODIES("local k = body:kept()"), kept},
    {"body:", "push", "impulse: vec, at?: vec", "boolean",
     "Gives it an impulse, newton seconds, at its middle or at a place on it. False, as of all that follow: "
     "it "
     "is gone.",
     FOR_BODIES("body:push(vec(0, body:mass() * 2, 0))"), push},
    {"body:", "move", "to: move_prop", "boolean",
     "Puts a prop elsewhere, or changes how it moves; what is left out stays.",
     FOR_BODIES(
         "if body:kind() == \"prop\" then body:move{ at = vec(0, 5, 0), velocity = vec(0, 0, 0) } end"),
     move},
    {"body:", "remove", "", "boolean", "Takes a prop away.",
     FOR_BODIES("if body:kind() == \"prop\" then body:remove() end"), remove},
    {"body:", "shatter", "how?: break", "boolean", "Breaks a piece, about its middle or a place.",
     FOR_BODIES("if body:kind() == \"piece\" then body:shatter{ pieces = 4 } end"), shatter},
    {"body:", "release", "", "boolean", "Lets a kept piece become terrain.",
     FOR_BODIES("if body:kept() then body:release() end"), release},
};

#undef FOR_BODIES

}  // namespace

std::span<const ApiFunction> handle_api() {
  return handle_rows;
}

std::span<const ApiFunction> body_api() {
  static const std::vector<ApiFunction> rows = [] {
    std::vector<ApiFunction> made(std::begin(list_rows), std::end(list_rows));
    for (const std::span<const ApiFunction> part : {handle_api(), joint_api()})
      made.insert(made.end(), part.begin(), part.end());
    return made;
  }();
  return rows;
}

}  // namespace scree
