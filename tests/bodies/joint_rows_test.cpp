// The angle by which joints turn, without the math library.
#include "server/bodies/joint_rows.h"

#include <cmath>
#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(JointRows, the_angle_is_that_of_the_math_library) {
  for (int i = -314; i <= 314; ++i) {
    const float angle = 0.01F * static_cast<float>(i);
    EXPECT_NEAR(angle_of(3.0F * std::cos(angle), 3.0F * std::sin(angle)), angle, 2e-5F);
  }
  EXPECT_TRUE(std::isfinite(angle_of(0.0F, 0.0F)));
}

}  // namespace
}  // namespace scree
