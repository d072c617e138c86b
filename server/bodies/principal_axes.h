// The axes about which a body's inertia tensor is diagonal. Deterministic: arithmetic and square roots alone.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace scree {

struct PrincipalAxes {
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};  ///< unit; from the principal axes to the tensor's
  glm::vec3 moments{0.0F};                     ///< about the principal axes
};

/// By the cyclic Jacobi method (Golub and Van Loan, Matrix Computations, section 8.5). The tensor is
/// symmetric and finite. Moments are in no order: each principal axis is the one that the tensor's own axis
/// of that number turns into.
PrincipalAxes principal_axes(const glm::mat3& tensor);

}  // namespace scree
