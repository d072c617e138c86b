#include "proto/transforms.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/byte_stream.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr const char* subject = "transforms";

int32_t coordinate(ByteReader& reader, int32_t before) {
  const int64_t value = before + reader.zigzag("position", int64_t{2} * limits::pose_coordinate_max);
  if (value < -limits::pose_coordinate_max || value > limits::pose_coordinate_max)
    reader.refuse("position is 2^30 steps or more from the origin");
  return static_cast<int32_t>(value);
}

bool is_in_range(const QuantisedPose& pose) {
  constexpr int32_t most = limits::pose_coordinate_max;
  return std::max({pose.x, pose.y, pose.z}) <= most && std::min({pose.x, pose.y, pose.z}) >= -most;
}

}  // namespace

std::vector<uint8_t> pack_transforms(std::span<const PieceState> pieces) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  PieceState before;
  for (const PieceState& piece : pieces) {
    CHECK(&piece == pieces.data() || piece.id > before.id);
    CHECK_DEBUG(is_in_range(piece.pose));
    writer.varint(piece.id - before.id);
    writer.zigzag(int64_t{piece.pose.x} - before.pose.x);
    writer.zigzag(int64_t{piece.pose.y} - before.pose.y);
    writer.zigzag(int64_t{piece.pose.z} - before.pose.z);
    writer.u32(piece.pose.rotation);
    before = piece;
  }
  return bytes;
}

Result<std::vector<PieceState>> unpack_transforms(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes, subject);
  std::vector<PieceState> pieces;
  PieceState before;
  while (!reader.at_end()) {
    if (pieces.size() == limits::entries_per_frame_max) {
      reader.refuse(fmt::format("more than {} pieces", limits::entries_per_frame_max));
      break;
    }
    const uint64_t step = reader.varint("piece id", 0xFFFFFFFFU - before.id);
    if (step == 0 && !pieces.empty()) reader.refuse("piece ids are not in ascending order");
    PieceState piece;
    piece.id = before.id + static_cast<PieceId>(step);
    piece.pose.x = coordinate(reader, before.pose.x);
    piece.pose.y = coordinate(reader, before.pose.y);
    piece.pose.z = coordinate(reader, before.pose.z);
    piece.pose.rotation = reader.u32("rotation");
    pieces.push_back(piece);
    before = piece;
  }
  if (reader.failed()) return tl::unexpected(reader.error());
  return pieces;
}

}  // namespace scree
