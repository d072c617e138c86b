// Water as a level: what lies under it looks otherwise, what stands out of it looks as it did.
#include "client/render/scene/limits.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

class Water : public OffscreenTest, public testing::WithParamInterface<const char*> {
 protected:
  Water() : OffscreenTest(GetParam(), {TerrainKind::flat, 1, 0.25F}) {}
  void SetUp() override {
    OffscreenTest::SetUp();
    ground_m_ = ground_height_m(field_.source(), 0.0F, 0.0F);
    camera_.eye_m.y = ground_m_ + 3.0F;
    finish();
  }
  void fill_to(float above_ground_m) {
    const auto set = renderer_->set_water(ground_m_ + above_ground_m);
    ASSERT_TRUE(set) << set.error().message;
  }
  /// How much of the picture differs from that without water.
  double share_changed(const Image& bare) {
    return static_cast<double>(differing_pixels(draw(), bare, 2)) / (width * height);
  }
  float ground_m_ = 0.0F;
};

TEST_P(Water, lies_over_ground_that_is_lower_and_over_no_other) {
  const Image bare = draw();
  fill_to(-0.5F);
  EXPECT_LT(share_changed(bare), 0.01) << "all ground is higher, up to the horizon";
  fill_to(1.0F);
  EXPECT_GT(share_changed(bare), 0.2);
  ASSERT_TRUE(renderer_->set_water({}));
  EXPECT_EQ(differing_pixels(draw(), bare, 0), 0U);
}

TEST_P(Water, hides_more_the_deeper_it_is) {
  const Image bare = draw();
  fill_to(0.1F);
  constexpr int much = 60;
  const size_t shallow = differing_pixels(draw(), bare, much);
  fill_to(2.0F);
  EXPECT_GT(differing_pixels(draw(), bare, much), 2 * shallow + 100);
}

TEST_P(Water, is_around_the_eye_that_is_under_it) {
  const Image bare = draw();
  fill_to(4.0F);
  EXPECT_GT(share_changed(bare), 0.9);
}

INSTANTIATE_TEST_SUITE_P(Methods, Water, testing::Values("mesh", "raymarch"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace scree
