// Where a spawn looks, for who aims one or goes by one. Angles go through the math library: for no kernel.
#pragma once

#include "shared/base/spawn.h"

namespace scree {

/// The spawn from which one place looks at another.
Spawn spawn_looking_at(glm::vec3 eye_m, glm::vec3 at_m);

/// The place on the level of the eye, so far before it.
glm::vec3 ahead_of(const Spawn& spawn, float metres);

}  // namespace scree
