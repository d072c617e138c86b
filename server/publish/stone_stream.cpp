#include "server/publish/stone_stream.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "proto/limits.h"
#include "server/publish/chunks_near.h"

namespace scree {

namespace {

/// Stones in one list to stream; the budget of bytes ends the streaming much earlier.
constexpr size_t stone_batch = 64;

glm::vec3 middle_of_stone(const PlacedStone& placed) {
  return dequantise(placed.stone.pose).position_m;
}

/// Whether the client still waits for a chunk in which the stone may lie.
bool waits_for_ground(const PlacedStone& placed, const ClientView& view, float voxel_size_m) {
  const VoxelCoord size = placed.stone.volume->window.box.size();
  const float reach_m = glm::length(glm::vec3(size.x, size.y, size.z)) * voxel_size_m;
  const float side_m = static_cast<float>(chunk_size) * voxel_size_m;
  const glm::vec3 middle_m = middle_of_stone(placed);
  const glm::ivec3 lo(glm::floor((middle_m - reach_m) / side_m));
  const glm::ivec3 hi(glm::floor((middle_m + reach_m) / side_m));
  for (int x = lo.x; x <= hi.x; ++x)
    for (int y = lo.y; y <= hi.y; ++y)
      for (int z = lo.z; z <= hi.z; ++z)
        if (view.wants({x, y, z})) return true;
  return false;
}

}  // namespace

void StoneStream::forget() {
  known_.clear();
  open_.clear();
}

void StoneStream::note(const ServedTick& tick, const FrameSelection& frame) {
  if (!wanted_) return;
  for (const ChunkCoord chunk : frame.dropped) {
    known_.erase(chunk);
    open_.erase(chunk);
  }
  const TickDelta& delta = tick.changes.delta;
  for (const PlacedStone& gone : delta.stones_gone)
    if (const auto known = known_.find(gone.chunk); known != known_.end()) known->second.erase(gone.stone.id);
  if (delta.stones.empty()) return;
  std::set<PieceId> seen;
  for (const uint32_t operation : frame.operations)
    seen.insert(tick.changes.ended[operation].begin(), tick.changes.ended[operation].end());
  for (const PlacedStone& placed : delta.stones)
    if (seen.contains(placed.stone.id))
      known_[placed.chunk].insert(placed.stone.id);
    else
      open_.insert(placed.chunk);
}

void StoneStream::open(const ServedTick& tick, std::span<const ChunkCoord> chunks) {
  if (!wanted_) return;
  for (const ChunkCoord chunk : chunks)
    if (tick.changes.state.stones().in(chunk) != nullptr) open_.insert(chunk);
}

/// Those that the client lacks and can place, nearest first. Closes chunks of which it has all.
std::vector<const PlacedStone*> StoneStream::next(const ServedTick& tick, const ClientView& view) {
  const PublishedStones& stones = tick.changes.state.stones();
  std::vector<std::pair<float, PieceId>> candidates;
  std::erase_if(open_, [&](ChunkCoord chunk) {
    const std::vector<PieceId>* const here = stones.in(chunk);
    if (here == nullptr) return true;
    const bool is_held = view.held().contains(chunk);
    bool lacks = false;
    for (const PieceId id : *here) {
      if (const auto known = known_.find(chunk); known != known_.end() && known->second.contains(id))
        continue;
      const PlacedStone& placed = stones.all().at(id);
      lacks = true;
      if (is_held && !waits_for_ground(placed, view, tick.changes.voxel_size_m))
        candidates.emplace_back(glm::distance(middle_of_stone(placed), view.eye_m()), id);
    }
    return !lacks;
  });
  retain_nearest(candidates, stone_batch);
  std::vector<const PlacedStone*> chosen;
  for (const auto& [distance, id] : candidates) chosen.push_back(&stones.all().at(id));
  return chosen;
}

void StoneStream::serve(const ServedTick& tick, const ClientView& view, Outlet& outlet, ServedPart& part) {
  const int64_t budget = limits::stone_bytes_per_tick * tick.rates.ticks_per_transform;
  credit_bytes_ = std::min(credit_bytes_ + budget, budget);
  if (open_.empty() || credit_bytes_ <= 0 || outlet.room_bytes() <= 0) return;
  for (const PlacedStone* placed : next(tick, view)) {
    if (credit_bytes_ <= 0 || outlet.room_bytes() <= 0) return;
    known_[placed->chunk].insert(placed->stone.id);
    const SharedBytes bytes = tick.cache.stone(placed->stone);
    if (bytes->size() > limits::message_bytes_max) continue;  // the client sees the terrain alone
    credit_bytes_ -= size_of(bytes);
    part.stats.stone_bytes += bytes->size();
    outlet.send(bytes, part);
  }
}

}  // namespace scree
