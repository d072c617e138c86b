// Requests about terrain, and prefabs: lists of shapes with materials.
#include <array>
#include <cmath>

#include "server/rules/api/asking.h"
#include "server/rules/api/build.h"
#include "server/rules/api/parts.h"

namespace scree {

namespace {

template <size_t Bytes>
struct KindText {
  char text[Bytes]{};
  constexpr KindText(const char (&from)[Bytes]) { std::copy_n(from, Bytes, text); }
};

template <KindText kind>
Result<void> ask(RulesCall& call) {
  return ask_by_table(call, kind.text);
}

Result<void> build(RulesCall& call) {
  const ScriptValue shapes = call.argument(1, "shapes");
  const ScriptValue options = call.argument(2, "options");
  BuildOptions how;
  if (!options.is_nil()) {
    TRY(read_build_options(how, options, call.moment));
    how.party = TRY(party_by(options));
  }
  std::vector<FillRequest> fills = TRY(read_build(shapes, how, call.moment));
  for (size_t i = 0; i < fills.size(); ++i)
    TRY(ask_world(call, std::move(fills[i]), how.party, i + 1 == fills.size() ? 3 : 0));
  call.results().integer(static_cast<int64_t>(fills.size()));
  return {};
}

constexpr ApiFunction edit_rows[] = {
    {"world", "carve", "what: carve, reply?: fun(reply: reply)", "",
     "Breaks a shape out of the terrain; its pieces fly and fall. With `by`, they are that person's. As all "
     "requests it is carried out in the next tick, or some ticks later where much waits.",
     "world.carve{ at = vec(0, 0, 0), radius = 1.5, pieces = 12 }\n"
     "world.carve({ shape = \"box\", at = vec(8, 0, 0), half = vec(2, 1, 2) },\n"
     "  function(reply) log(reply.done and reply.pieces .. \" pieces\" or reply.refusal) end)",
     ask<"carve">},
    {"world", "fill", "what: fill, reply?: fun(reply: reply)", "", "Fills a shape with rock.",
     "world.fill{ shape = \"box\", at = vec(0, 2, 0), half = vec(1, 2, 1), material = \"rock\" }",
     ask<"fill">},
    {"world", "paint", "what: paint, reply?: fun(reply: reply)", "",
     "Makes the rock in a shape another material.",
     "world.paint{ at = vec(0, 0, 0), radius = 2, material = \"ice\" }", ask<"paint">},
    {"world", "blast", "what: blast, reply?: fun(reply: reply)", "",
     "Sets energy free at a place: rock breaks and is thrown out, and bodies near are thrown.",
     "world.blast{ at = vec(0, -0.5, 0), energy = 4.2e6 }", ask<"blast">},
    {"world", "dig", "what: dig, reply?: fun(reply: reply)", "",
     "Takes the terrain in a shape into a store, without pieces; or a piece, whole.",
     "world.dig({ at = vec(0, -1, 0), radius = 1, store = \"red\" },\n"
     "  function(reply) if reply.done then log(reply.volume .. \" m³\") end end)",
     ask<"dig">},
    {"world", "place", "what: place, reply?: fun(reply: reply)", "", "Fills a shape out of a store.",
     "world.place{ at = vec(0, 1, 0), radius = 1, material = \"rock\", store = \"red\" }", ask<"place">},
    {"world", "transfer", "what: transfer, reply?: fun(reply: reply)", "",
     "Moves rock from a store to another: a person's, one with a name, or the world's.",
     "world.transfer{ from = \"red\", to = \"world\", material = \"rock\", volume = 0.5 }", ask<"transfer">},
    {"world", "cut_out", "what: cut_out, reply?: fun(reply: reply)", "",
     "Cuts a shape out of the terrain as one body, which stays a body until it is released.",
     "world.cut_out({ shape = \"box\", at = vec(6, -0.5, 0), half = vec(1, 1, 1) },\n"
     "  function(reply) if reply.body then reply.body:push(vec(0, 1000, 0)) end end)",
     ask<"cut_out">},
    {"world", "build", "shapes: fill[], options?: build, reply?: fun(reply: reply)", "integer",
     "Builds a prefab: a list of fills whose places are relative to `at`, turned by quarter turns about the "
     "upright axis. Boxes longer than 16 m are filled in parts. Gives the number of fills; the reply is that "
     "to the last.",
     "local tower = {\n"
     "  { shape = \"box\", at = vec(0, 5, 0), half = vec(2, 5, 2), material = \"rock\" },\n"
     "  { at = vec(0, 11, 0), radius = 2, material = \"ice\" },\n"
     "}\n"
     "world.build(tower, { at = vec(20, 0, 20) })\n"
     "world.build(tower, { at = vec(-20, 0, 20), turn = 1 })",
     build},
};

}  // namespace

std::span<const ApiFunction> edit_api() {
  return edit_rows;
}

}  // namespace scree
