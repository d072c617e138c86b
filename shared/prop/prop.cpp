#include "shared/prop/prop.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "shared/base/plain_number.h"
#include "shared/prop/limits.h"
#include "shared/prop/prop_solid.h"

namespace scree {

namespace {

bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Result<void> check_number(float value, float least, float most, const char* what, const char* unit = "") {
  if (value >= least && value <= most) return {};
  return fail("the prop's " + std::string(what) + " is " + with_unit(value, unit) + ", and must lie " +
              range_text(least, most, unit));
}

Result<void> check_length(float half_m, const char* what) {
  return check_number(half_m, limits::prop_half_min_m, limits::prop_reach_max_m, what, "m");
}

const std::string reach_words = metres(limits::prop_reach_max_m);

Result<void> check_size(const PropPart& part) {
  switch (part.kind) {
    case PropPartKind::box:
      TRY(check_length(part.half_m.x, "half side along x"));
      TRY(check_length(part.half_m.y, "half side along y"));
      return check_length(part.half_m.z, "half side along z");
    case PropPartKind::sphere:
      return check_length(part.half_m.x, "radius");
    case PropPartKind::capsule:
    case PropPartKind::cylinder:
      TRY(check_length(part.half_m.x, "radius"));
      return check_length(part.half_m.y, "half length");
    case PropPartKind::hull:
      break;
  }
  if (part.corners_m.size() < 4 || part.corners_m.size() > limits::prop_corners_max)
    return fail("a hull of a prop has " + std::to_string(part.corners_m.size()) +
                " corners, and must have from 4 to " + std::to_string(limits::prop_corners_max));
  for (const glm::vec3& corner : part.corners_m)
    if (!is_finite(corner) || glm::dot(corner, corner) > limits::prop_reach_max_m * limits::prop_reach_max_m)
      return fail("a corner of the prop's hull is no number, or farther from its place than " + reach_words);
  return {};
}

Result<void> check_part(const PropPart& part) {
  TRY(validate_kind(part.kind, "kind of the prop's part"));
  if (!is_finite(part.place_m)) return fail("the place of a prop's part is not finite");
  // A file that has what the kind does not use must be read again, too.
  if (!is_finite(part.half_m)) return fail("the size of a prop's part is not finite");
  if (!(std::abs(glm::dot(part.turn, part.turn) - 1.0F) < 1e-3F))
    return fail("the rotation of a prop's part is no unit quaternion");
  TRY(check_size(part));
  if (part.kind != PropPartKind::hull && !part.corners_m.empty())
    return fail("a part of a prop that is no hull has corners");
  return {};
}

}  // namespace

Result<void> validate_bounds(const Prop& prop) {
  if (prop.parts.empty() || prop.parts.size() > limits::prop_parts_max)
    return fail("a prop has " + std::to_string(prop.parts.size()) + " parts, and must have from 1 to " +
                std::to_string(limits::prop_parts_max));
  for (const PropPart& part : prop.parts) TRY(check_part(part));
  TRY(validate_kind(prop.motion, "motion of the prop"));
  if (prop.mass_kg != 0.0F)
    TRY(check_number(prop.mass_kg, limits::prop_mass_min_kg, limits::prop_mass_max_kg, "mass", "kg"));
  TRY(check_number(prop.friction, 0.0F, limits::prop_friction_max, "friction"));
  TRY(check_number(prop.restitution, 0.0F, 1.0F, "restitution"));
  TRY(check_number(prop.drag, 0.0F, 1.0F, "drag"));
  TRY(check_number(prop.spin_drag, 0.0F, 1.0F, "drag of spin"));
  TRY(check_number(prop.gravity, -limits::prop_gravity_max, limits::prop_gravity_max, "share of gravity"));
  if (prop.groups == 0 || (prop.groups & (group::terrain | group::pieces)) != 0)
    return fail("a prop's groups are none, or those of terrain (bit 0) or of pieces (bit 1)");
  if (prop.data.size() > limits::prop_data_bytes_max)
    return fail("a prop has " + std::to_string(prop.data.size()) + " bytes of data, and may have " +
                std::to_string(limits::prop_data_bytes_max) + " at most");
  const float reach_m = reach_of(prop);
  if (!(reach_m <= limits::prop_reach_max_m))
    return fail("the prop reaches " + metres(reach_m) + " from its origin, and may reach " + reach_words);
  return {};
}

Result<void> validate(const Prop& prop) {
  TRY(validate_bounds(prop));
  TRY(measure_checked(prop));
  return {};
}

}  // namespace scree
