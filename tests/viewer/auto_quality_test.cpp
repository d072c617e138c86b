// The preset that the first frames choose.
#include "client/viewer/viewing/auto_quality.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

/// After so many frames of those times: by the preset, milliseconds.
Quality after_frames(float low_ms, float medium_ms, float high_ms, bool loaded, size_t count = 200) {
  AutoQuality chooser;
  for (size_t i = 0; i < count; ++i) {
    const float times_ms[] = {low_ms, medium_ms, high_ms};
    const Quality before = chooser.quality();
    const auto other = chooser.note(times_ms[static_cast<size_t>(before)], loaded);
    EXPECT_EQ(other.has_value(), chooser.quality() != before);
  }
  return chooser.quality();
}

TEST(AutoQuality, slow_frames_choose_low_and_quick_ones_high) {
  EXPECT_EQ(after_frames(40.0F, 250.0F, 900.0F, true), Quality::low);
  EXPECT_EQ(after_frames(5.0F, 40.0F, 900.0F, true), Quality::medium);
  EXPECT_EQ(after_frames(16.7F, 16.7F, 16.7F, true), Quality::high);
}

TEST(AutoQuality, high_is_left_again_when_it_is_too_slow) {
  for (const size_t count : {size_t{200}, 200 + AutoQuality::frames})
    EXPECT_EQ(after_frames(16.7F, 16.7F, 120.0F, true, count), Quality::medium)
        << "it does not go to and fro";
}

TEST(AutoQuality, loading_decides_nothing_unless_it_is_slow_already) {
  EXPECT_EQ(after_frames(30.0F, 60.0F, 90.0F, false), AutoQuality::first);
  EXPECT_EQ(after_frames(30.0F, 400.0F, 900.0F, false), Quality::low);
}

TEST(AutoQuality, frames_of_loading_do_not_count_when_the_world_stands) {
  AutoQuality chooser;
  for (size_t i = 1; i < AutoQuality::frames; ++i) EXPECT_FALSE(chooser.note(150.0F, false));
  for (size_t i = 1; i < AutoQuality::frames; ++i) EXPECT_FALSE(chooser.note(16.7F, true));
  EXPECT_EQ(chooser.note(16.7F, true), Quality::high);
}

TEST(AutoQuality, a_single_slow_frame_decides_nothing) {
  AutoQuality chooser;
  EXPECT_FALSE(chooser.note(3000.0F, true));
  for (size_t i = 1; i < AutoQuality::frames; ++i) EXPECT_FALSE(chooser.note(40.0F, true));
  EXPECT_EQ(chooser.quality(), Quality::medium);
}

}  // namespace
}  // namespace scree
