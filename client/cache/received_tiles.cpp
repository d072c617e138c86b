#include "client/cache/received_tiles.h"

#include <algorithm>
#include <cmath>

#include "client/cache/limits.h"
#include "crypto/sha256.h"
#include "proto/height_codec.h"
#include "proto/limits.h"
#include "shared/base/check.h"

namespace scree {

ReceivedTiles::ReceivedTiles(const HeightGround& ground, TileFolder folder)
    : HeightModel(ground.layout), ground_(ground), folder_(std::move(folder)) {
  digests_[layout().top()] = ground.top;
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

Result<void> ReceivedTiles::put(TileKey key, std::vector<uint8_t> bytes) {
  auto unpacked = unpack_tile(bytes, key, layout());
  if (!unpacked) return tl::unexpected(unpacked.error());
  const std::vector<TileKey> children = layout().children(key);
  for (size_t i = 0; i < children.size(); ++i) digests_[children[i]] = unpacked->children[i];
  auto tile = std::make_shared<const HeightTile>(unpacked->tile);
  const std::scoped_lock lock(mutex_);
  held_[key] = {std::move(tile), std::move(bytes)};
  missed_.erase(key);
  return {};
}

Result<void> ReceivedTiles::take(const TileMessage& message) {
  if (asked_.erase(message.key) == 0) return fail("a tile of the ground that was not asked for");
  const Digest& digest = digests_.at(message.key);
  if (sha256(message.bytes) != digest)
    return fail("a tile of the ground does not have the hash that names it");
  if (Result<void> done = put(message.key, message.bytes); !done) return done;
  ++received_;
  folder_.write(digest, message.bytes);
  return {};
}

bool ReceivedTiles::read(TileKey key) {
  auto bytes = folder_.read(digests_.at(key));
  if (!bytes || !put(key, std::move(*bytes))) return false;
  ++read_;
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
  return keys;
}

bool ReceivedTiles::has_near(glm::vec3 eye_m, float radius_m) const {
  return std::ranges::all_of(near(eye_m, radius_m), [this](TileKey key) { return has(key); });
}

/// Of each tile that is wanted the tile itself, or the first above it whose name is known.
std::set<TileKey> ReceivedTiles::nameable(glm::vec3 eye_m, float radius_m) const {
  std::vector<TileKey> wanted = near(eye_m, radius_m);
  {
    const std::scoped_lock lock(mutex_);
    wanted.insert(wanted.end(), missed_.begin(), missed_.end());
  }
  std::set<TileKey> keys;
  for (TileKey key : wanted) {
    if (has(key)) continue;
    while (!digests_.contains(key)) key = parent_of(key);
    keys.insert(key);
  }
  return keys;
}

float ReceivedTiles::distance_m(TileKey key, glm::vec3 eye_m) const {
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
  return asked_.size() >= limits::tiles_asked_max || held_.size() + asked_.size() >= limits::tiles_held_max;
}

TileRequest ReceivedTiles::next_request(glm::vec3 eye_m, float radius_m) {
  TileRequest request;
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
  request.held = std::exchange(untold_, {});
  return request;
}

}  // namespace scree
