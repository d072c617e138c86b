// A server's ground, whose tiles, of its elevation model and of stored chunks, come over the wire, or from
// the cache, when somebody has missed them: coarse ones first, because each names the ones below it, then the
// nearest.
//
// Invariant: every tile has the hash by which the tile above, or the welcome, names it. A tile stays once it
// has come. Any thread may call what HeightModel has, one thread the rest.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <mutex>
#include <set>

#include "client/cache/tile_folder.h"
#include "proto/messages.h"

namespace scree {

class ReceivedTiles final : public GroundModel {
 public:
  ReceivedTiles(const HeightGround& ground, TileFolder folder);

  const HeightGround& ground() const { return ground_; }
  std::shared_ptr<const HeightTile> tile(TileKey key) const override;
  std::vector<uint8_t> packed(TileKey key) const override;
  ChunkLookup chunk(TileKey key) const override;
  bool has(TileKey key) const override;

  /// Says what a new session may count on: all that has come so far is to be told, what was asked for is to
  /// be asked for again.
  void begin_session();
  /// Takes a tile that was asked for. The error says what is wrong with it.
  Result<void> accept(const TileMessage& message);
  /// The next request to send; reads the cache. Empty when all is asked for. Tiles around the eye, as far as
  /// the radius, are wanted whether somebody missed them or not. Metres.
  AskTilesMessage next_request(glm::vec3 eye_m, float radius_m);
  /// Whether all tiles around the eye are there.
  bool has_near(glm::vec3 eye_m, float radius_m) const;

  uint64_t tiles_received() const { return received_; }

 private:
  struct Held {
    std::shared_ptr<const HeightTile> tile;  ///< of heights
    std::shared_ptr<const GeneratedChunk> chunk;
    uint8_t children = 0;  ///< of a stored chunk: bit i: child i is stored
    std::vector<uint8_t> packed;
    size_t bytes() const;
  };
  /// The end of the walk from the root to a stored chunk: the last key whose tile is there or wanted.
  struct Found {
    TileKey key;
    const Held* held = nullptr;  ///< null: it is not there
    bool stored = true;          ///< false: the one above says that there is none
  };
  std::vector<TileKey> near(glm::vec3 eye_m, float radius_m) const;
  void add_near_chunks(glm::vec3 eye_m, float radius_m, std::vector<TileKey>& keys) const;
  float reach_to_chunk_m(TileKey key, glm::vec3 eye_m) const;
  Found find_chunk(TileKey key) const;
  Result<Held> unpacked(TileKey key, std::vector<uint8_t> bytes);
  TileKey above(TileKey key) const;
  std::set<TileKey> nameable(glm::vec3 eye_m, float radius_m) const;
  std::vector<TileKey> in_order(glm::vec3 eye_m, float radius_m) const;
  bool is_full() const;
  float distance_m(TileKey key, glm::vec3 eye_m) const;
  Result<void> put(TileKey key, std::vector<uint8_t> bytes);
  bool read(TileKey key);

  const HeightGround ground_;
  const TileFolder folder_;
  std::map<TileKey, Digest> digests_;  ///< of all tiles that are named
  std::set<TileKey> asked_;            ///< and not come yet
  std::vector<TileKey> untold_;        ///< held, and the server does not know
  uint64_t received_ = 0;
  mutable std::mutex mutex_;  ///< guards the members below
  std::map<TileKey, Held> held_;
  size_t held_bytes_ = 0;
  mutable std::set<TileKey> missed_;
};

}  // namespace scree
