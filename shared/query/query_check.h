// What questions must be like: checked before anything is read. Reasons say the limit.
#pragma once

#include "shared/query/query.h"

namespace scree {

/// Numbers, within limits::query_place_max_m.
Result<void> check_place(glm::vec3 place_m);
Result<void> check_mask(const QueryMask& mask);
/// A direction, and a length within limits::query_cast_max_m.
Result<void> check_way(glm::vec3 unit, float most_m);
/// A capsule, or a sphere without an axis, that moves so far; 0 if it does not move.
Result<void> check_mover(glm::vec3 axis_m, float radius_m, float most_m);
/// What the nearest surface is looked for from, and how far.
Result<void> check_nearest(glm::vec3 place_m, float most_m);
/// A box, its places checked; with volume, its sides and volume are bounded.
Result<void> check_box(glm::vec3 lo_m, glm::vec3 hi_m);
Result<void> check_volume(glm::vec3 lo_m, glm::vec3 hi_m);

}  // namespace scree
