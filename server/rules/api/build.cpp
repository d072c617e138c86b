#include "server/rules/api/build.h"

#include <cmath>

#include "server/rules/api/asking.h"
#include "server/rules/field_of.h"
#include "server/rules/request_table.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

struct QuarterCodec {
  static constexpr std::string_view type = "integer";
  static Result<void> read(int64_t& to, const ScriptValue& value, const RulesMoment&) {
    to = ((TRY(value.integer()) % 4) + 4) % 4;
    return {};
  }
  static void write(int64_t from, ScriptWriter& to, const RulesMoment&) { to.integer(from); }
};

constexpr std::array build_rows{
    field<&BuildOptions::place_m>("at", "where the prefab's origin lies"),
    field_by<QuarterCodec, &BuildOptions::quarter_turns>("turn", "quarter turns about the upright axis"),
};

/// Turned about the upright axis.
glm::vec3 turned(glm::vec3 at, int64_t quarters) {
  for (; quarters > 0; --quarters) at = {at.z, at.y, -at.x};
  return at;
}

Shape placed(Shape shape, const BuildOptions& how) {
  shape.a = how.place_m + turned(shape.a, how.quarter_turns);
  if (shape.kind == ShapeKind::capsule) shape.b = how.place_m + turned(shape.b, how.quarter_turns);
  if (shape.kind == ShapeKind::box) shape.b = glm::abs(turned(shape.b, how.quarter_turns));
  return shape;
}

int parts_along(float half_m) {
  return std::max(1, static_cast<int>(std::ceil(half_m / limits::edit_reach_max_m)));
}

/// Adds a box in parts that edits can reach; others whole.
Result<void> add_fills(const FillRequest& fill, std::vector<FillRequest>& to) {
  const glm::vec3 half = fill.shape.b;
  const bool divides = fill.shape.kind == ShapeKind::box && fill.shape.radius_m == 0.0F;
  // 4096 m is the world's own half width: no box is larger, and the count stays an int.
  if (divides && !(half.x <= limits::world_half_width_m && half.y <= limits::world_half_width_m &&
                   half.z <= limits::world_half_width_m))
    return fail("a box is larger than the world");
  const glm::ivec3 parts =
      divides ? glm::ivec3(parts_along(half.x), parts_along(half.y), parts_along(half.z)) : glm::ivec3(1);
  if (to.size() + static_cast<size_t>(parts.x) * static_cast<size_t>(parts.y) * static_cast<size_t>(parts.z) >
      build_fills_max)
    return fail("a prefab takes " + std::to_string(build_fills_max) +
                " fills at most, of which each reaches 8 m: build it in several");
  const glm::vec3 part_half = half / glm::vec3(parts);
  for (int x = 0; x < parts.x; ++x)
    for (int y = 0; y < parts.y; ++y)
      for (int z = 0; z < parts.z; ++z) {
        FillRequest part = fill;
        if (divides) {
          part.shape.a += part_half * (glm::vec3(2 * x + 1, 2 * y + 1, 2 * z + 1) - glm::vec3(parts));
          part.shape.b = part_half;
        }
        to.push_back(part);
      }
  return {};
}

}  // namespace

constexpr FieldTable build_fields{"build", "the options of build", "Where world.build() puts a prefab.",
                                  build_rows};

Result<void> read_build_options(BuildOptions& to, const ScriptValue& table, const RulesMoment& moment) {
  return read_fields(&to, table, build_fields, moment, {"by"});
}

Result<std::vector<FillRequest>> read_build(const ScriptValue& shapes, const BuildOptions& how,
                                            const RulesMoment& moment) {
  std::vector<FillRequest> fills;
  const int64_t count = TRY(length_within(shapes, build_shapes_max));
  for (int64_t i = 1; i <= count; ++i) {
    const ReadScope scope(shapes);
    const ScriptValue item = TRY(shapes.item(i));
    const Request request = TRY(read_request("fill", item, moment));
    FillRequest fill = std::get<FillRequest>(request);
    fill.shape = placed(fill.shape, how);
    TRY(add_fills(fill, fills));
  }
  return fills;
}

}  // namespace scree
