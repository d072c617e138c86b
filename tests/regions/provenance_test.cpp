// Masses by origin: arithmetic, places, and what is kept of them.
#include "server/provenance/provenance.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

#include "shared/operation/ledger.h"
#include "tests/support/materials.h"

namespace scree {
namespace {

TEST(OriginShares, a_part_of_a_mass_takes_of_each_share_its_part) {
  OriginShares shares{{{1, 7}, 50}, {{1, 8}, 30}, {{2, 7}, 20}};
  const OriginShares taken = take_part(shares, 50, 200);
  EXPECT_EQ(taken, (OriginShares{{{1, 7}, 12}, {{1, 8}, 7}, {{2, 7}, 5}}));
  EXPECT_EQ(shares, (OriginShares{{{1, 7}, 38}, {{1, 8}, 23}, {{2, 7}, 15}}));
  EXPECT_EQ(take_part(shares, 150, 150), (OriginShares{{{1, 7}, 38}, {{1, 8}, 23}, {{2, 7}, 15}}));
  EXPECT_TRUE(shares.empty());
}

TEST(OriginShares, nothing_is_lost_or_made_however_masses_are_cut) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 2000; ++round) {
    OriginShares shares;
    const auto of = [&](uint64_t most) { return static_cast<MassUnits>(random() % most); };
    const uint64_t most = round % 2 == 0 ? 4 : uint64_t{1} << 54U;
    const size_t count = 1 + random() % 5;
    for (size_t i = 0; i < count; ++i)
      add(shares, {static_cast<RegionId>(1 + random() % 3), random() % 2}, of(most));
    const MassUnits known = sum_of(shares);
    MassUnits whole = known + (round % 3 == 0 ? 0 : of(most));
    while (whole > 0) {
      const MassUnits part = std::max<MassUnits>(1, of(static_cast<uint64_t>(whole) + 1));
      const MassUnits before = sum_of(shares);
      const OriginShares taken = take_part(shares, part, whole);
      whole -= part;
      ASSERT_EQ(sum_of(taken) + sum_of(shares), before);
      ASSERT_LE(sum_of(taken), part);
      ASSERT_LE(sum_of(shares), whole);
      for (const OriginShare& share : shares) ASSERT_GT(share.mass, 0);
    }
    EXPECT_TRUE(shares.empty());
  }
}

TEST(Provenance, what_finds_no_place_counts_as_elsewhere) {
  Provenance provenance;
  const MassOrigin origin{1, 7};
  const auto count = static_cast<MassUnits>(limits::origin_places_max) + 5;
  provenance.cut(origin, material::rock, count);
  for (MassUnits i = 0; i < count; ++i)
    provenance.put({TerrainPlace{{static_cast<int32_t>(i), 0, 0}, 1, true}, material::rock}, {{origin, 1}});
  EXPECT_EQ(provenance.terrain_places(), limits::origin_places_max);
  ASSERT_EQ(provenance.masses().size(), 1U);
  EXPECT_EQ(provenance.masses()[0].away, 5);
  EXPECT_EQ(provenance.masses()[0].back, count - 5);
  provenance.take_brick({0, 0, 0});
  EXPECT_EQ(provenance.terrain_places(), limits::origin_places_max - 1);
  for (uint64_t party = 0; party < limits::origins_max; ++party)
    provenance.cut(provenance.origin_of(2, 1000 + party), material::rock, 1);
  EXPECT_EQ(provenance.origin_of(2, 9), (MassOrigin{2, 0})) << "there are too many origins";
  EXPECT_EQ(provenance.origin_of(1, 7), origin);
}

TEST(Provenance, what_is_kept_wrong_is_refused) {
  const MassOrigin origin{1, 7};
  const MassPlace piece{PiecePlace{3}, material::rock}, dust{DustPlace{}, material::rock};
  EXPECT_TRUE(validate({{piece, {origin, 5}}, {dust, {origin, 5}}}));
  EXPECT_FALSE(validate({{dust, {origin, 5}}, {piece, {origin, 5}}})) << "out of order";
  EXPECT_FALSE(validate({{piece, {origin, 5}}, {piece, {origin, 5}}})) << "twice";
  EXPECT_FALSE(validate({{piece, {origin, 0}}}));
  EXPECT_FALSE(validate({{piece, {origin, -4}}}));
  EXPECT_FALSE(validate({{piece, {{0, 7}, 4}}})) << "of no region";
  EXPECT_FALSE(validate({{piece, {origin, limits::ledger_mass_max}}, {dust, {origin, 1}}}));
}

}  // namespace
}  // namespace scree
