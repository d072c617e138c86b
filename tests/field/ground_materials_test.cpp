// Materials of stored ground, whose layers the chunks above tell.
#include "shared/field/ground_materials.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "shared/field/field.h"
#include "shared/field/terrain.h"

namespace scree {
namespace {

/// Two chunks of rock, one on the other, on level ground whose surface is between them.
class TwoChunks final : public GroundModel {
 public:
  TwoChunks() : GroundModel(level(), BrickLayout{0.25F, {0, -1, 0}, {1, 1, 1}}) {}

  void give_upper() { upper_ = true; }

  std::shared_ptr<const HeightTile> tile(TileKey) const override {
    return std::make_shared<const HeightTile>();
  }
  std::vector<uint8_t> packed(TileKey) const override { return {}; }
  bool has(TileKey) const override { return true; }
  ChunkLookup chunk(TileKey key) const override {
    if (key.y == 0 && !upper_) return {false, nullptr};
    return {true, std::make_shared<const GeneratedChunk>(uniform_chunk(solid_brick()))};
  }

 private:
  static HeightLayout level() { return {2, 2, 1.0F, 0, 0, {5.0F, 60.0F}}; }

  bool upper_ = false;
};

/// A column's highest brick of the lower chunk.
constexpr BrickCoord beneath{1, -1, 1};

struct Ground {
  std::shared_ptr<TwoChunks> model = std::make_shared<TwoChunks>();
  TerrainSource source{TerrainKind::flat, 1, 0.25F, model};
};

TEST(GroundMaterials, wait_for_the_chunk_above) {
  Ground late;
  const MapField field(late.source);
  EXPECT_FALSE(is_here(late.source, chunk_of(beneath)));
  field.ground_materials(beneath);  // somebody draws it before the chunk above has come
  late.model->give_upper();
  EXPECT_TRUE(is_here(late.source, chunk_of(beneath)));

  Ground whole;
  whole.model->give_upper();
  EXPECT_EQ(field.ground_materials(beneath), MapField(whole.source).ground_materials(beneath));
  EXPECT_EQ(field.ground_materials(beneath), BrickMaterials(said(material::rock)));
}

TEST(GroundMaterials, name_the_tile_of_the_chunk_above) {
  const Ground ground;
  const std::vector<TileKey> tiles = tiles_of(ground.source, chunk_of(beneath));
  EXPECT_TRUE(std::ranges::count(tiles, key_of(0, {0, -1, 0})) == 1);
  EXPECT_TRUE(std::ranges::count(tiles, key_of(0, {0, 0, 0})) == 1);
}

TEST(GroundMaterials, are_of_the_soil_under_the_sky) {
  const Ground ground;
  const GeneratedChunk rock = uniform_chunk(solid_brick());
  // The chunk above is not there: the level surface stands in for it.
  const BrickMaterials made = ground_materials_of(ground.source, beneath, rock);
  EXPECT_EQ(made.at(Brick::index(3, 7, 3)), said(material::soil));
  EXPECT_EQ(made.at(Brick::index(3, 0, 3)), said(material::rock));
}

}  // namespace
}  // namespace scree
