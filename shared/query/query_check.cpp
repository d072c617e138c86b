#include "shared/query/query_check.h"

#include <cmath>
#include <string>

#include "shared/base/plain_number.h"
#include "shared/query/limits.h"

namespace scree {

namespace {

/// False of a NaN.
bool is_at_most(float x, float most) {
  return x >= -most && x <= most;
}

const std::string volume_most = with_unit(limits::query_volume_max_m3, "m³");

double volume_of_box(glm::dvec3 size) {
  return size.x * size.y * size.z;
}

}  // namespace

Result<void> check_place(glm::vec3 place_m) {
  constexpr float most = limits::query_place_max_m;
  if (!is_at_most(place_m.x, most) || !is_at_most(place_m.y, most) || !is_at_most(place_m.z, most))
    return fail("a place is farther than " + metres(most) + " from the origin, or no number");
  return {};
}

Result<void> check_mask(const QueryMask& mask) {
  if (mask.except.size() > limits::query_excepted_max)
    return fail("the mask excepts more than " + std::to_string(limits::query_excepted_max) + " ids");
  return {};
}

Result<void> check_way(glm::vec3 unit, float most_m) {
  if (!is_at_most(unit.x, 2.0F) || !is_at_most(unit.y, 2.0F) || !is_at_most(unit.z, 2.0F))
    return fail("the direction is no number, or not of length 1");
  const float squared = unit.x * unit.x + unit.y * unit.y + unit.z * unit.z;
  if (!is_at_most(squared - 1.0F, 0.002F)) return fail("the direction is not of length 1");
  if (!(most_m >= 0.0F && most_m <= limits::query_cast_max_m))
    return fail("the cast is longer than " + metres(limits::query_cast_max_m) + ", negative or no number");
  return {};
}

Result<void> check_mover(glm::vec3 axis_m, float radius_m, float most_m) {
  if (!(radius_m >= limits::query_radius_min_m && radius_m <= limits::query_radius_max_m))
    return fail("the radius must lie " +
                range_text(limits::query_radius_min_m, limits::query_radius_max_m, "m"));
  const double x = static_cast<double>(axis_m.x), y = static_cast<double>(axis_m.y),
               z = static_cast<double>(axis_m.z);
  const double axis = std::sqrt(x * x + y * y + z * z);
  if (axis > static_cast<double>(limits::query_axis_max_m))
    return fail("the capsule's ends are farther than " + metres(limits::query_axis_max_m) + " apart");
  const double side = 2.0 * static_cast<double>(radius_m) + axis;
  if (side * side * (side + static_cast<double>(most_m)) > static_cast<double>(limits::query_volume_max_m3))
    return fail("the cast sweeps more than " + volume_most + ": make it shorter, or thinner");
  return {};
}

Result<void> check_nearest(glm::vec3 place_m, float most_m) {
  TRY(check_place(place_m));
  if (most_m >= 0.0F && most_m <= limits::query_nearest_max_m) return {};
  return fail("the surface is looked for farther than " + metres(limits::query_nearest_max_m) +
              ", or no number");
}

Result<void> check_box(glm::vec3 lo_m, glm::vec3 hi_m) {
  TRY(check_place(lo_m));
  TRY(check_place(hi_m));
  if (lo_m.x > hi_m.x || lo_m.y > hi_m.y || lo_m.z > hi_m.z)
    return fail("the box's lower corner is above its upper one");
  return {};
}

Result<void> check_volume(glm::vec3 lo_m, glm::vec3 hi_m) {
  TRY(check_box(lo_m, hi_m));
  const glm::dvec3 size = glm::dvec3(hi_m) - glm::dvec3(lo_m);
  constexpr auto side = static_cast<double>(limits::query_box_side_max_m);
  if (size.x > side || size.y > side || size.z > side)
    return fail("the box is longer than " + metres(limits::query_box_side_max_m));
  if (volume_of_box(size) > static_cast<double>(limits::query_volume_max_m3))
    return fail("the box is larger than " + volume_most);
  return {};
}

}  // namespace scree
