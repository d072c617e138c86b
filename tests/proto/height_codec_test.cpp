// Tiles of elevation models as bytes: exact, and refused when they are damaged or beyond what was said.
#include "proto/height_codec.h"

#include <gtest/gtest.h>

#include "proto/limits.h"
#include "shared/base/random.h"
#include "tests/support/memory_heights.h"

namespace scree {
namespace {

const HeightLayout wide_layout{500, 500, 1.0F, -100000, 100000, {}};

HeightTile rough_tile() {
  HeightTile tile;
  for (int z = 0; z < tile_samples; ++z)
    for (int x = 0; x < tile_samples; ++x) tile.heights[HeightTile::index(x, z)] = rough_height(x, z) - 7000;
  return tile;
}

TEST(HeightCodec, tiles_come_back_with_the_hashes_of_those_below) {
  std::vector<Digest> children(4);
  children[2].fill(7);
  const auto tile = rough_tile();
  const auto back = unpack_tile(pack_tile(children, tile), {1, 0, 0}, wide_layout);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->children, children);
  EXPECT_EQ(back->tile.heights, tile.heights);
  EXPECT_LT(pack_tile({}, tile).size(), 16'000U) << "a byte a sample is plenty for hills";
}

TEST(HeightCodec, what_nothing_compresses_fits_as_well) {
  HeightTile noise;
  Random random(3);
  for (int32_t& height : noise.heights) height = static_cast<int32_t>(random.next() % 200001U) - 100000;
  const auto packed = pack_tile({}, noise);
  EXPECT_LE(packed.size(), limits::tile_bytes_max);
  const auto back = unpack_tile(packed, {0, 0, 0}, wide_layout);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->tile.heights, noise.heights);
}

TEST(HeightCodec, truncated_prolonged_and_foreign_bytes_are_refused) {
  const std::vector<uint8_t> packed = pack_tile(std::vector<Digest>(4), rough_tile());
  const TileKey key{1, 0, 0};
  ASSERT_TRUE(unpack_tile(packed, key, wide_layout));
  for (size_t size = 0; size < packed.size(); size += size < 200 ? 1 : 61)
    EXPECT_FALSE(unpack_tile(std::span(packed).first(size), key, wide_layout)) << size;
  std::vector<uint8_t> more = packed;
  more.push_back(0);
  EXPECT_FALSE(unpack_tile(more, key, wide_layout));
  EXPECT_FALSE(unpack_tile(packed, {0, 0, 0}, wide_layout)) << "a tile of level 0 names none";
  EXPECT_FALSE(unpack_tile(std::vector<uint8_t>(limits::tile_bytes_max + 1), key, wide_layout));
}

TEST(HeightCodec, heights_beyond_those_of_the_model_are_refused) {
  HeightLayout narrow = wide_layout;
  narrow.highest = -6990;
  EXPECT_FALSE(unpack_tile(pack_tile({}, rough_tile()), {0, 0, 0}, narrow));
}

}  // namespace
}  // namespace scree
