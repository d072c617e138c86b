// The edited chunks of one world that a client has kept, packed as on the wire: the bricks of each, and their
// hash. The total is bounded: what was used longest ago goes first. Not thread-safe.
//
// Invariant: a chunk that is handed out or offered has the hash that it is said to have; what came from a
// file and has not is forgotten when this is found out.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "proto/messages.h"
#include "shared/field/field.h"

namespace scree {

struct CachedChunk {
  ChunkCoord chunk;
  uint64_t hash = 0;
  std::shared_ptr<const std::vector<uint8_t>> bricks;  ///< encode_bricks()
};

class ChunkCache {
 public:
  explicit ChunkCache(size_t bytes_max) : bytes_max_(bytes_max) {}

  /// Keeps the chunk's edits as they are now. False when they were kept already, or there are none.
  bool store(Field& field, ChunkCoord chunk);
  /// Takes what a file has, the chunks used last at the end.
  void load(const std::vector<CachedChunk>& chunks);
  /// All of it, the chunks used last at the end.
  std::vector<CachedChunk> all() const;

  /// The chunk's edits; empty when none are kept.
  std::vector<BrickPatch> find(ChunkCoord chunk);
  /// The nearest chunks within the radius that are not among `held`; metres.
  OfferMessage offer(glm::vec3 eye_m, float radius_m, float voxel_size_m,
                     const std::unordered_set<ChunkCoord, CoordHash>& held = {});

  size_t bytes() const { return bytes_; }
  size_t chunks() const { return entries_.size(); }

 private:
  struct Entry {
    CachedChunk cached;
    bool proven = false;  ///< its bricks have its hash
    uint64_t used = 0;
  };
  void put(CachedChunk cached, bool proven);
  void drop(ChunkCoord chunk);
  void use(Entry& entry);
  bool prove(Entry& entry) const;

  size_t bytes_max_;
  size_t bytes_ = 0;
  uint64_t uses_ = 0;
  std::unordered_map<ChunkCoord, Entry, CoordHash> entries_;
  std::map<uint64_t, ChunkCoord> by_use_;
};

}  // namespace scree
