// Internal to import/mesh.
#pragma once

#include <glm/vec3.hpp>

namespace scree {

/// From p to the triangle, metres.
double distance_to(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace scree
