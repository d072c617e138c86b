// What stands in the way of a person on foot who digs ahead. A ray from the eye passes over lips of the floor
// and beneath edges of the ceiling, which stop the body: craters have rough walls, and leave some of each.
// Metres. A pure function, on any thread that may read the field.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "shared/field/field.h"

namespace scree {

/// Where the middle of a dig of that radius lies that takes what stops a body that walks from there along
/// `direction` (unit, of the eye), within a metre. Nothing: the way is free, or the eye looks up or down.
std::optional<glm::vec3> middle_of_way(const Field& field, glm::vec3 feet_m, glm::vec3 direction,
                                       float radius_m);

}  // namespace scree
