#include "client/cache/chunk_cache.h"

#include <algorithm>

#include "client/cache/limits.h"
#include "proto/limits.h"
#include "proto/operation_codec.h"
#include "shared/base/check.h"
#include "shared/field/chunk_distance.h"

namespace scree {

namespace {

constexpr size_t bricks_per_chunk = size_t{chunk_bricks} * chunk_bricks * chunk_bricks;

size_t bytes_of(const CachedChunk& cached) {
  return cached.bricks->size() + limits::cache_entry_bytes;
}

/// Nothing when the bytes are not the bricks of this chunk with this hash.
std::vector<BrickPatch> unpacked(const CachedChunk& cached) {
  auto bricks = decode_bricks(*cached.bricks, bricks_per_chunk);
  if (!bricks) return {};
  uint64_t hash = 0;
  for (const BrickPatch& patch : *bricks) {
    if (chunk_of(patch.coord) != cached.chunk) return {};
    hash += brick_hash(patch.coord, patch.brick, patch.materials);
  }
  if (hash != cached.hash) return {};
  return std::move(*bricks);
}

}  // namespace

bool ChunkCache::store(Field& field, ChunkCoord chunk) {
  const uint64_t hash = field.chunk_hash(chunk);
  const auto found = entries_.find(chunk);
  if (found != entries_.end() && found->second.proven && found->second.cached.hash == hash) {
    use(found->second);
    return false;
  }
  const std::vector<BrickCoord> coords = field.edited_bricks(chunk);
  if (coords.empty()) return false;
  std::vector<BrickPatch> bricks;
  bricks.reserve(coords.size());
  for (const BrickCoord coord : coords) bricks.push_back({coord, field.brick(coord), field.materials(coord)});
  put({chunk, hash, std::make_shared<const std::vector<uint8_t>>(encode_bricks(bricks))}, true);
  return true;
}

void ChunkCache::load(const std::vector<CachedChunk>& chunks) {
  for (const CachedChunk& cached : chunks) put(cached, false);
}

std::vector<CachedChunk> ChunkCache::all() const {
  std::vector<CachedChunk> all;
  all.reserve(by_use_.size());
  for (const auto& [used, chunk] : by_use_) all.push_back(entries_.at(chunk).cached);
  return all;
}

std::vector<BrickPatch> ChunkCache::find(ChunkCoord chunk) {
  const auto found = entries_.find(chunk);
  if (found == entries_.end()) return {};
  std::vector<BrickPatch> bricks = unpacked(found->second.cached);
  if (bricks.empty())
    drop(chunk);
  else
    use(found->second);
  return bricks;
}

OfferMessage ChunkCache::offer(glm::vec3 eye_m, float radius_m, float voxel_size_m,
                               const std::unordered_set<ChunkCoord, CoordHash>& held) {
  std::vector<std::pair<float, ChunkCoord>> near;
  for (const auto& [chunk, entry] : entries_) {
    const float distance_m = distance_to_chunk_m(eye_m, chunk, voxel_size_m);
    if (distance_m <= radius_m && !held.contains(chunk)) near.emplace_back(distance_m, chunk);
  }
  std::ranges::sort(near);
  OfferMessage offer;
  for (const auto& [distance_m, chunk] : near) {
    if (offer.chunks.size() == limits::offer_chunks_max) break;
    if (prove(entries_.at(chunk)))
      offer.chunks.push_back(chunk);
    else
      drop(chunk);
  }
  std::ranges::sort(offer.chunks);
  for (const ChunkCoord chunk : offer.chunks)
    offer.hashes.push_back(short_hash(entries_.at(chunk).cached.hash));
  return offer;
}

void ChunkCache::put(CachedChunk cached, bool proven) {
  drop(cached.chunk);
  const ChunkCoord chunk = cached.chunk;
  bytes_ += bytes_of(cached);
  const auto [entry, fresh] = entries_.emplace(chunk, Entry{std::move(cached), proven});
  CHECK(fresh);
  use(entry->second);
  while (bytes_ > bytes_max_) drop(by_use_.begin()->second);
  CHECK_DEBUG(by_use_.size() == entries_.size());
}

void ChunkCache::drop(ChunkCoord chunk) {
  const auto found = entries_.find(chunk);
  if (found == entries_.end()) return;
  bytes_ -= bytes_of(found->second.cached);
  by_use_.erase(found->second.used);
  entries_.erase(found);
}

void ChunkCache::use(Entry& entry) {
  by_use_.erase(entry.used);
  entry.used = ++uses_;
  by_use_.emplace(entry.used, entry.cached.chunk);
}

bool ChunkCache::prove(Entry& entry) const {
  if (!entry.proven) entry.proven = !unpacked(entry.cached).empty();
  return entry.proven;
}

}  // namespace scree
