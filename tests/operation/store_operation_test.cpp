// Digs and places: carves and fills whose mass goes into a store, and comes out of one.
#include <gtest/gtest.h>

#include "shared/material/palette.h"
#include "tests/support/ledger_ground.h"

namespace scree {
namespace {

TerrainSource ground_with_rubble() {
  TerrainSource source = flat_terrain;
  source.rubble = Rubble(rubble_rows(*with_rubble(shared_builtin_palette())));
  return source;
}

uint64_t field_after(const Operation& operation) {
  LedgerGround ground;
  ground.act(operation);
  return ground.field.hash();
}

TEST(StoreOperations, a_dig_leaves_the_terrain_that_a_carve_leaves) {
  for (const glm::vec3 at_m : {glm::vec3(0.0F), glm::vec3(3.0F, -1.0F, 0.5F)}) {
    LedgerGround ground;
    const Applied applied = ground.act(DigOperation{sphere(at_m, 2.0F)});
    EXPECT_GT(applied.stored, 0);
    EXPECT_EQ(applied.stored, -applied.terrain_gain);
    EXPECT_EQ(applied.dust, 0);
    EXPECT_TRUE(applied.created.empty());
    EXPECT_EQ(ground.field.hash(), field_after(carve_ball(at_m, 2.0F, 1, 1)));
  }
}

TEST(StoreOperations, a_place_leaves_the_terrain_that_a_fill_leaves) {
  const Shape shape = box({0.0F, 1.0F, 0.0F}, {1.5F, 1.0F, 1.0F});
  LedgerGround ground;
  ground.act(DigOperation{sphere({9.0F, -2.0F, 0.0F}, 3.0F)});
  const uint64_t before = ground.field.hash();
  const MassUnits dug = ground.ledger.stored;
  const Applied applied = ground.act(PlaceOperation{shape, material::soil});
  EXPECT_EQ(applied.stored, -applied.terrain_gain);
  EXPECT_EQ(ground.ledger.stored, dug + applied.stored);
  EXPECT_EQ(ground.ledger.poured, 0);
  EXPECT_EQ(ground.field.hash() - before,
            field_after(FillOperation{shape, material::soil}) - LedgerGround().field.hash());
}

TEST(StoreOperations, what_is_placed_again_is_no_more_than_what_was_dug) {
  LedgerGround ground(ground_with_rubble());
  const RubbleRows& rows = ground.field.rubble();
  ground.act(DigOperation{sphere({0.0F, -2.0F, 0.0F}, 2.5F)});
  const MassUnits dug = ground.ledger.stored;
  MassUnits of_rows = 0;
  for (const MaterialLedger::Row& row : ground.materials.rows()) of_rows += row.stored;
  EXPECT_EQ(of_rows, dug);
  const Material rubble = rows.rubble[row_number(material::rock)];
  const PlaceOperation place{box({12.0F, 0.75F, 0.0F}, {1.0F, 0.75F, 1.0F}), rubble};
  const MassUnits planned = mass_placed(place, ground.field);
  const Applied applied = ground.act(place);
  EXPECT_EQ(-applied.stored, planned);
  EXPECT_EQ(ground.at({12.0F, 0.75F, 0.0F}), rubble);
  ground.act(DigOperation{box({12.0F, 0.75F, 0.0F}, {1.5F, 1.25F, 1.5F})});
  EXPECT_GE(ground.ledger.stored, dug) << "the ground about it came along";
}

TEST(StoreOperations, a_piece_goes_whole_with_all_its_materials) {
  LedgerGround ground;
  ground.act(carve_ball({0.0F, 0.0F, 0.0F}, 2.0F, 6, 10));
  ASSERT_FALSE(ground.pieces.empty());
  const auto [id, volume] = *ground.pieces.begin();
  const uint64_t field = ground.field.hash();
  const Applied applied = ground.act(DigOperation{sphere({0.0F, 0.0F, 0.0F}, 1.0F), id});
  EXPECT_EQ(applied.stored, volume->mass);
  EXPECT_EQ(ground.field.hash(), field);
  EXPECT_FALSE(ground.pieces.contains(id));
  EXPECT_FALSE(validate(DigOperation{sphere({0.0F, 0.0F, 0.0F}, 1.0F), id}, ground.pieces, 0.25F));
}

TEST(StoreOperations, a_ledger_gives_no_more_of_a_material_than_is_stored) {
  MaterialLedger ledger;
  const Material rock = material::rock;
  ASSERT_TRUE(ledger.enter(std::vector<MaterialFlow>{{.material = rock, .terrain = -9, .stored = 9}}));
  EXPECT_FALSE(ledger.enter(std::vector<MaterialFlow>{{.material = rock, .terrain = 10, .stored = -10}}));
  EXPECT_EQ(ledger.rows()[row_number(rock)].stored, 9);
  EXPECT_TRUE(ledger.enter(std::vector<MaterialFlow>{{.material = rock, .terrain = 9, .stored = -9}}));
  EXPECT_TRUE(ledger.agrees(Ledger{}));
}

}  // namespace
}  // namespace scree
