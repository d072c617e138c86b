// Persons: who is here, where, and what the rules make of them.
#include <algorithm>

#include "server/formats/world_value.h"
#include "server/rules/api.h"
#include "server/rules/mod.h"
#include "server/rules/values.h"
#include "shared/base/kind_table.h"
#include "shared/base/text.h"
#include "shared/person/walker.h"

namespace scree {

namespace {

/// The person of the method's handle; an error where the person is not here any more.
Result<const RulesPerson*> own(const RulesCall& call) {
  const uint64_t session = TRY(call.argument(1, "person").handle("person"));
  const auto at = call.moment.persons->find(session);
  if (at == call.moment.persons->end())
    return fail("the person of session " + std::to_string(session) + " is gone");
  return &at->second;
}

const PersonPlace* place_of(const RulesCall& call, uint64_t session) {
  const std::vector<PersonPlace>& places = call.moment.places();
  const auto at = std::ranges::lower_bound(places, session, {}, &PersonPlace::session);
  return at != places.end() && at->session == session ? &*at : nullptr;
}

std::string team_of(const RulesCall& call, const RulesPerson& person) {
  const std::vector<Player>& players = *call.moment.world->game().players;
  const auto at = std::ranges::lower_bound(players, person.who.session, {}, &Player::session);
  const bool has_team = at != players.end() && at->session == person.who.session && !at->team.empty();
  return has_team ? at->team : person.who.team;
}

Result<void> change(RulesCall& call, SetPlayer player) {
  TRY(call.mod.ask(call.moment, RulesRequest{std::move(player)}, 0));
  return {};
}

Result<void> all(RulesCall& call) {
  call.results().open_table();
  for (const auto& [session, person] : *call.moment.persons) call.results().handle({"person", session});
  call.results().close_table();
  return {};
}

Result<void> named(RulesCall& call) {
  const std::string_view name = TRY(call.argument(1, "name").text());
  for (const auto& [session, person] : *call.moment.persons) {
    if (person.who.name != name) continue;
    call.results().handle({"person", session});
    return {};
  }
  call.results().nil();
  return {};
}

Result<void> get(RulesCall& call) {
  const int64_t session = TRY(call.argument(1, "session").integer());
  if (session > 0 && call.moment.persons->contains(static_cast<uint64_t>(session)))
    call.results().handle({"person", static_cast<uint64_t>(session)});
  else
    call.results().nil();
  return {};
}

Result<void> is_here(RulesCall& call) {
  call.results().boolean(call.moment.persons->contains(TRY(call.argument(1, "person").handle("person"))));
  return {};
}

Result<void> session(RulesCall& call) {
  call.results().integer(static_cast<int64_t>(TRY(call.argument(1, "person").handle("person"))));
  return {};
}

Result<void> name(RulesCall& call) {
  const RulesPerson& person = *TRY(own(call));
  call.results().text(person.who.name.empty() ? "person " + std::to_string(person.who.session)
                                              : person.who.name);
  return {};
}

Result<void> role(RulesCall& call) {
  call.results().text(row_of(TRY(own(call))->who.role).name);
  return {};
}

Result<void> team(RulesCall& call) {
  call.results().text(team_of(call, *TRY(own(call))));
  return {};
}

Result<void> on_foot(RulesCall& call) {
  call.results().boolean(place_of(call, TRY(own(call))->who.session) != nullptr);
  return {};
}

Result<void> place(RulesCall& call) {
  const PersonPlace* const there = place_of(call, TRY(own(call))->who.session);
  if (there != nullptr)
    write_vec(call.results(), there->walker.feet_m);
  else
    call.results().nil();
  return {};
}

Result<void> look(RulesCall& call) {
  const PersonPlace* const there = place_of(call, TRY(own(call))->who.session);
  if (there != nullptr)
    write_vec(call.results(), there->look);
  else
    call.results().nil();
  return {};
}

Result<void> body(RulesCall& call) {
  const PersonPlace* const there = place_of(call, TRY(own(call))->who.session);
  if (there != nullptr)
    call.results().handle({"body", there->body});
  else
    call.results().nil();
  return {};
}

Result<void> set_team(RulesCall& call) {
  const uint64_t session = TRY(own(call))->who.session;
  return change(call, {.session = session, .team = std::string(TRY(call.argument(2, "team").text()))});
}

Result<void> set_pace(RulesCall& call) {
  const uint64_t session = TRY(own(call))->who.session;
  const auto pace = static_cast<float>(TRY(call.argument(2, "times").number()));
  if (!(pace >= 0.0F && pace <= limits::walk_pace_max))
    return call.argument(2, "times").refuse("a pace is 0 to 3 times the usual one");
  return change(call, {.session = session, .pace = pace});
}

Result<void> stand(RulesCall& call) {
  const uint64_t session = TRY(own(call))->who.session;
  return change(call, {.session = session, .place_m = TRY(read_vec(call.argument(2, "at")))});
}

Result<void> set_role(RulesCall& call) {
  const uint64_t session = TRY(own(call))->who.session;
  const ScriptValue wanted = call.argument(2, "role");
  const auto role = kind_named<Role>(TRY(wanted.text()));
  if (!role || *role == Role::admin) return wanted.refuse("a role is viewer, carver, builder or director");
  call.moment.acts->set_role(session, *role);
  return {};
}

Result<void> kick(RulesCall& call) {
  const uint64_t session = TRY(own(call))->who.session;
  const ScriptValue words = call.argument(2, "words");
  const std::string text = words.is_nil() ? "the rules ended this session" : std::string(TRY(words.text()));
  call.moment.acts->kick(session, showable(text, limits::notice_line_bytes_max));
  return {};
}

Result<void> tell(RulesCall& call) {
  const uint64_t session = TRY(own(call))->who.session;
  const std::string_view text = TRY(call.argument(2, "text").text());
  Notice notice;
  notice.to.kind = AudienceKind::session;
  notice.to.session = session;
  notice.what = NoticeLine{showable(std::string(text), limits::notice_line_bytes_max)};
  if (const Result<void> valid = validate(notice); !valid) return fail(valid.error().message);
  TRY(call.mod.ask(call.moment, RulesRequest{std::move(notice)}, 0));
  return {};
}

constexpr ApiFunction rows[] = {
    {"persons", "all", "", "person[]", "Everybody who is connected, but for administrators' programs.",
     "for _, p in ipairs(persons.all()) do log(p:name()) end", all},
    {"persons", "named", "name: string", "person?", "The first person of that name.",
     "assert(persons.named(\"nobody\") == nil)", named},
    {"persons", "get", "session: integer", "person?", "The person of a session's number.",
     "assert(persons.get(12345) == nil)", get},
    {"person:", "here", "", "boolean", "Whether the person is still connected. All other methods need that.",
     "for _, p in ipairs(persons.all()) do assert(p:here()) end", is_here},
    {"person:", "session", "", "integer", "The session's number.",
     "for _, p in ipairs(persons.all()) do log(p:session()) end", session},
    {"person:", "name", "", "string",
     "The name. Anybody may say any name: for what counts, use access tokens (docs/host.md).",
     "for _, p in ipairs(persons.all()) do log(p:name()) end", name},
    {"person:", "role", "", "string", "viewer, carver, builder, director or admin, as he joined.",
     "for _, p in ipairs(persons.all()) do log(p:role()) end", role},
    {"person:", "team", "", "string", "The team that the rules gave, or else the access token's; \"\": none.",
     "for _, p in ipairs(persons.all()) do log(p:team()) end", team},
    {"person:", "on_foot", "", "boolean", "Whether the person walks in the world.",
     "for _, p in ipairs(persons.all()) do log(tostring(p:on_foot())) end", on_foot},
    {"person:", "place", "", "vec?", "Where the feet are, of who is on foot.",
     "for _, p in ipairs(persons.all()) do local at = p:place() end", place},
    {"person:", "look", "", "vec?", "The direction of the eyes, of who is on foot: of length 1.",
     "for _, p in ipairs(persons.all()) do local d = p:look() end", look},
    {"person:", "body", "", "body?", "The body, of who is on foot.",
     "for _, p in ipairs(persons.all()) do local b = p:body() end", body},
    {"person:", "set_team", "team: string", "",
     "Puts the person into a team, from the next tick on and until the session ends: regions that let teams "
     "edit "
     "go by it. \"\": the access token's counts again.",
     "for _, p in ipairs(persons.all()) do p:set_team(\"red\") end", set_team},
    {"person:", "set_pace", "times: number", "", "How fast the person walks: 0 to 3 times the usual.",
     "for _, p in ipairs(persons.all()) do p:set_pace(1.5) end", set_pace},
    {"person:", "stand", "at: vec", "",
     "Puts the person there on foot, the feet at that place; where persons walk (`persons` is `walk`).",
     "for _, p in ipairs(persons.all()) do p:stand(vec(0, 2, 0)) end", stand},
    {"person:", "set_role", "role: string", "",
     "What the person may ask for, until the session ends: viewer, carver, builder or director.",
     "for _, p in ipairs(persons.all()) do p:set_role(\"builder\") end", set_role},
    {"person:", "kick", "words?: string", "", "Ends the session, with these words.",
     "for _, p in ipairs(persons.all()) do if p:name() == \"cheat\" then p:kick(\"play fair\") end end",
     kick},
    {"person:", "say", "text: string", "", "A line for this person alone.",
     "for _, p in ipairs(persons.all()) do p:say(\"welcome\") end", tell},
};

}  // namespace

std::span<const ApiFunction> person_api() {
  return rows;
}

}  // namespace scree
