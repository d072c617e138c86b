// What files say of their ground (its hash in a header, its mass in a row of a chunk), and whose work waits.
#include "server/formats/world_codec.h"

#include <gtest/gtest.h>

#include "server/formats/recording_codec.h"
#include "shared/field/mass.h"

namespace scree {
namespace {

using FileBytes = std::vector<uint8_t>;

WorldChunk chunk_of_one_brick(MassUnits ground_mass) {
  const BrickPatch brick{{4, -1, 2}, solid_brick(), {}};
  return {
      chunk_of(brick.coord), 9, brick_hash(brick.coord, brick.brick, brick.materials), {brick}, ground_mass};
}

TEST(KeptCodec, a_header_names_its_ground_or_none) {
  RecordedHeader header;
  header.program = "test";
  const FileBytes without = encode(header);
  EXPECT_EQ(decode_recorded_header(without)->ground, Digest{});
  header.ground[3] = 7;
  const auto decoded = decode_recorded_header(encode(header));
  ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
  EXPECT_EQ(decoded->ground, header.ground);
  FileBytes cut = without;
  cut.insert(cut.end(), {0xC2, 0x02, 2, 7, 7});  // field 40, of 2 bytes
  const auto refused = decode_recorded_header(cut);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("32 bytes"), std::string::npos) << refused.error().message;
}

TEST(KeptCodec, a_chunk_says_what_its_ground_weighs_within_what_rock_does) {
  const MassUnits most = brick_mass(solid_brick());
  for (const MassUnits mass : {MassUnits{0}, most}) {
    const auto decoded = decode_world_chunk(encode(chunk_of_one_brick(mass)));
    ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
    EXPECT_EQ(decoded->ground_mass, mass);
  }
  for (const MassUnits mass : {MassUnits{-1}, most + 1}) {
    const auto decoded = decode_world_chunk(encode(chunk_of_one_brick(mass)));
    ASSERT_FALSE(decoded.has_value());
    EXPECT_NE(decoded.error().message.find("ground"), std::string::npos) << decoded.error().message;
  }
  WorldChunk unknown = chunk_of_one_brick(0);
  unknown.ground_mass.reset();
  EXPECT_EQ(decode_world_chunk(encode(unknown))->ground_mass, std::nullopt);
}

WorldMoment moment_with(const std::vector<PartyBricks>& bricks) {
  WorldMoment moment;
  moment.config.rules = 1;
  moment.loosened_bricks = moment.strained = moment.slopes = bricks;
  moment.islands = {{{{1, 2, 3}}, 2, 8}};
  moment.refractures = {
      {.piece = 4, .pieces = 9, .impact_m = {1.0F, 2.0F, 3.0F}, .party = 6, .blasted = true}};
  return moment;
}

TEST(KeptCodec, work_that_waits_keeps_its_party) {
  const std::vector<PartyBricks> bricks = {{0, {{1, 1, 1}}}, {7, {{-3, 0, 2}, {5, 0, 0}}}};
  const auto decoded = decode_world_moment(encode(moment_with(bricks)));
  ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
  EXPECT_EQ(decoded->config.rules, 1U);
  EXPECT_EQ(decoded->loosened_bricks, bricks);
  EXPECT_EQ(decoded->strained, bricks);
  EXPECT_EQ(decoded->slopes, bricks);
  EXPECT_EQ(decoded->islands, moment_with({}).islands);
  ASSERT_EQ(decoded->refractures.size(), 1U);
  EXPECT_EQ(decoded->refractures[0].party, 6U);
}

/// As files of before have it: no parties, and none of the new fields.
TEST(KeptCodec, bricks_without_parties_are_the_worlds_own) {
  const std::vector<PartyBricks> own = {{0, {{1, 1, 1}, {2, 0, 0}}}};
  WorldMoment moment = moment_with(own);
  const FileBytes with_none = encode(moment);
  EXPECT_EQ(decode_world_moment(with_none)->loosened_bricks, own);
  moment.loosened_bricks = moment.strained = {{0, {{1, 1, 1}}}, {7, {{2, 0, 0}}}};
  EXPECT_GT(encode(moment).size(), with_none.size());
  FileBytes spoilt = encode(moment);
  spoilt.insert(spoilt.end(),
                {0xCA, 0x01, 4, 8, 9, 16, 1});  // field 25: a share of party 9, of one brick more
  const auto refused = decode_world_moment(spoilt);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("their parties"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace scree
