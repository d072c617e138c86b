// Elevation models in memory: every level has each second sample of the one before, and tiles can be
// withheld.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "shared/field/stored_chunks.h"

namespace scree {

class MemoryHeights final : public GroundModel {
 public:
  /// `height(column, row)`: in 1/256 m.
  MemoryHeights(int columns, int rows, float cell_m, const std::function<int32_t(int, int)>& height)
      : GroundModel(layout_for(columns, rows, cell_m, height)), height_(height) {}

  void withhold(TileKey key) { withheld_.insert(key); }
  void give(TileKey key) { withheld_.erase(key); }

  std::shared_ptr<const HeightTile> tile(TileKey key) const override {
    if (withheld_.contains(key)) return nullptr;
    const std::scoped_lock lock(mutex_);
    std::shared_ptr<const HeightTile>& slot = made_[key];
    if (slot != nullptr) return slot;
    auto tile = std::make_shared<HeightTile>();
    for (int z = 0; z < tile_samples; ++z)
      for (int x = 0; x < tile_samples; ++x)
        tile->heights[HeightTile::index(x, z)] =
            height_(std::min((key.x * tile_samples + x) << key.level, layout().columns - 1),
                    std::min((key.z * tile_samples + z) << key.level, layout().rows - 1));
    return slot = std::move(tile);
  }
  std::vector<uint8_t> packed(TileKey) const override { return {}; }

 private:
  static HeightLayout layout_for(int columns, int rows, float cell_m,
                                 const std::function<int32_t(int, int)>& height) {
    HeightLayout layout{columns, rows, cell_m, height(0, 0), height(0, 0), {5.0F, 60.0F}};
    for (int z = 0; z < rows; ++z)
      for (int x = 0; x < columns; ++x) {
        layout.lowest = std::min(layout.lowest, height(x, z));
        layout.highest = std::max(layout.highest, height(x, z));
      }
    return layout;
  }

  std::function<int32_t(int, int)> height_;
  mutable std::mutex mutex_;  ///< guards made_
  mutable std::map<TileKey, std::shared_ptr<const HeightTile>> made_;
  std::set<TileKey> withheld_;
};

/// Hills of some metres, with a cliff; integers alone.
inline int32_t rough_height(int x, int z) {
  const auto wave = [](int v, int period) {
    const int at = ((v % period) + period) % period;
    return at * (period - at);
  };
  return 3 * wave(x, 40) + 2 * wave(z, 56) + wave(x + 2 * z, 24) + (x > 30 ? 4000 : 0);
}

}  // namespace scree
