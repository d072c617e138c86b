// The world as published so far, rebuilt from TickDeltas. The publisher serves late joiners from it, the
// recorder writes keyframes from it; neither reads the simulation. Buffers are shared and immutable. Not
// thread-safe.
//
// A chunk's bricks may be out of memory (page_out): then its version, its hash, and which bricks are edited
// are known, and of its bricks those that changed since.
//
// Invariants: ticks have no gap. A chunk's version is the last tick that changed it, and its hash is the sum
// of its bricks' hashes, of which it has one at least; the field's hash is the sum over chunks. Every piece
// alive has its volume.
#pragma once

#include <array>
#include <bit>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "server/world/published_stones.h"
#include "server/world/tick_delta.h"

namespace scree {

/// Hashes of a chunk at its latest versions, the newest last; versions ascend.
struct ChunkHistory {
  static constexpr size_t depth = 32;
  struct Entry {
    Tick version = 0;
    uint64_t hash = 0;
  };
  std::vector<Entry> entries;
};

struct PublishedChunk {
  Tick version = 0;     ///< the tick that changed it last
  uint64_t hash = 0;    ///< Σ brick_hash of the edited bricks
  uint64_t edited = 0;  ///< bit i for brick i (index_in_chunk)
  std::map<BrickCoord, BrickState> bricks;
  ChunkHistory history;
  Tick used = 0;  ///< as of PublishedState::use()

  /// Whether all of its edited bricks are in memory.
  bool is_whole() const { return bricks.size() == static_cast<size_t>(std::popcount(edited)); }
};

struct PublishedPiece {
  std::shared_ptr<const Volume> volume;
  QuantisedPose pose;
};

struct PublishedProp {
  std::shared_ptr<const Prop> prop;
  QuantisedPose pose;
};

using PublishedStores = std::map<StoreName, MaterialMasses>;
using PublishedJoints = std::map<JointId, std::shared_ptr<const Joint>>;

class PublishedState {
 public:
  /// Applies the next tick. The first may have any number, as a keyframe; then there is no gap.
  void apply(const TickDelta& delta);

  /// Drops the bricks of a chunk.
  void page_out(ChunkCoord chunk);
  /// Puts back what was read of a chunk, but for bricks that changed since. False, and the chunk is as it
  /// was, when they are not its bricks.
  [[nodiscard]] bool page_in(ChunkCoord chunk, std::span<const BrickPatch> bricks);
  /// Notes that somebody needs the chunk's bricks.
  void use(ChunkCoord chunk) { chunks_.at(chunk).used = tick_; }
  /// Chunks with bricks in memory, and the number of these bricks.
  const std::unordered_set<ChunkCoord, CoordHash>& chunks_in() const { return in_; }
  size_t bricks_in() const { return bricks_in_; }

  /// A keyframe: one delta that takes an empty state to this one, with every edited brick, every piece, and
  /// no operations. All chunks are whole.
  TickDelta as_delta() const;
  /// The same with these bricks alone, which are edited.
  TickDelta as_delta(const std::set<BrickCoord>& bricks) const;

  Tick tick() const { return tick_; }
  const std::unordered_map<ChunkCoord, PublishedChunk, CoordHash>& chunks() const { return chunks_; }
  const std::map<PieceId, PublishedPiece>& pieces() const { return pieces_; }
  const PublishedStones& stones() const { return stones_; }
  /// Those that are kept, ordered; none in a replay.
  const std::vector<PieceId>& kept() const { return kept_; }
  const std::map<PieceId, PublishedProp>& props() const { return props_; }
  /// Persons on foot, ordered by session; none in a replay.
  const std::vector<PersonPlace>& persons() const { return persons_; }
  /// Null where the session has no person on foot.
  const PersonPlace* person_of(uint64_t session) const;
  /// Another number whenever other persons, or other bodies, are on foot.
  uint64_t persons_version() const { return persons_version_; }
  const PublishedJoints& joints() const { return joints_; }
  /// All regions, ordered by id; never null. It is another list when one changed.
  const std::shared_ptr<const std::vector<Region>>& regions() const { return regions_; }
  /// All signs, in order; never null. It is another list when one changed.
  const std::shared_ptr<const std::vector<Sign>>& signs() const { return signs_; }
  /// What rules made of persons, by session; never null. Likewise.
  const std::shared_ptr<const std::vector<Player>>& players() const { return players_; }
  /// Those that hold something, by owner.
  const PublishedStores& stores() const { return stores_; }
  /// Null: nothing was broken out of a region that counts.
  const std::shared_ptr<const std::vector<RegionMass>>& region_masses() const { return region_masses_; }
  const Ledger& ledger() const { return ledger_; }
  const MaterialLedger& materials() const { return materials_; }
  const SettingValues& settings() const { return settings_; }
  /// Where visitors begin; nothing where no delta said it.
  const std::optional<Spawn>& spawn() const { return spawn_; }
  uint64_t field_hash() const { return field_hash_; }
  uint64_t state_hash() const { return state_hash_; }
  uint64_t pieces_made() const { return pieces_made_; }
  uint64_t pieces_merged() const { return pieces_merged_; }

  /// The chunk's hash at that version; nothing when the version is older than its history or never existed.
  std::optional<uint64_t> hash_at(ChunkCoord chunk, Tick version) const;

 private:
  /// Everything but bricks.
  TickDelta without_bricks() const;
  /// The brick is no longer edited.
  void revert(BrickCoord coord);
  /// Σ chunk hash, which is the field's; for CHECK_DEBUG.
  uint64_t sum_of_chunks() const;

  void apply_terrain(const TickDelta& delta);
  void apply_props(const TickDelta& delta);
  void apply_persons(const TickDelta& delta);

  Tick tick_ = 0;
  std::unordered_map<ChunkCoord, PublishedChunk, CoordHash> chunks_;
  std::unordered_set<ChunkCoord, CoordHash> in_;
  size_t bricks_in_ = 0;
  std::map<PieceId, PublishedPiece> pieces_;
  PublishedStones stones_;
  std::vector<PieceId> kept_;
  std::map<PieceId, PublishedProp> props_;
  PublishedJoints joints_;
  std::shared_ptr<const std::vector<Region>> regions_ = std::make_shared<const std::vector<Region>>();
  std::vector<PersonPlace> persons_;
  uint64_t persons_version_ = 0;
  PublishedStores stores_;
  std::shared_ptr<const std::vector<Player>> players_ = std::make_shared<const std::vector<Player>>();
  std::shared_ptr<const std::vector<Sign>> signs_ = std::make_shared<const std::vector<Sign>>();
  std::shared_ptr<const std::vector<RegionMass>> region_masses_;
  Ledger ledger_;
  MaterialLedger materials_;
  SettingValues settings_;
  std::optional<Spawn> spawn_;
  uint64_t field_hash_ = 0;
  uint64_t state_hash_ = 0;
  uint64_t pieces_made_ = 0;
  uint64_t pieces_merged_ = 0;
};

}  // namespace scree
