// A field over another one: what is written stays in the layer, all else reads as the one below.
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "shared/field/field.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/materials.h"

namespace scree {
namespace {

Brick brick_of_noise(Random& random) {
  Brick brick;
  for (Code& code : brick.codes) code = static_cast<Code>(static_cast<int>(random.below(255)) - 127);
  return brick;
}

BrickCoord near_origin(Random& random) {
  const auto at = [&] { return static_cast<int>(random.below(10)) - 5; };
  return {at(), at(), at()};
}

TEST(Layer, what_is_written_stays_in_the_layer) {
  Random random(3);
  MapField below(flat_terrain);
  const Brick old = brick_of_noise(random), other = brick_of_noise(random), written = brick_of_noise(random);
  below.set_brick({0, 0, 0}, old);
  below.set_materials({0, 0, 0}, all_of(material::ice));
  const uint64_t hash = below.hash();
  MapField layer(&below);
  EXPECT_EQ(layer.source(), below.source());
  EXPECT_EQ(layer.brick({0, 0, 0}), old);
  EXPECT_EQ(layer.brick({0, -5, 0}), solid_brick());
  EXPECT_EQ(layer.hash(), hash);

  layer.set_brick({0, 0, 0}, written);
  EXPECT_EQ(layer.brick({0, 0, 0}), written);
  EXPECT_EQ(layer.materials({0, 0, 0}), all_of(material::ice)) << "paint lies on what was painted";
  layer.set_materials({0, 0, 0}, BrickMaterials());
  EXPECT_TRUE(layer.materials({0, 0, 0}).is_ground());
  layer.set_materials({0, 0, 1}, all_of(material::soil));
  EXPECT_TRUE(layer.is_edited({0, 0, 1}));
  EXPECT_EQ(below.hash(), hash);
  EXPECT_EQ(below.brick({0, 0, 0}), old);
  EXPECT_EQ(below.materials({0, 0, 0}), all_of(material::ice));
  EXPECT_FALSE(below.is_edited({0, 0, 1}));

  // Beside what was written, in the same chunk, the layer shows what the field below becomes.
  below.set_brick({1, 0, 0}, other);
  EXPECT_EQ(layer.brick({1, 0, 0}), other);
  EXPECT_TRUE(layer.is_edited({1, 0, 0}));
  below.forget_chunk({0, 0, 0});
  EXPECT_EQ(layer.brick({1, 0, 0}), layer.generated_brick({1, 0, 0}));
  EXPECT_EQ(layer.brick({0, 0, 0}), written);
}

TEST(Layer, generated_chunks_are_kept_below) {
  MapField below({TerrainKind::noise, 5, voxel_m});
  MapField layer(&below);
  layer.brick({0, 3, 0});
  EXPECT_TRUE(below.has_generated({0, 0, 0}));
  EXPECT_EQ(&layer.generated_brick({0, 3, 0}), &below.generated_brick({0, 3, 0}));
  layer.adopt_generated({7, 0, 0}, generate_chunk(below.source(), {7, 0, 0}));
  EXPECT_TRUE(below.has_generated({7, 0, 0}));
  EXPECT_TRUE(layer.has_generated({7, 0, 0}));
  EXPECT_EQ(layer.generated_chunks(), 2U);
}

TEST(Layer, reads_and_hashes_as_one_field_with_the_edits_of_both) {
  Random random(11);
  MapField below(flat_terrain), both(flat_terrain);
  for (int i = 0; i < 60; ++i) {
    const BrickCoord at = near_origin(random);
    const Brick brick = brick_of_noise(random);
    for (MapField* field : {&below, &both}) {
      field->set_brick(at, brick);
      if (i % 3 == 0) field->set_materials(at, all_of(material::ice));
    }
  }
  MapField layer(&below);
  for (int i = 0; i < 200; ++i) {
    const BrickCoord at = near_origin(random);
    const Brick brick = brick_of_noise(random);
    const uint32_t act = random.below(4);
    for (MapField* field : {&layer, &both}) {
      if (act == 0) field->set_materials(at, all_of(material::soil));
      if (act == 1) field->set_materials(at, BrickMaterials());
      if (act > 1) field->set_brick(at, brick);
    }
    ASSERT_EQ(layer.hash(), both.hash()) << i;
    ASSERT_EQ(layer.edited_brick_count(), both.edited_brick_count()) << i;
  }
  EXPECT_EQ(layer.edited_chunks(), both.edited_chunks());
  for (const ChunkCoord chunk : both.edited_chunks()) {
    EXPECT_TRUE(layer.has_edits(chunk));
    EXPECT_EQ(layer.chunk_hash(chunk), both.chunk_hash(chunk));
    EXPECT_EQ(layer.edited_bricks(chunk), both.edited_bricks(chunk));
    EXPECT_EQ(layer.chunk_bricks(chunk).edited, both.chunk_bricks(chunk).edited);
    for (const BrickCoord brick : both.edited_bricks(chunk)) {
      EXPECT_EQ(layer.brick(brick), both.brick(brick));
      EXPECT_EQ(layer.materials(brick), both.materials(brick));
    }
  }
  const VoxelBox box{{-40, -40, -40}, {40, 40, 40}};
  EXPECT_EQ(gather(layer, box).codes, gather(both, box).codes);
}

}  // namespace
}  // namespace scree
