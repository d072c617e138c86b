#include "server/bodies/principal_axes.h"

#include <cmath>
#include <gtest/gtest.h>

#include "shared/base/random.h"

namespace scree {
namespace {

glm::mat3 tensor_of(const PrincipalAxes& principal) {
  const glm::mat3 axes = glm::mat3_cast(principal.rotation);
  glm::mat3 diagonal(0.0F);
  for (int i = 0; i < 3; ++i) diagonal[i][i] = principal.moments[i];
  return axes * diagonal * glm::transpose(axes);
}

void expect_equal(const glm::mat3& a, const glm::mat3& b, float tolerance) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(a[i][j], b[i][j], tolerance);
}

TEST(principal_axes, moments_about_the_axes_make_up_the_tensor) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    glm::mat3 half(0.0F);
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) half[c][r] = random.unit() - 0.5F;
    const glm::mat3 tensor = half * glm::transpose(half);
    const PrincipalAxes principal = principal_axes(tensor);
    expect_equal(tensor_of(principal), tensor, 1e-5F);
    EXPECT_NEAR(glm::length(principal.rotation), 1.0F, 1e-6F);
    for (int axis = 0; axis < 3; ++axis) EXPECT_GT(principal.moments[axis], -1e-6F);
  }
}

TEST(principal_axes, diagonal_tensor_keeps_its_axes_to_the_bit) {
  glm::mat3 tensor(0.0F);
  tensor[0][0] = 3.0F;
  tensor[1][1] = 1.0F;
  tensor[2][2] = 2.0F;
  const PrincipalAxes principal = principal_axes(tensor);
  EXPECT_EQ(principal.rotation, glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
  EXPECT_EQ(principal.moments, glm::vec3(3.0F, 1.0F, 2.0F));
}

}  // namespace
}  // namespace scree
