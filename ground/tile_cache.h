// Decoded tiles that a file keeps in memory, the ones used last. Not thread-safe.
#pragma once

#include <list>
#include <map>
#include <memory>

#include "shared/field/heights.h"

namespace scree {

template <typename Tile>
class TileCache {
 public:
  explicit TileCache(size_t tiles_max) : tiles_max_(tiles_max) {}

  /// Null when it is not kept.
  std::shared_ptr<const Tile> find(TileKey key) {
    const auto found = tiles_.find(key);
    if (found == tiles_.end()) return nullptr;
    uses_.splice(uses_.begin(), uses_, found->second.use);
    return found->second.tile;
  }
  /// One that is not kept yet; in place of the one used longest ago, when there are too many.
  std::shared_ptr<const Tile> insert(TileKey key, Tile&& tile) {
    if (tiles_.size() >= tiles_max_) {
      tiles_.erase(uses_.back());
      uses_.pop_back();
    }
    uses_.push_front(key);
    auto shared = std::make_shared<const Tile>(std::move(tile));
    tiles_.emplace(key, Cached{shared, uses_.begin()});
    return shared;
  }

 private:
  struct Cached {
    std::shared_ptr<const Tile> tile;
    std::list<TileKey>::iterator use;
  };

  size_t tiles_max_;
  std::map<TileKey, Cached> tiles_;
  std::list<TileKey> uses_;  ///< of tiles_, the last one in front
};

}  // namespace scree
