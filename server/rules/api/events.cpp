// The events that a script may have handlers for: their fields and examples.
#include "server/rules/api.h"

namespace scree {

namespace {

constexpr ApiEvent event_rows[] = {
    {"start", "reloaded: boolean, restarted: boolean", "",
     "The rules begin: with a new world, after a restart of the server (`restarted`), or because they were "
     "read "
     "again (`reloaded`). What they kept by `store.set` is there.",
     "on.start(function(e) if not e.restarted then store.set(\"round\", 1) end end)"},
    {"tick", "tick: integer, time: number, dt: number", "",
     "Each tick, before the world moves. Mind the budget: `every` and the other events do with less.",
     "on.tick(function(e) if e.tick % 60 == 0 then log(\"a second\") end end)"},
    {"join", "person: person, resumed: boolean", "",
     "A person joins; `resumed` where the connection was lost and the session goes on.",
     "on.join(function(e) say(e.person:name() .. \" is here\") end)"},
    {"leave", "person: person", "", "A person's connection ended.",
     "on.leave(function(e) say(e.person:name() .. \" is gone\") end)"},
    {"request", "kind: string, by: person, …: fields of the request", "string? | table?",
     "A person asks for something, before the world does it. Text that the handler returns refuses it with "
     "these "
     "words; a table changes the fields that it has; nothing, or true, lets it pass, and false refuses. "
     "Rules that fail, or have no time, "
     "refuse.",
     "on.request(function(r)\n  if r.kind == \"carve\" and r.radius > 1 then return \"one metre is enough\" "
     "end\nend)"},
    {"carve", "by: person?, at: vec, volume: number, mass: number, count: integer, pieces: body[]", "",
     "A request took terrain out and broke it: `volume` in m³, `mass` in kg of its pieces.",
     "on.carve(function(e) log(e.count .. \" pieces\") end)"},
    {"fill", "by: person?, at: vec", "", "Terrain was added by a request.",
     "on.fill(function(e) log(\"filled at \" .. e.at.x) end)"},
    {"paint", "by: person?, at: vec", "", "Terrain was painted.",
     "on.paint(function(e) log(\"painted\") end)"},
    {"dig", "by: person?, at: vec, volume: number", "", "Terrain, or a piece, was dug into a store.",
     "on.dig(function(e) log(e.volume .. \" m³ dug\") end)"},
    {"place", "by: person?, at: vec, volume: number", "", "A shape was placed out of a store.",
     "on.place(function(e) log(e.volume .. \" m³ placed\") end)"},
    {"broke",
     "by: person?, at: vec?, volume: number, mass: number, count: integer, pieces: body[], by_load: boolean?",
     "", "A piece broke, or a blow or the load on it (`by_load`) broke terrain.",
     "on.broke(function(e) log(\"broke into \" .. e.count) end)"},
    {"fall", "by: person?, at: vec, volume: number, mass: number, count: integer, pieces: body[]", "",
     "Terrain lost its hold and falls. `by` is whose request caused it, perhaps seconds ago.",
     "on.fall(function(e) if e.by then log(e.by:name() .. \" brought down \" .. e.mass .. \" kg\") end end)"},
    {"merge", "by: person?, at: vec, volume: number, mass: number, count: integer", "",
     "Pieces came to rest and are terrain again.",
     "on.merge(function(e) log(e.volume .. \" m³ came to rest\") end)"},
    {"impact", "at: vec, body: body?, other: body?, energy: number, impulse: number", "",
     "A hard blow of 100 J or more, the 16 hardest of a tick. Without `other`, terrain was struck.",
     "on.impact(function(e) if e.energy > 1e5 then log(\"a heavy blow\") end end)"},
    {"hurt", "person: person?, by: person?, body: body?, energy: number, at: vec", "",
     "Something struck a person on foot; `by` is who made it fly.",
     "on.hurt(function(e) if e.person then e.person:say(\"ouch\") end end)"},
    {"buried", "person: person?, at: vec", "", "Rock closed around a person on foot.",
     "on.buried(function(e) if e.person then e.person:stand(e.at + vec(0, 5, 0)) end end)"},
    {"enter", "region: string, person: person?, body: body?, at: vec?", "",
     "A person's body, a piece or a prop came into a region that tells (`tells = true`).",
     "on.enter(function(e) log(e.region .. \" was entered\") end)"},
    {"exit", "region: string, person: person?, body: body?, at: vec?", "",
     "It left the region, or is no more.", "on.exit(function(e) log(e.region .. \" was left\") end)"},
    {"joint_broken", "body: body?, other: body?, why: string, at: vec?", "",
     "A joint is no more: `removed`, `broken`, `let_go` (its rock is gone) or `body_gone`.",
     "on.joint_broken(function(e) log(\"a joint ended: \" .. e.why) end)"},
    {"message", "by: person, channel: string, bytes: string", "",
     "A person's program sent bytes to the rules.",
     "on.message(function(e) if e.channel == \"ping\" then message.send(\"pong\", e.bytes, e.by) end end)"},
    {"say", "by: person, text: string", "string? | boolean?",
     "A person says a line. Text that the handler returns keeps the line back and answers with these words; "
     "`false` keeps it back without a word.",
     "on.say(function(e) if e.text == \"/help\" then return \"dig, and be quick\" end end)"},
    {"save", "tick: integer, time: number, dt: number", "",
     "Every ten seconds: keep what a restart must not lose by `store.set`.",
     "on.save(function(e) store.set(\"time\", e.time) end)"},
};
static_assert(std::size(event_rows) == api_event_count);

}  // namespace

std::span<const ApiEvent> api_events() {
  return event_rows;
}

}  // namespace scree
