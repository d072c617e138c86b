#include "client/cache/received_tiles.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "client/cache/limits.h"
#include "crypto/sha256.h"
#include "proto/height_codec.h"
#include "proto/limits.h"
#include "proto/stored_codec.h"
#include "shared/base/check.h"

namespace scree {

ReceivedTiles::ReceivedTiles(const HeightGround& ground, TileFolder folder)
    : GroundModel(ground.layout, ground.bricks ? std::optional(ground.bricks->layout) : std::nullopt),
      ground_(ground),
      folder_(std::move(folder)) {
  digests_[layout().top()] = ground.top;
  if (ground.bricks) digests_[bricks()->root()] = ground.bricks->root;
}

size_t ReceivedTiles::Held::bytes() const {
  constexpr size_t own = 256;
  size_t codes = 0;
  if (chunk != nullptr)
    for (const Brick* brick : chunk->bricks)
      codes += uniform_equivalent(*brick) == nullptr ? brick_voxels : 0;
  return own + (tile != nullptr ? sizeof(HeightTile) : 0) + codes + packed.size();
}

std::shared_ptr<const HeightTile> ReceivedTiles::tile(TileKey key) const {
  const std::scoped_lock lock(mutex_);
  const auto found = held_.find(key);
  if (found != held_.end()) return found->second.tile;
  if (missed_.size() < limits::tiles_missed_max) missed_.insert(key);
  return nullptr;
}

std::vector<uint8_t> ReceivedTiles::packed(TileKey key) const {
  const std::scoped_lock lock(mutex_);
  const auto found = held_.find(key);
  return found == held_.end() ? std::vector<uint8_t>() : found->second.packed;
}

/// Under the lock. From the root down, as far as tiles are there.
ReceivedTiles::Found ReceivedTiles::find_chunk(TileKey key) const {
  std::vector<TileKey> path{key};
  while (path.back() != bricks()->root()) path.push_back(bricks()->parent(path.back()));
  Found found;
  for (auto at = path.rbegin(); at != path.rend(); ++at) {
    if (found.held != nullptr) {
      const auto places = bricks()->children(found.key);
      const auto place = static_cast<size_t>(std::ranges::find(places, *at) - places.begin());
      CHECK(place < places.size());
      if (((found.held->children >> place) & 1U) == 0) return {*at, nullptr, false};
    }
    const auto there = held_.find(*at);
    found = {*at, there == held_.end() ? nullptr : &there->second, true};
    if (found.held == nullptr) break;
  }
  return found;
}

ChunkLookup ReceivedTiles::chunk(TileKey key) const {
  const std::scoped_lock lock(mutex_);
  const Found found = find_chunk(key);
  if (!found.stored) return {};
  if (found.held != nullptr) return {true, found.held->chunk};
  if (missed_.size() < limits::tiles_missed_max) missed_.insert(key);
  return {false, nullptr};
}

bool ReceivedTiles::has(TileKey key) const {
  const std::scoped_lock lock(mutex_);
  return held_.contains(key);
}

void ReceivedTiles::begin_session() {
  asked_.clear();
  untold_.clear();
  const std::scoped_lock lock(mutex_);
  for (const auto& [key, held] : held_) untold_.push_back(key);
}

/// Names those below it.
Result<ReceivedTiles::Held> ReceivedTiles::unpacked(TileKey key, std::vector<uint8_t> bytes) {
  Held held;
  if (key.kind == TileKind::bricks) {
    auto unpacked = TRY(unpack_chunk(bytes, key, *bricks()));
    const std::array<TileKey, 8> places = bricks()->children(key);
    for (size_t i = 0; i < places.size(); ++i) {
      if (!unpacked.children[i]) continue;
      digests_[places[i]] = *unpacked.children[i];
      held.children = static_cast<uint8_t>(held.children | (1U << i));
    }
    held.chunk = std::make_shared<const GeneratedChunk>(std::move(unpacked.chunk));
  } else {
    auto unpacked = TRY(unpack_tile(bytes, key, layout()));
    const std::vector<TileKey> children = layout().children(key);
    for (size_t i = 0; i < children.size(); ++i) digests_[children[i]] = unpacked.children[i];
    held.tile = std::make_shared<const HeightTile>(unpacked.tile);
  }
  held.packed = std::move(bytes);
  return held;
}

Result<void> ReceivedTiles::put(TileKey key, std::vector<uint8_t> bytes) {
  auto held = TRY(unpacked(key, std::move(bytes)));
  const std::scoped_lock lock(mutex_);
  held_bytes_ += held.bytes();
  held_[key] = std::move(held);
  missed_.erase(key);
  return {};
}

TileKey ReceivedTiles::above(TileKey key) const {
  return key.kind == TileKind::bricks ? bricks()->parent(key) : parent_of(key);
}

Result<void> ReceivedTiles::accept(const TileMessage& message) {
  if (asked_.erase(message.key) == 0) return fail("a tile of the ground that was not asked for");
  const Digest& digest = digests_.at(message.key);
  if (sha256(message.bytes) != digest)
    return fail("a tile of the ground does not have the hash that names it");
  TRY(put(message.key, message.bytes));
  ++received_;
  folder_.write(digest, message.bytes);
  return {};
}

bool ReceivedTiles::read(TileKey key) {
  auto bytes = folder_.read(digests_.at(key));
  if (!bytes || !put(key, std::move(*bytes))) return false;
  untold_.push_back(key);
  return true;
}

std::vector<TileKey> ReceivedTiles::near(glm::vec3 eye_m, float radius_m) const {
  const auto span = [&](float middle_m, int samples) {
    const auto at = [&](float metres) {
      const float sample = metres / layout().cell_m + static_cast<float>(samples - 1) * 0.5F;
      return std::clamp(static_cast<int>(std::clamp(sample, -1.0e6F, 1.0e6F)), 0, samples - 1);
    };
    // The surface reads two samples on each side, and chunks a few voxels.
    const float margin_m = radius_m + limits::offer_margin_m + 3.0F * layout().cell_m;
    return std::pair(at(middle_m - margin_m) / tile_samples, at(middle_m + margin_m) / tile_samples);
  };
  const auto [x0, x1] = span(eye_m.x, layout().columns);
  const auto [z0, z1] = span(eye_m.z, layout().rows);
  std::vector<TileKey> keys;
  for (int z = z0; z <= z1; ++z)
    for (int x = x0; x <= x1; ++x) keys.push_back({0, x, z});
  add_near_chunks(eye_m, radius_m, keys);
  return keys;
}

/// Metres from a place to the nearest point of a stored chunk; 0 for the root.
float ReceivedTiles::reach_to_chunk_m(TileKey key, glm::vec3 eye_m) const {
  if (key == bricks()->root()) return 0.0F;
  const float side_m = bricks()->voxel_size_m * static_cast<float>(chunk_size << key.level);
  const glm::vec3 lo = glm::vec3(key.x, key.y, key.z) * side_m;
  return glm::length(eye_m - glm::clamp(eye_m, lo, lo + side_m));
}

/// All stored chunks of level 0 within the radius, or what is to come to know them.
void ReceivedTiles::add_near_chunks(glm::vec3 eye_m, float radius_m, std::vector<TileKey>& keys) const {
  if (!bricks()) return;
  const std::scoped_lock lock(mutex_);
  std::vector<TileKey> open{bricks()->root()};
  while (!open.empty()) {
    const TileKey key = open.back();
    open.pop_back();
    if (reach_to_chunk_m(key, eye_m) > radius_m + limits::offer_margin_m) continue;
    const auto held = held_.find(key);
    if (held == held_.end() || key.level == 0) {
      keys.push_back(key);
      continue;
    }
    const std::array<TileKey, 8> places = bricks()->children(key);
    for (size_t i = 0; i < places.size(); ++i)
      if (((held->second.children >> i) & 1U) != 0) open.push_back(places[i]);
  }
}

bool ReceivedTiles::has_near(glm::vec3 eye_m, float radius_m) const {
  return std::ranges::all_of(near(eye_m, radius_m), [this](TileKey key) { return has(key); });
}

/// For each wanted tile, the tile itself or the first above it whose name is known.
std::set<TileKey> ReceivedTiles::nameable(glm::vec3 eye_m, float radius_m) const {
  std::vector<TileKey> wanted = near(eye_m, radius_m);
  {
    const std::scoped_lock lock(mutex_);
    wanted.insert(wanted.end(), missed_.begin(), missed_.end());
  }
  std::set<TileKey> keys;
  for (TileKey key : wanted) {
    if (has(key)) continue;
    const TileKey missed = key;
    while (!digests_.contains(key)) key = above(key);
    if (!has(key)) {
      keys.insert(key);
    } else {  // which does not name it: there is none
      const std::scoped_lock lock(mutex_);
      missed_.erase(missed);
    }
  }
  return keys;
}

float ReceivedTiles::distance_m(TileKey key, glm::vec3 eye_m) const {
  if (key.kind == TileKind::bricks) return reach_to_chunk_m(key, eye_m);
  const float side_m = layout().cell_m * static_cast<float>(tile_samples << key.level);
  const float x_m = (static_cast<float>(key.x) + 0.5F) * side_m - layout().half_width_m() - eye_m.x;
  const float z_m = (static_cast<float>(key.z) + 0.5F) * side_m - layout().half_depth_m() - eye_m.z;
  return std::sqrt(x_m * x_m + z_m * z_m);
}

/// Those that can be asked for, coarse ones first, then the nearest.
std::vector<TileKey> ReceivedTiles::in_order(glm::vec3 eye_m, float radius_m) const {
  const std::set<TileKey> keys = nameable(eye_m, radius_m);
  std::vector<TileKey> order(keys.begin(), keys.end());
  std::ranges::stable_sort(order, [&](TileKey a, TileKey b) {
    if (a.level != b.level) return a.level > b.level;
    return distance_m(a, eye_m) < distance_m(b, eye_m);
  });
  return order;
}

bool ReceivedTiles::is_full() const {
  const std::scoped_lock lock(mutex_);
  return asked_.size() >= limits::tiles_asked_max || held_bytes_ >= limits::tile_memory_max;
}

AskTilesMessage ReceivedTiles::next_request(glm::vec3 eye_m, float radius_m) {
  AskTilesMessage request;
  size_t reads = 0;
  for (bool more = true; more;) {
    more = false;  // unless a tile that is read names others
    for (const TileKey key : in_order(eye_m, radius_m)) {
      if (reads >= limits::tiles_read_at_once || is_full()) break;
      if (asked_.contains(key)) continue;
      if (read(key)) {
        ++reads;
        more = true;
      } else {
        asked_.insert(key);
        request.wanted.push_back(key);
      }
    }
  }
  const auto told = std::min(untold_.size(), limits::tiles_held_max);
  request.held.assign(untold_.end() - static_cast<std::ptrdiff_t>(told), untold_.end());
  untold_.resize(untold_.size() - told);
  return request;
}

}  // namespace scree
