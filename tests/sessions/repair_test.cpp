// A client whose copy goes wrong behind its back: the checks find it, and that chunk alone is sent again.
#include <gtest/gtest.h>

#include "tests/support/flat_terrain.h"
#include "tests/support/session_support.h"

namespace scree {
namespace {

/// Carves along x = 8 m, the border of two chunks, at the surface, the border of two more.
CarveMessage carve_at(float z_m, uint32_t request) {
  CarveRequest carve;
  carve.shape = sphere({8.0F, -0.4F, z_m}, 1.0F);
  carve.seeds = 8;
  carve.random_seed = request;
  carve.impact_m = {8.0F, -1.0F, z_m};
  return carve_message(carve, request);
}

void flip_a_code(Field& field, ChunkCoord chunk) {
  const BrickCoord coord = field.edited_bricks(chunk).front();
  Brick brick = field.brick(coord);
  brick.codes[0] = static_cast<Code>(-brick.codes[0]);
  field.set_brick(coord, brick);
}

class RepairTest : public ::testing::Test {
 protected:
  static LiveConfig flat() {
    LiveConfig config;
    config.world.terrain = flat_terrain;
    return config;
  }
  void SetUp() override {
    ASSERT_EQ(session.failure, "");
    witness = &session.join({8.0F, 2.0F, 4.0F}, 64.0F);
    damaged = &session.join({8.0F, 2.0F, 4.0F}, 64.0F);
    ASSERT_NE(session.ask(*witness, carve_at(1.5F, 1)), nullptr) << session.failure;
    ASSERT_TRUE(session.settle()) << session.failure;
    flip_a_code(damaged->mirror().field(), chunk);
    ASSERT_NE(damaged->mirror().field().chunk_hash(chunk), session.field().chunk_hash(chunk));
  }
  uint64_t repairs() { return session.server().report().net.published.repairs; }

  const ChunkCoord chunk{0, -1, 0};
  LoopbackSession session{flat()};
  SessionClient* witness = nullptr;
  SessionClient* damaged = nullptr;
};

TEST_F(RepairTest, a_wrong_chunk_is_found_at_its_next_change_and_sent_again_alone) {
  EXPECT_TRUE(session.steps(60));
  EXPECT_EQ(damaged->mirror().mismatches(), 0U) << "nothing has changed there";
  ASSERT_NE(session.ask(*witness, carve_at(6.0F, 2)), nullptr) << session.failure;
  EXPECT_EQ(damaged->mirror().mismatches(), 1U);
  EXPECT_GT(damaged->mirror().counters().repairs_asked, 1U) << "the carve changed several chunks";
  for (int i = 0; i < 1000 && damaged->mirror().counters().repairs_arrived == 0; ++i)
    ASSERT_TRUE(session.step()) << session.failure;
  EXPECT_EQ(repairs(), 1U);
  EXPECT_EQ(damaged->mirror().counters().chunks, 1U);
  EXPECT_EQ(damaged->mirror().field().chunk_hash(chunk), session.field().chunk_hash(chunk));

  ASSERT_TRUE(session.settle()) << session.failure;
  EXPECT_EQ(damaged->mirror().field().hash(), session.field().hash());
  EXPECT_EQ(damaged->mirror().mismatches(), 1U);
  EXPECT_EQ(repairs(), 1U);
  EXPECT_EQ(witness->mirror().mismatches(), 0U);
  EXPECT_EQ(witness->mirror().counters().chunks, 0U) << "nobody else is sent anything";
  EXPECT_EQ(witness->mirror().field().hash(), session.field().hash());
}

}  // namespace
}  // namespace scree
