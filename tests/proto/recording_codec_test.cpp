// The blobs of a recording: what would take memory out of proportion to its bytes is refused.
#include "server/formats/recording_codec.h"

#include <gtest/gtest.h>

#include "proto/limits.h"
#include "shared/base/limits.h"

namespace scree {
namespace {

/// Each piece is a hundred bytes in the blob and 2 MiB here.
TEST(RecordingCodec, a_keyframe_of_pieces_of_air_cannot_fill_the_memory) {
  constexpr int side = limits::window_side_max;
  PieceMessage piece;
  piece.volume.window = Window(VoxelBox{{0, 0, 0}, {side, side, side}});
  piece.volume.centre_voxels = glm::vec3(0.5F * side);
  RecordedKeyframe keyframe;
  keyframe.tick = 600;
  keyframe.pieces.push_back(piece);
  const Result<RecordedKeyframe> one = decode_recorded_keyframe(encode(keyframe));
  ASSERT_TRUE(one) << one.error().message;
  EXPECT_EQ(one->pieces.size(), 1U);
  for (size_t voxels = 0; voxels <= limits::piece_voxels_max; voxels += piece.volume.window.codes.size())
    keyframe.pieces.push_back(piece);
  const std::vector<uint8_t> blob = encode(keyframe);
  EXPECT_LT(blob.size(), 100'000U);
  const Result<RecordedKeyframe> many = decode_recorded_keyframe(blob);
  ASSERT_FALSE(many);
  EXPECT_NE(many.error().message.find("limits.piece_voxels_max"), std::string::npos) << many.error().message;
}

TEST(RecordingCodec, commands_keep_their_parties) {
  std::vector<Command> commands(3);
  for (uint32_t i = 0; i < 3; ++i) commands[i] = {i + 1, i, PaintRequest{sphere({}, 1.0F), material::ice}, 0};
  EXPECT_EQ(decode_recorded_commands(encode(commands))->at(1).party, 0U);
  const size_t plain = encode(commands).size();
  commands[2].party = 2;
  const std::vector<uint8_t> blob = encode(commands);
  EXPECT_GT(blob.size(), plain) << "where all share with none, nothing is kept";
  const auto read = decode_recorded_commands(blob);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->at(1).party, 0U);
  EXPECT_EQ(read->at(2).party, 2U);
  EXPECT_EQ(read->at(2).session, 3U);
}

TEST(RecordingCodec, parties_without_their_commands_are_refused) {
  const std::vector<Command> commands = {{1, 1, PaintRequest{sphere({}, 1.0F), material::ice}, 1}};
  std::vector<uint8_t> blob = encode(commands);
  blob.insert(blob.end(), {0x1A, 1, 5});  // field 3, packed: one party more
  const auto read = decode_recorded_commands(blob);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("parties and requests differ in number"), std::string::npos);
}

TEST(RecordingCodec, that_a_session_cannot_go_on_is_kept_among_the_commands) {
  const std::vector<Command> commands = {{4, 1, PaintRequest{sphere({}, 1.0F), material::ice}, 1},
                                         {4, 0, LeaveRequest{}, 0}};
  const auto read = decode_recorded_commands(encode(commands));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(read->at(1).session, 4U);
  EXPECT_TRUE(std::holds_alternative<LeaveRequest>(read->at(1).body));
}

/// Sums of ledgers must not overflow, whatever a file says.
TEST(RecordingCodec, a_ledger_with_more_than_there_can_be_is_refused) {
  constexpr MassUnits most = MassUnits{1} << 55U;
  for (MassUnits Ledger::*mass :
       {&Ledger::terrain, &Ledger::pieces, &Ledger::dust, &Ledger::poured, &Ledger::moved})
    for (const MassUnits sign : {1, -1}) {
      RecordedFrame frame;
      frame.ledger.*mass = sign * most;
      EXPECT_TRUE(decode_recorded_frame(encode(frame)));
      frame.ledger.*mass = sign * (most + 1);
      const auto refused = decode_recorded_frame(encode(frame));
      ASSERT_FALSE(refused);
      EXPECT_NE(refused.error().message.find("limits.ledger_mass_max"), std::string::npos)
          << refused.error().message;
      RecordedKeyframe keyframe;
      keyframe.ledger = frame.ledger;
      EXPECT_FALSE(decode_recorded_keyframe(encode(keyframe)));
    }
}

TEST(RecordingCodec, a_ledger_of_a_material_with_more_than_there_can_be_is_refused) {
  using Row = MaterialLedger::Row;
  constexpr MassUnits most = MassUnits{1} << 55U;
  for (MassUnits Row::*mass : {&Row::terrain, &Row::pieces, &Row::dust, &Row::poured, &Row::converted})
    for (const MassUnits sign : {1, -1}) {
      std::vector<Row> rows(255);
      rows.back().*mass = sign * most;
      RecordedKeyframe keyframe;
      keyframe.materials = MaterialLedger(rows);
      EXPECT_TRUE(decode_recorded_keyframe(encode(keyframe)));
      rows.back().*mass = sign * (most + 1);
      keyframe.materials = MaterialLedger(rows);
      const auto refused = decode_recorded_keyframe(encode(keyframe));
      ASSERT_FALSE(refused);
      EXPECT_NE(refused.error().message.find("limits.ledger_mass_max"), std::string::npos)
          << refused.error().message;
    }
}

}  // namespace
}  // namespace scree
