#include "server/bodies/principal_axes.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "server/colliders/sound_values.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Rounds over the three pairs of axes: the method converges quadratically, in three or four for any tensor.
constexpr int rounds = 6;

void turn_columns(glm::dmat3& matrix, int p, int q, double cosine, double sine) {
  const glm::dvec3 at_p = matrix[p], at_q = matrix[q];
  matrix[p] = at_p * cosine - at_q * sine;
  matrix[q] = at_p * sine + at_q * cosine;
}

/// Turns the axes p and q, so that the tensor's element (p, q) becomes 0.
void turn(glm::dmat3& tensor, glm::dmat3& axes, int p, int q) {
  const double off = tensor[p][q];
  if (off == 0.0) return;
  const double theta = (tensor[q][q] - tensor[p][p]) / (2.0 * off);
  const double tangent = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double cosine = 1.0 / std::sqrt(tangent * tangent + 1.0);
  const double sine = tangent * cosine;
  for (int column = 0; column < 3; ++column) {  // the rows p and q, then the columns
    const double at_p = tensor[column][p], at_q = tensor[column][q];
    tensor[column][p] = cosine * at_p - sine * at_q;
    tensor[column][q] = sine * at_p + cosine * at_q;
  }
  turn_columns(tensor, p, q, cosine, sine);
  tensor[p][q] = tensor[q][p] = 0.0;
  turn_columns(axes, p, q, cosine, sine);
}

}  // namespace

PrincipalAxes principal_axes(const glm::mat3& tensor) {
  CHECK(is_sound(tensor[0]) && is_sound(tensor[1]) && is_sound(tensor[2]));
  glm::dmat3 diagonal(tensor), axes(1.0);
  for (int round = 0; round < rounds; ++round) {
    turn(diagonal, axes, 0, 1);
    turn(diagonal, axes, 0, 2);
    turn(diagonal, axes, 1, 2);
  }
  CHECK_DEBUG(glm::determinant(axes) > 0.999);
  PrincipalAxes result;
  result.rotation = glm::normalize(glm::quat(glm::quat_cast(axes)));
  result.moments = glm::vec3(diagonal[0][0], diagonal[1][1], diagonal[2][2]);
  return result;
}

}  // namespace scree
