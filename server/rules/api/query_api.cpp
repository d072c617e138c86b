// Questions about space (shared/query/query.h), and what lies in the ground.
#include <cmath>
#include <glm/common.hpp>

#include "server/rules/api/asking.h"
#include "server/rules/api/parts.h"
#include "server/rules/api/query_fields.h"
#include "shared/base/limits.h"
#include "shared/field/material_window.h"
#include "shared/field/terrain.h"
#include "shared/query/limits.h"

namespace scree {

namespace {

constexpr float usual_cast_m = 200.0F;

Result<QueryMask> mask_of(RulesCall& call, int argument) {
  QueryMask mask;
  const ScriptValue table = call.argument(argument, "mask");
  if (!table.is_nil()) TRY(read_fields(&mask, table, mask_fields, call.moment));
  return mask;
}

Result<float> number_or(RulesCall& call, int argument, std::string_view name, float usual) {
  const ScriptValue value = call.argument(argument, name);
  return value.is_nil() ? Result<float>(usual) : read_float(value);
}

std::string_view kind_of_hit(const Hit& hit, uint64_t person) {
  if (person != 0) return "person";
  if (hit.kind == HitKind::terrain) return "terrain";
  return hit.kind == HitKind::piece ? "piece" : "prop";
}

uint64_t person_of_body(RulesCall& call, PieceId body) {
  for (const PersonPlace& person : call.moment.places())
    if (person.body == body) return person.session;
  return 0;
}

void write_hit(RulesCall& call, const std::optional<Hit>& hit) {
  ScriptWriter& to = call.results();
  if (!hit) {
    to.nil();
    return;
  }
  const bool is_body = hit->kind != HitKind::terrain;
  const uint64_t person = is_body ? person_of_body(call, hit->id) : 0;
  to.open_table();
  to.name("kind");
  to.text(kind_of_hit(*hit, person));
  to.name("at");
  write_vec(to, hit->place_m);
  to.name("normal");
  write_vec(to, hit->normal);
  to.name("distance");
  to.number(hit->distance_m);
  to.name("inside");
  to.boolean(hit->inside);
  if (is_body) {
    to.name("body");
    write_body(to, hit->id);
  }
  if (person != 0) {
    to.name("person");
    write_person(to, person);
  }
  if (hit->kind != HitKind::body) {
    to.name("material");
    write_material(to, hit->material, call.moment);
  }
  to.close_table();
}

void write_overlapping(RulesCall& call, const Overlapping& found) {
  ScriptWriter& to = call.results();
  to.open_table();
  to.name("terrain");
  to.boolean(found.terrain);
  to.name("bodies");
  to.open_table();
  for (const PieceId id : found.ids) write_body(to, id);
  to.close_table();
  to.close_table();
}

Result<void> ray(RulesCall& call) {
  const glm::vec3 from = TRY(read_vec(call.argument(1, "from")));
  const glm::vec3 unit = TRY(read_unit(call.argument(2, "direction")));
  const float most = TRY(number_or(call, 3, "most", usual_cast_m));
  const QueryMask mask = TRY(mask_of(call, 4));
  write_hit(call, TRY(paid(call, cast_ray(call.moment.scene(), from, unit, most, mask))));
  return {};
}

Result<void> ball(RulesCall& call) {
  const glm::vec3 from = TRY(read_vec(call.argument(1, "from")));
  const glm::vec3 unit = TRY(read_unit(call.argument(2, "direction")));
  const float radius = TRY(read_float(call.argument(3, "radius")));
  const float most = TRY(number_or(call, 4, "most", 16.0F));
  const QueryMask mask = TRY(mask_of(call, 5));
  write_hit(call, TRY(paid(call, cast_sphere(call.moment.scene(), from, unit, most, radius, mask))));
  return {};
}

Result<void> in_sphere(RulesCall& call) {
  const glm::vec3 at = TRY(read_vec(call.argument(1, "at")));
  const float radius = TRY(read_float(call.argument(2, "radius")));
  const QueryMask mask = TRY(mask_of(call, 3));
  write_overlapping(call, TRY(paid(call, overlap_sphere(call.moment.scene(), at, radius, mask))));
  return {};
}

Result<void> in_box(RulesCall& call) {
  const glm::vec3 a = TRY(read_vec(call.argument(1, "from")));
  const glm::vec3 b = TRY(read_vec(call.argument(2, "to")));
  const QueryMask mask = TRY(mask_of(call, 3));
  write_overlapping(call,
                    TRY(paid(call, overlap_box(call.moment.scene(), glm::min(a, b), glm::max(a, b), mask))));
  return {};
}

Result<void> nearest(RulesCall& call) {
  const glm::vec3 at = TRY(read_vec(call.argument(1, "at")));
  const float most = TRY(number_or(call, 2, "most", limits::query_nearest_max_m));
  const QueryMask mask = TRY(mask_of(call, 3));
  write_hit(call, TRY(paid(call, nearest_surface(call.moment.scene(), at, most, mask))));
  return {};
}

Result<void> solid(RulesCall& call) {
  const glm::vec3 at = TRY(read_vec(call.argument(1, "at")));
  const QueryMask mask = TRY(mask_of(call, 2));
  call.results().boolean(TRY(paid(call, is_solid(call.moment.scene(), at, mask))));
  return {};
}

constexpr QueryMask terrain_alone() {
  return {.terrain = true, .pieces = false, .bodies = false};
}

Result<void> material(RulesCall& call) {
  const glm::vec3 at = TRY(read_vec(call.argument(1, "at")));
  if (TRY(paid(call, is_solid(call.moment.scene(), at, terrain_alone()))))
    write_material(call.results(), material_at(world_of(call).field(), at), call.moment);
  else
    call.results().nil();
  return {};
}

/// Above which a column has only air, so that no ground is generated there.
float top_of_column(const Field& field, glm::vec2 at_m) {
  const float voxel_m = field.source().voxel_size_m;
  const float chunk_m = static_cast<float>(chunk_size) * voxel_m;
  const auto chunk_at = [&](float along_m) { return floor_to_int(along_m / chunk_m); };
  const float top = std::min(top_m(field.source()) + chunk_m, limits::world_half_height_m);
  for (int y = chunk_at(limits::world_half_height_m); y >= chunk_at(top); --y)
    for (const float x : {at_m.x - voxel_m, at_m.x + voxel_m})
      for (const float z : {at_m.y - voxel_m, at_m.y + voxel_m})
        if (field.has_edits({chunk_at(x), y, chunk_at(z)}))
          return std::min(static_cast<float>(y + 1) * chunk_m + voxel_m, limits::world_half_height_m);
  return top;
}

Result<void> ground(RulesCall& call) {
  const glm::vec3 at(TRY(read_float(call.argument(1, "x"))), 0.0F, TRY(read_float(call.argument(2, "z"))));
  if (!(std::abs(at.x) <= limits::world_half_width_m && std::abs(at.z) <= limits::world_half_width_m))
    return call.argument(1, "x").refuse("the place lies outside the world");
  call.call.charge(work_of_chunk);
  const float from_m = top_of_column(world_of(call).field(), {at.x, at.z});
  const float most_m = std::min(from_m + limits::world_half_height_m, limits::query_cast_max_m);
  const auto hit = TRY(paid(call, cast_ray(call.moment.scene(), {at.x, from_m, at.z}, {0.0F, -1.0F, 0.0F},
                                           most_m, terrain_alone())));
  if (hit)
    call.results().number(hit->place_m.y);
  else
    call.results().nil();
  return {};
}

Result<void> mass_in(RulesCall& call) {
  const glm::vec3 a = TRY(read_vec(call.argument(1, "from")));
  const glm::vec3 b = TRY(read_vec(call.argument(2, "to")));
  const BoxContent content =
      TRY(paid(call, box_content(call.moment.scene(), glm::min(a, b), glm::max(a, b))));
  ScriptWriter& to = call.results();
  to.open_table();
  for (const MaterialMass& mass : content.masses) {
    to.name(world_of(call).config().palette->name(mass.material));
    to.number(cubic_metres(mass.mass, call.moment));
  }
  to.close_table();
  to.number(content.rock_m3);
  return {};
}

constexpr ApiFunction query_rows[] = {
    {"world", "ray", "from: vec, direction: vec, most?: number, mask?: mask", "hit?",
     "What a ray hits first: terrain, pieces, props and persons. 200 m as usual, 1000 m at most.",
     "local hit = world.ray(vec(0, 10, 0), vec(0, -1, 0), 50)\n"
     "assert(hit.kind == \"terrain\" and math.abs(hit.at.y) < 0.5)",
     ray},
    {"world", "sphere_cast", "from: vec, direction: vec, radius: number, most?: number, mask?: mask", "hit?",
     "The same of a ball that moves so; 16 m as usual.",
     "local hit = world.sphere_cast(vec(0, 10, 0), vec(0, -1, 0), 0.5)\nassert(hit.distance < 10)", ball},
    {"world", "overlap_sphere", "at: vec, radius: number, mask?: mask", "overlap",
     "What has a place within a ball.", "assert(world.overlap_sphere(vec(0, 0, 0), 1).terrain)", in_sphere},
    {"world", "overlap_box", "from: vec, to: vec, mask?: mask", "overlap",
     "What has a place within the box between two corners.",
     "for _, body in ipairs(world.overlap_box(vec(-5, 0, -5), vec(5, 5, 5)).bodies) do body:push(vec(0, 50, "
     "0)) "
     "end",
     in_box},
    {"world", "nearest", "at: vec, most?: number, mask?: mask", "hit?",
     "The nearest surface, 8 m away at most.", "assert(world.nearest(vec(0, 2, 0), 4).distance < 3)",
     nearest},
    {"world", "solid", "at: vec, mask?: mask", "boolean", "Whether a place lies in rock or in a body.",
     "assert(world.solid(vec(0, -2, 0)) and not world.solid(vec(0, 2, 0)))", solid},
    {"world", "material", "at: vec", "string?", "The material of the terrain at a place; nil: there is air.",
     "assert(world.material(vec(0, -5, 0)) ~= nil and world.material(vec(0, 5, 0)) == nil)", material},
    {"world", "ground", "x: number, z: number", "number?",
     "The height of the topmost rock; nil: there is none in that column.",
     "assert(math.abs(world.ground(3, 4)) < 0.5)", ground},
    {"world", "mass_in", "from: vec, to: vec", "table<string, number>, number",
     "m³ of rock in the box between two corners: by material, of rubble that of its stones; and in all. The "
     "box has 16,384 m³ at most.",
     "local by_material, all = world.mass_in(vec(-2, -2, -2), vec(2, 2, 2))\nassert(all > 20 and all < 40)",
     mass_in},
};

}  // namespace

std::span<const ApiFunction> query_api() {
  return query_rows;
}

}  // namespace scree
