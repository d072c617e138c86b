// Particles in the picture, by every method: seen before rock, hidden behind it, and gone when there are
// none.
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

class Particles : public OffscreenTest, public testing::WithParamInterface<std::string_view> {
 protected:
  Particles() : OffscreenTest(GetParam(), {TerrainKind::flat, 1, 0.25F}) {}
  /// A puff and a splinter beside each other, `away_m` before the eye.
  std::vector<Particle> two(float away_m) const {
    const glm::vec3 middle_m = camera_.eye_m + away_m * camera_.forward();
    return {{middle_m - 0.5F * camera_.right(), 0.4F, {128, 90, 50, 230}, 1.0F, 0.0F},
            {middle_m + 0.5F * camera_.right(), 0.3F, {200, 200, 200, 255}, 0.5F, 0.4F}};
  }
};

std::vector<std::string_view> drawing_methods() {
  std::vector<std::string_view> names;
  for (const MethodEntry& entry : all_methods()) names.push_back(entry.name);
  return names;
}

TEST_P(Particles, are_seen_before_rock_and_not_behind_it_and_leave_nothing) {
  if (method_named(GetParam())->missing()) GTEST_SKIP();
  camera_.eye_m.y = ground_height_m(field_.source(), 0.0F, 0.0F) + 3.0F;
  finish();
  const Image bare = draw();
  renderer_->set_particles(two(2.0F));
  EXPECT_GT(differing_pixels(draw(), bare, 8), 400U);
  const Result<DepthImage> with = renderer_->draw_depths(*method_, camera_, width, height);
  renderer_->set_particles(two(40.0F));
  EXPECT_EQ(differing_pixels(draw(), bare, 0), 0U) << "below the ground";
  renderer_->set_particles({});
  EXPECT_EQ(differing_pixels(draw(), bare, 0), 0U);
  const Result<DepthImage> without = renderer_->draw_depths(*method_, camera_, width, height);
  ASSERT_TRUE(with && without);
  EXPECT_EQ(with->metres, without->metres);
}

INSTANTIATE_TEST_SUITE_P(Methods, Particles, testing::ValuesIn(drawing_methods()),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace scree
