// Packed poses: exact, small, and checked.
#include "proto/transforms.h"

#include <gtest/gtest.h>

#include "shared/base/random.h"

namespace scree {
namespace {

/// Pieces of one carve: ids in a row, within a few metres of each other.
std::vector<PieceState> neighbours(size_t count) {
  Random random(1);
  std::vector<PieceState> pieces;
  for (size_t i = 0; i < count; ++i) {
    const auto near = [&](int32_t centre) {
      return centre + static_cast<int32_t>(random.below(8000)) - 4000;
    };
    pieces.push_back(
        {static_cast<PieceId>(1000 + i), {near(40000), near(9000), near(-30000), random.next()}});
  }
  return pieces;
}

TEST(Transforms, poses_round_trip_exactly) {
  std::vector<PieceState> pieces = neighbours(500);
  pieces.push_back(
      {0xFFFFFFFFU, {limits::pose_coordinate_max, -limits::pose_coordinate_max, 0, 0xFFFFFFFFU}});
  pieces.insert(pieces.begin(), {0, {-limits::pose_coordinate_max, limits::pose_coordinate_max, -1, 0}});
  const auto got = unpack_transforms(pack_transforms(pieces));
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_EQ(*got, pieces);
}

TEST(Transforms, none_takes_no_bytes) {
  EXPECT_TRUE(pack_transforms({}).empty());
  const auto got = unpack_transforms({});
  ASSERT_TRUE(got);
  EXPECT_TRUE(got->empty());
}

TEST(Transforms, neighbours_take_at_most_12_bytes_each) {
  const std::vector<PieceState> pieces = neighbours(500);
  EXPECT_LE(pack_transforms(pieces).size(), 12 * pieces.size());
}

TEST(Transforms, every_truncation_within_a_piece_is_refused) {
  const std::vector<uint8_t> bytes = pack_transforms(neighbours(3));
  size_t whole = 0;
  for (size_t length = 0; length <= bytes.size(); ++length)
    whole += unpack_transforms(std::span(bytes).first(length)).has_value() ? 1 : 0;
  EXPECT_EQ(whole, 4U);  // after 0, 1, 2 and 3 pieces
}

TEST(Transforms, ids_that_do_not_ascend_are_refused) {
  std::vector<uint8_t> bytes = pack_transforms(std::vector<PieceState>{{5, {}}});
  bytes.insert(bytes.end(), {0, 0, 0, 0, 1, 2, 3, 4});
  const auto got = unpack_transforms(bytes);
  ASSERT_FALSE(got);
  EXPECT_NE(got.error().message.find("ascending"), std::string::npos);
}

TEST(Transforms, more_than_a_frame_may_hold_are_refused) {
  std::vector<PieceState> pieces(limits::entries_per_frame_max);
  for (size_t i = 0; i < pieces.size(); ++i) pieces[i].id = static_cast<PieceId>(i);
  EXPECT_TRUE(unpack_transforms(pack_transforms(pieces)));
  pieces.push_back({static_cast<PieceId>(pieces.size()), {}});
  const auto got = unpack_transforms(pack_transforms(pieces));
  ASSERT_FALSE(got);
  EXPECT_NE(got.error().message.find("more than 65536 pieces"), std::string::npos) << got.error().message;
}

TEST(Transforms, positions_beyond_their_range_are_refused) {
  std::vector<PieceState> pieces = {{1, {limits::pose_coordinate_max, 0, 0, 0}}};
  std::vector<uint8_t> bytes = pack_transforms(pieces);
  bytes.insert(bytes.end(), {1, 2, 0, 0, 1, 2, 3, 4});  // one step further in x
  const auto got = unpack_transforms(bytes);
  ASSERT_FALSE(got);
  EXPECT_NE(got.error().message.find("position"), std::string::npos);
}

}  // namespace
}  // namespace scree
