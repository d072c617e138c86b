#include "server/world/stone_keeper.h"

#include <algorithm>
#include <utility>

#include "server/world/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

size_t bytes_of_stone(const PlacedStone& placed) {
  const Volume& volume = *placed.stone.volume;
  return sizeof(Volume) + volume.window.codes.size() * sizeof(Code) +
         volume.materials.each.size() * sizeof(Material);
}

/// An edited chunk in which a point lies, if there is any: clients follow edited chunks alone.
ChunkCoord chunk_of_stone(const StonePoints& points, const Field& field) {
  const auto chunk_at = [](glm::vec3 voxels) {
    return chunk_of(VoxelCoord{floor_to_int(voxels.x), floor_to_int(voxels.y), floor_to_int(voxels.z)});
  };
  const auto edited =
      std::ranges::find_if(points, [&](glm::vec3 point) { return field.has_edits(chunk_at(point)); });
  return chunk_at(edited == points.end() ? points.front() : *edited);
}

std::vector<BrickCoord> changed_bricks(const TickDelta& delta) {
  std::vector<BrickCoord> changed = delta.reverted;
  for (const BrickState& brick : delta.bricks) changed.push_back(brick.coord);
  return changed;
}

}  // namespace

void StoneKeeper::restart(const PieceTable& pieces, std::span<const SettledStone> stones, PieceId next_piece,
                          const Field& field) {
  stones_.clear();
  places_.clear();
  bytes_ = 0;
  alive_ = {pieces.begin(), pieces.end()};
  for (const SettledStone& stone : stones) {
    if (stone.volume == nullptr || stone.id >= next_piece || pieces.contains(stone.id) ||
        stones_.contains(stone.id))
      continue;
    StonePoints points =
        chosen(stone_points(*stone.volume, dequantise(stone.pose), field.source().voxel_size_m), stone.lies);
    if (!points.empty()) insert(stone, std::move(points), field);
  }
  while (stones_.size() > limits::kept_stones_max || bytes_ > limits::kept_stone_bytes_max) {
    const PieceId oldest = stones_.begin()->first;
    places_.remove(oldest);
    take(oldest);
  }
}

void StoneKeeper::follow(const Field& field, TickDelta& delta) {
  if (!stones_.empty())
    for (const PieceId id : end_stones(places_, changed_bricks(delta), field))
      delta.stones_gone.push_back(take(id));
  for (const SpawnedPiece& piece : delta.spawned) alive_[piece.id] = piece.volume;
  for (const AppliedOperation& applied : delta.operations) {
    if (const auto* const stamp = std::get_if<StampOperation>(&applied.operation))
      merge(*stamp, field, delta);
    for (const PieceId ended : pieces_ended_by(applied.operation)) alive_.erase(ended);
  }
  while (stones_.size() > limits::kept_stones_max || bytes_ > limits::kept_stone_bytes_max) {
    const PieceId oldest = stones_.begin()->first;
    places_.remove(oldest);
    std::erase_if(delta.stones, [&](const PlacedStone& placed) { return placed.stone.id == oldest; });
    delta.stones_gone.push_back(take(oldest));
  }
}

void StoneKeeper::merge(const StampOperation& stamp, const Field& field, TickDelta& delta) {
  settle({stamp.piece, stamp.pose}, field, delta);
  for (const StampedPiece& other : stamp.others) settle(other, field, delta);
}

void StoneKeeper::settle(const StampedPiece& piece, const Field& field, TickDelta& delta) {
  const auto found = alive_.find(piece.piece);
  CHECK(found != alive_.end());
  const float voxel_size_m = field.source().voxel_size_m;
  const Pose pose = dequantise(piece.pose);
  if (!has_moved(*found->second, pose, voxel_size_m)) return;
  const StonePoints points = stone_points(*found->second, pose, voxel_size_m);
  const uint32_t lies = points_in_rock(points, field);
  if (lies == 0) return;
  if (stones_.contains(piece.piece)) {  // a recording that gives an id twice
    places_.remove(piece.piece);
    delta.stones_gone.push_back(take(piece.piece));
  }
  insert({piece.piece, found->second, piece.pose, lies}, chosen(points, lies), field);
  delta.stones.push_back(stones_.at(piece.piece));
}

void StoneKeeper::insert(SettledStone stone, StonePoints points, const Field& field) {
  const PieceId id = stone.id;
  const ChunkCoord chunk = chunk_of_stone(points, field);
  places_.add(id, std::move(points));
  const auto [placed, is_new] = stones_.try_emplace(id, PlacedStone{std::move(stone), chunk});
  CHECK(is_new);
  bytes_ += bytes_of_stone(placed->second);
}

PlacedStone StoneKeeper::take(PieceId id) {
  const auto found = stones_.find(id);
  CHECK(found != stones_.end());
  PlacedStone placed = std::move(found->second);
  stones_.erase(found);
  bytes_ -= bytes_of_stone(placed);
  return placed;
}

std::vector<SettledStone> StoneKeeper::value() const {
  std::vector<SettledStone> stones;
  stones.reserve(stones_.size());
  for (const auto& [id, placed] : stones_) stones.push_back(placed.stone);
  return stones;
}

std::vector<PlacedStone> StoneKeeper::all() const {
  std::vector<PlacedStone> stones;
  stones.reserve(stones_.size());
  for (const auto& [id, placed] : stones_) stones.push_back(placed);
  return stones;
}

}  // namespace scree
