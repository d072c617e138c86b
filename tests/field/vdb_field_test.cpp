// The authoritative field reads back what was written last, whatever OpenVDB keeps it in.
#include "server/field/vdb_field.h"

#include <gtest/gtest.h>

#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

Brick half_full() {
  Brick brick;
  for (size_t i = 0; i < brick.codes.size(); ++i) brick.codes[i] = static_cast<Code>(i < 256 ? -50 : 50);
  return brick;
}

TEST(vdb_field, a_brick_that_became_uniform_reads_so_at_once) {
  VdbField field(flat_terrain);
  const Brick mixed = half_full();
  for (int x = 0; x < 64; ++x) {
    const BrickCoord coord{x, 3, 0};
    field.set_brick(coord, mixed);
    EXPECT_EQ(field.brick(coord), mixed);
    const Brick& uniform = x % 2 == 0 ? air_brick() : solid_brick();
    field.set_brick(coord, uniform);
    EXPECT_EQ(&field.brick(coord), &uniform) << "not a leaf that is there no more";
    field.set_brick(coord, mixed);
    EXPECT_EQ(field.brick(coord), mixed);
  }
}

TEST(vdb_field, a_forgotten_brick_is_not_edited_any_more) {
  VdbField field(flat_terrain);
  const BrickCoord coord{1, -1, 2};
  const Brick generated = field.brick(coord);
  field.set_brick(coord, half_full());
  EXPECT_TRUE(field.is_edited(coord));
  field.forget_chunk(chunk_of(coord));
  EXPECT_FALSE(field.is_edited(coord));
  EXPECT_EQ(field.brick(coord), generated);
  EXPECT_EQ(field.hash(), 0U);
}

}  // namespace
}  // namespace scree
