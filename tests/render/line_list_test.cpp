// Lines over the world: outlines lie on the shapes that they outline.
#include "client/render/scene/line_list.h"

#include <cmath>
#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "client/render/scene/limits.h"

namespace scree {
namespace {

TEST(LineList, outlines_lie_on_their_shapes) {
  for (const ShapeKind kind : all_kinds<ShapeKind>) {
    const Shape shape{kind, {1, 2, 3}, {2, 1, 3}, kind == ShapeKind::box ? 0.0F : 0.5F};
    LineList lines;
    lines.shape(shape, {});
    ASSERT_FALSE(lines.vertices().empty());
    for (const LineVertex& vertex : lines.vertices())
      // A capsule's balls lie within it in part, never outside.
      EXPECT_LT(distance(shape, vertex.place_m), 1e-3F);
    float outermost = -1.0F;
    for (const LineVertex& vertex : lines.vertices())
      outermost = std::max(outermost, distance(shape, vertex.place_m));
    EXPECT_NEAR(outermost, 0.0F, 1e-3F);
  }
}

TEST(LineList, box_has_twelve_edges_and_turns) {
  LineList lines;
  const glm::quat quarter(std::sqrt(0.5F), 0.0F, std::sqrt(0.5F), 0.0F);  // about y
  lines.box({0, 0, 0}, {1, 2, 3}, {}, quarter, {10, 0, 0});
  ASSERT_EQ(lines.vertices().size(), 24U);
  glm::vec3 hi(-100.0F);
  for (const LineVertex& vertex : lines.vertices()) hi = glm::max(hi, vertex.place_m);
  EXPECT_NEAR(hi.x, 13.0F, 1e-4F) << "what lay along z lies along x";
}

TEST(LineList, is_bounded) {
  LineList lines;
  for (size_t i = 0; i < limits::lines_max + 10; ++i) lines.line({}, {}, {});
  EXPECT_EQ(lines.vertices().size(), 2 * limits::lines_max);
}

}  // namespace
}  // namespace scree
