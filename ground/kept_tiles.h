// Decoded tiles that a file keeps in memory, the ones used last. Not thread-safe.
#pragma once

#include <list>
#include <map>
#include <memory>

#include "shared/field/heights.h"

namespace scree {

template <typename Tile>
class KeptTiles {
 public:
  explicit KeptTiles(size_t tiles_max) : tiles_max_(tiles_max) {}

  /// Null when it is not kept.
  std::shared_ptr<const Tile> find(TileKey key) {
    const auto found = kept_.find(key);
    if (found == kept_.end()) return nullptr;
    uses_.splice(uses_.begin(), uses_, found->second.use);
    return found->second.tile;
  }
  /// One that is not kept yet; in place of the one used longest ago, when there are too many.
  std::shared_ptr<const Tile> keep(TileKey key, Tile&& tile) {
    if (kept_.size() >= tiles_max_) {
      kept_.erase(uses_.back());
      uses_.pop_back();
    }
    uses_.push_front(key);
    auto shared = std::make_shared<const Tile>(std::move(tile));
    kept_.emplace(key, Kept{shared, uses_.begin()});
    return shared;
  }

 private:
  struct Kept {
    std::shared_ptr<const Tile> tile;
    std::list<TileKey>::iterator use;
  };

  size_t tiles_max_;
  std::map<TileKey, Kept> kept_;
  std::list<TileKey> uses_;  ///< of kept_, the last one in front
};

}  // namespace scree
