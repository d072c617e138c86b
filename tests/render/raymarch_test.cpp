// The raymarcher's copy of the field stays the field's, whatever happens to it.
#include "content/builtin_palette.h"
#include "shared/base/random.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

class Raymarch : public OffscreenTest {
 protected:
  Raymarch() : OffscreenTest("raymarch", {TerrainKind::noise, 4, 0.25F}) {
    ground_m_ = ground_height_m(field_.source(), 0.0F, 0.0F);
  }
  void SetUp() override {
    OffscreenTest::SetUp();
    camera_.eye_m = {1.0F, ground_m_ + 4.0F, 7.0F};
  }
  void carve_anywhere(Random& random, int carves) {
    for (int i = 0; i < carves; ++i) {
      const auto place = [&] { return (random.unit() * 2.0F - 1.0F) * 7.0F; };
      const float x = place(), z = place();
      carve({x, ground_height_m(field_.source(), x, z) - 0.5F, z});
    }
    pieces_.clear();
  }
  /// The picture of a method that never saw any edit, only the field as it is now.
  Image draw_afresh() {
    const std::unique_ptr<DrawMethod> fresh = make_method();
    finish(*fresh);
    return draw(*fresh);
  }
  float ground_m_ = 0.0F;
};

TEST_F(Raymarch, an_edit_is_in_the_next_frame) {
  finish();
  const Image before = draw();
  carve({0.0F, ground_m_, 0.0F});
  pieces_.clear();
  method_->update(Scene{field_, pieces_}, camera_);
  EXPECT_TRUE(method_->complete());
  const Image after = draw();
  EXPECT_GT(differing_pixels(before, after, 12), 300U);
  EXPECT_EQ(differing_pixels(after, draw_afresh(), 0), 0U);
}

TEST_F(Raymarch, pixels_are_those_of_a_fresh_atlas_after_many_edits) {
  finish();
  Random random(11);
  for (int round = 0; round < 4; ++round) {
    carve_anywhere(random, 15);
    method_->update(Scene{field_, pieces_}, camera_);
  }
  ASSERT_TRUE(method_->complete());
  EXPECT_EQ(differing_pixels(draw(), draw_afresh(), 0), 0U);
}

TEST_F(Raymarch, pixels_are_those_of_a_fresh_atlas_after_a_flight) {
  finish();
  Random random(12);
  carve_anywhere(random, 5);
  for (const float away_m : {9.0F, 31.0F, 120.0F, 0.0F}) {
    camera_.eye_m.x = 1.0F + away_m;
    method_->update(Scene{field_, pieces_}, camera_);
  }
  finish();
  carve_anywhere(random, 5);
  finish();
  EXPECT_EQ(differing_pixels(draw(), draw_afresh(), 0), 0U);
}

/// One ball, cut out whole and lying where it was cut.
class RaymarchPiece : public Raymarch {
 protected:
  void SetUp() override {
    Raymarch::SetUp();
    renderer_->set_palette(shared_builtin_palette());
    camera_.eye_m = {0.4F, ground_m_ + 2.6F, 2.8F};
    camera_.pitch = -0.65F;
  }
  void cut() {
    const glm::vec3 at_m(0.0F, ground_m_, 0.0F);
    const Applied applied =
        apply(CarveOperation{sphere(at_m, 1.5F), SeedPattern::uniform, 1, 5, at_m, piece}, field_, table_);
    const Volume& volume = *table_.at(piece);
    home_ = {volume.centre_voxels * field_.source().voxel_size_m, {}};
    pieces_[piece] = {table_.at(piece), home_};
    method_->changed({applied.changed, {piece}, {}});
    method_->update(Scene{field_, pieces_}, camera_);
  }
  void merge() {
    const Applied applied = apply(StampOperation{piece, quantise(home_), 0}, field_, table_);
    pieces_.clear();
    method_->changed({applied.changed, {}, {piece}});
    method_->update(Scene{field_, pieces_}, camera_);
  }
  static constexpr PieceId piece = 9;
  /// Largest difference of a colour's mean over the middle of the piece; its rim shows a crack until it
  /// merges.
  static int difference_amidst(const Image& a, const Image& b) {
    return largest_mean(a, b, [](int difference) { return difference; });
  }
  /// Largest mean, over the same pixels, of a colour's difference at each: some of a hole's pixels are paler
  /// than the ground and some darker, which cancels out in the colour's mean.
  static int difference_of_pixels_amidst(const Image& a, const Image& b) {
    return largest_mean(a, b, [](int difference) { return std::abs(difference); });
  }
  template <typename Counted>
  static int largest_mean(const Image& a, const Image& b, Counted&& counted) {
    int largest = 0;
    for (size_t colour = 0; colour < 3; ++colour) {
      int sum = 0;
      int count = 0;
      for (int y = height * 55 / 100; y < height * 80 / 100; ++y)
        for (int x = width * 30 / 100; x < width * 50 / 100; ++x, ++count) {
          const size_t at = static_cast<size_t>(y * width + x) * 3 + colour;
          sum += counted(a.rgb[at] - b.rgb[at]);
        }
      largest = std::max(largest, std::abs(sum / count));
    }
    return largest;
  }
  PieceTable table_;
  Pose home_;
};

TEST_F(RaymarchPiece, where_it_was_cut_it_looks_like_the_rock_that_it_was) {
  finish();
  const Image whole = draw();
  cut();
  EXPECT_EQ(method_->stats().pieces, 1U);
  EXPECT_LE(difference_of_pixels_amidst(whole, draw()), 15);
  pieces_.clear();
  method_->update(Scene{field_, pieces_}, camera_);
  EXPECT_GT(difference_of_pixels_amidst(whole, draw()), 18) << "the hole that it left should be seen";
}

TEST_F(RaymarchPiece, a_merge_takes_one_frame_and_keeps_its_looks) {
  finish();
  cut();
  const Image before = draw();
  merge();
  EXPECT_EQ(method_->stats().pieces, 0U);
  EXPECT_TRUE(method_->complete());
  const Image after = draw();
  EXPECT_LE(difference_amidst(before, after), 8);
  EXPECT_EQ(differing_pixels(after, draw_afresh(), 0), 0U);
}

TEST_F(RaymarchPiece, any_number_is_one_draw) {
  finish();
  const size_t of_ground = (draw(), method_->stats().draws);
  cut();
  const size_t of_one = (draw(), method_->stats().draws);
  EXPECT_GT(of_one, of_ground);
  for (int i = 1; i <= 20; ++i) {
    Pose beside = home_;
    beside.position_m.x += 0.02F * static_cast<float>(i);
    pieces_[piece + static_cast<PieceId>(i)] = {table_.at(piece), beside};
  }
  method_->update(Scene{field_, pieces_}, camera_);
  draw();
  EXPECT_EQ(method_->stats().pieces, 21U);
  EXPECT_EQ(method_->stats().draws, of_one);
}

TEST_F(RaymarchPiece, its_room_is_used_again) {
  finish();
  cut();
  const auto bytes = [&] {
    const MemoryCounts counts = method_->stats().memory;
    return std::ranges::find(counts, "pieces", &MemoryCount::category)->gpu_bytes;
  };
  const size_t once = bytes();
  for (int i = 0; i < 200; ++i) {
    pieces_.clear();
    method_->update(Scene{field_, pieces_}, camera_);
    pieces_[piece] = {table_.at(piece), home_};
    method_->update(Scene{field_, pieces_}, camera_);
  }
  EXPECT_EQ(bytes(), once);
  EXPECT_EQ(differing_pixels(draw(), draw_afresh(), 0), 0U);
}

TEST_F(Raymarch, camera_inside_rock_and_tiny_images_are_harmless) {
  camera_.eye_m.y = ground_m_ - 6.0F;
  finish();
  draw();
  EXPECT_TRUE(renderer_->draw_image(*method_, camera_, 1, 1));
  renderer_->draw(method_.get(), camera_, 0, 0, 0);
}

}  // namespace
}  // namespace scree
