// The presets of quality: each draws the same world, coarser or finer.
#include "client/viewer/pictures/picture_difference.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

class QualityTest : public OffscreenTest, public testing::WithParamInterface<const char*> {
 protected:
  QualityTest() : OffscreenTest(GetParam(), {TerrainKind::noise, 4, 0.25F}) {}
};

TEST_P(QualityTest, every_preset_draws_the_same_world_at_the_size_that_was_asked_for) {
  camera_.eye_m.y = ground_height_m(field_.source(), 0.0F, 0.0F) + 3.0F;
  finish();
  const Image fine = draw();
  for (const Quality quality : {Quality::low, Quality::medium}) {
    renderer_->set_fineness(traits_of(quality).fineness);
    const Image coarse = draw();
    ASSERT_EQ(coarse.width, width);
    ASSERT_EQ(coarse.height, height);
    const Result<double> difference = picture_difference(fine, coarse);
    ASSERT_TRUE(difference) << difference.error().message;
    EXPECT_GT(*difference, 0.0) << name_of(quality);
    EXPECT_LT(*difference, 0.12) << name_of(quality);
  }
  renderer_->set_fineness({});
  EXPECT_EQ(differing_pixels(draw(), fine, 0), 0U);
}

TEST_P(QualityTest, depths_are_those_of_full_resolution_by_every_preset) {
  camera_.eye_m.y = ground_height_m(field_.source(), 0.0F, 0.0F) + 3.0F;
  finish();
  const Result<DepthImage> fine = renderer_->draw_depths(*method_, camera_, width, height);
  renderer_->set_fineness(traits_of(Quality::low).fineness);
  const Result<DepthImage> coarse = renderer_->draw_depths(*method_, camera_, width, height);
  ASSERT_TRUE(fine && coarse);
  EXPECT_EQ(fine->metres, coarse->metres);
}

/// 0 to 255.
double brightness(const Image& image) {
  double sum = 0.0;
  for (const uint8_t value : image.rgb) sum += value;
  return sum / static_cast<double>(std::max<size_t>(image.rgb.size(), 1));
}

TEST_P(QualityTest, no_sun_shines_into_a_cellar_by_any_preset) {
  const glm::vec3 middle_m(0.0F, ground_height_m(field_.source(), 0.0F, 0.0F) - 7.0F, 0.0F);
  PieceTable pieces;
  apply(DigOperation{sphere(middle_m, 3.0F)}, field_, pieces);
  // It looks where the sun would shine.
  camera_.eye_m = middle_m;
  camera_.pitch = -0.6F;
  camera_.yaw = 0.8F;
  finish();
  const double fine = brightness(draw());
  for (const Quality quality : {Quality::low, Quality::medium}) {
    renderer_->set_fineness(traits_of(quality).fineness);
    EXPECT_LT(brightness(draw()), 1.2 * fine + 2.0) << name_of(quality);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, QualityTest, testing::Values("mesh", "raymarch"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace scree
