#include "client/render/scene/material_texels.h"

#include <gtest/gtest.h>

#include "client/render/scene/limits.h"

namespace scree {
namespace {

TEST(MaterialTexels, are_means_of_the_pixels_they_cover) {
  constexpr auto side = static_cast<size_t>(limits::material_image_side);
  const MaterialTexels small = resampled(std::vector<uint8_t>{0, 0, 0, 200, 100, 50}, 2, 1);
  ASSERT_EQ(small.size(), side * side * 4);
  EXPECT_EQ(small[0], 0);
  EXPECT_EQ(small[(side - 1) * 4], 200);
  std::vector<uint8_t> stripes;
  for (size_t i = 0; i < side * 2; ++i) stripes.insert(stripes.end(), 3, i % 2 == 0 ? 0 : 100);
  const MaterialTexels mixed = resampled(stripes, static_cast<int>(side) * 2, 1);
  EXPECT_EQ(mixed[0], 50);
  EXPECT_EQ(mixed[3], 255);
}

}  // namespace
}  // namespace scree
