// Drawing into images, and what the viewer relies on in doing so.
#include "tests/support/flat_terrain.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

/// Flat ground.
class ViewerOffscreen : public OffscreenTest {
 protected:
  ViewerOffscreen() : OffscreenTest("mesh", flat_terrain) {}
};

/// The mean of a row's red and blue: ground is warm, sky is blue.
int warmth(const Image& image, int row) {
  int sum = 0;
  for (int x = 0; x < image.width; ++x) {
    const auto at = static_cast<size_t>(row * image.width + x) * 3;
    sum += image.rgb[at] - image.rgb[at + 2];
  }
  return sum / image.width;
}

TEST_F(ViewerOffscreen, ground_lies_below_the_sky) {
  finish();
  const Image image = draw();
  ASSERT_EQ(image.rgb.size(), static_cast<size_t>(width * height * 3));
  EXPECT_GT(warmth(image, height - 1), 10);
  EXPECT_LT(warmth(image, 0), 0);
  EXPECT_GT(method_->stats().triangles, 100U);
}

TEST_F(ViewerOffscreen, carve_and_pieces_appear) {
  finish();
  const Image before = draw();
  carve({0.0F, 0.0F, 0.0F});
  finish();
  EXPECT_EQ(method_->stats().pieces, pieces_.size());
  EXPECT_GT(differing_pixels(before, draw(), 12), 300U);
}

TEST_F(ViewerOffscreen, nothing_changes_until_all_of_a_change_can_be_shown) {
  finish();
  const Image before = draw();
  carve({0.0F, 0.0F, 0.0F});
  // Whatever is shown between is the old picture or the new one.
  method_->update(Scene{field_, pieces_}, camera_);
  const size_t shown = method_->stats().pieces;
  if (shown == 0) {
    EXPECT_EQ(differing_pixels(before, draw(), 0), 0U);
  }
  finish();
  EXPECT_EQ(method_->stats().pieces, pieces_.size());
}

TEST_F(ViewerOffscreen, another_method_takes_over_when_it_has_all_that_was_shown) {
  const MethodEntry first = *method_named("mesh");
  MethodEntry second = first;
  MethodSwitch methods(pool_, view_radius_m, first);
  carve({0.0F, 0.0F, 0.0F});
  const auto follow_until = [&](auto&& reached) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!reached()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline);
      ASSERT_TRUE(methods.follow({}, Scene{field_, pieces_}, camera_));
    }
  };
  follow_until([&] { return methods.complete(); });
  const DrawMethod* old = methods.shown();
  EXPECT_EQ(methods.shown()->stats().pieces, pieces_.size());
  ASSERT_TRUE(methods.choose(second));
  EXPECT_FALSE(methods.loaded());
  ASSERT_TRUE(methods.follow({}, Scene{field_, pieces_}, camera_));
  EXPECT_EQ(methods.shown(), old) << "not before it has loaded";
  follow_until([&] { return methods.shown() != old; });
  EXPECT_EQ(methods.shown()->stats().pieces, pieces_.size());
  EXPECT_TRUE(methods.loaded());

  methods.begin_world();
  EXPECT_NE(methods.shown(), nullptr) << "the world that is gone stays in sight";
  EXPECT_FALSE(methods.loaded());
  MapField other(TerrainSource{TerrainKind::noise, 2, 0.25F});
  const ScenePieces none;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!methods.complete() && std::chrono::steady_clock::now() < deadline)
    ASSERT_TRUE(methods.follow({}, Scene{other, none}, camera_));
  EXPECT_EQ(methods.shown()->stats().pieces, 0U);
}

TEST_F(ViewerOffscreen, method_that_the_context_lacks_something_for_says_so) {
  MethodEntry demanding = *method_named("mesh");
  demanding.missing = [] { return std::optional<std::string>("what nobody has"); };
  MethodSwitch methods(pool_, view_radius_m, *method_named("mesh"));
  const Result<void> chosen = methods.choose(demanding);
  ASSERT_FALSE(chosen);
  EXPECT_NE(chosen.error().message.find("what nobody has"), std::string::npos);
  EXPECT_EQ(&methods.chosen(), method_named("mesh"));
}

TEST_F(ViewerOffscreen, camera_inside_rock_and_tiny_images_are_harmless) {
  camera_.eye_m = {0.0F, -5.0F, 0.0F};
  finish();
  EXPECT_TRUE(renderer_->draw_image(*method_, camera_, 1, 1));
  renderer_->draw(method_.get(), camera_, 0, 0, 0);
}

TEST_F(ViewerOffscreen, image_too_large_is_refused_by_name) {
  const Result<Image> image = renderer_->draw_image(*method_, camera_, 1 << 20, 16);
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().message.find("--size"), std::string::npos) << image.error().message;
}

}  // namespace
}  // namespace scree
