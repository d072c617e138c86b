// The packed lists of a world's value: coordinates, ids, boxes, points. Internal to proto/.
#pragma once

#include <string>
#include <vector>

#include "proto/byte_stream.h"
#include "server/formats/world_value.h"

namespace scree {

/// Bytes that a function writes.
template <typename Write>
std::string packed(Write&& write) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  write(writer);
  return {bytes.begin(), bytes.end()};
}

/// Refuses a list of more entries.
void refuse_more(ByteReader& reader, size_t count_max);

/// Reads entries until the bytes end, at most `count_max`; `read(reader)` returns one.
template <typename T, typename Read>
Result<std::vector<T>> unpacked(const std::string& bytes, const char* what, size_t count_max, Read&& read) {
  ByteReader reader({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, what);
  std::vector<T> list;
  while (!reader.at_end()) {
    if (list.size() == count_max) refuse_more(reader, count_max);
    if (!reader.failed()) list.push_back(read(reader));
  }
  if (reader.failed()) return tl::unexpected(reader.error());
  return list;
}

std::string pack_bricks(const std::vector<BrickCoord>& bricks);
std::string pack_ids(const std::vector<PieceId>& ids);
std::string pack_boxes(const std::vector<VoxelBox>& boxes);
std::string pack_bounds(const std::vector<BoundsM>& bounds);
std::string pack_vec3s(const std::vector<glm::vec3>& points);
std::string pack_bodies(const std::vector<BodyMotion>& bodies);
std::string pack_timers(const std::vector<StillnessTimer>& timers);
std::string pack_turns(const std::vector<TurnsValue::Turn>& turns);

Result<std::vector<BrickCoord>> unpack_bricks(const std::string& bytes, const char* what);
/// Ascending.
Result<std::vector<PieceId>> unpack_piece_ids(const std::string& bytes, const char* what);
/// None is empty.
Result<std::vector<VoxelBox>> unpack_boxes(const std::string& bytes, const char* what);
Result<std::vector<BoundsM>> unpack_bounds(const std::string& bytes, const char* what);
Result<std::vector<glm::vec3>> unpack_vec3s(const std::string& bytes, const char* what, size_t count_max);
/// Ascending ids, as watches.
Result<std::vector<BodyMotion>> unpack_bodies(const std::string& bytes);
Result<std::vector<StillnessTimer>> unpack_timers(const std::string& bytes);
/// Ascending.
Result<std::vector<TurnsValue::Turn>> unpack_turns(const std::string& bytes);

}  // namespace scree
