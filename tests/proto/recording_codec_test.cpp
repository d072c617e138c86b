// The blobs of a recording: what would take memory out of proportion to its bytes is refused.
#include "proto/recording_codec.h"

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

}  // namespace
}  // namespace scree
