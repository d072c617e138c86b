// Writes a recording's keyframes, each as the rows of what changed since the one before (schema.h): a world
// may be as large as it likes. Owned by a RecordingWriter; one thread at a time.
#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>

#include "server/store/database.h"
#include "server/world/published_state.h"

namespace scree {

class KeyframeWriter {
 public:
  /// `header`: how the settings stand at the recording's start. `database` must outlive it.
  static Result<KeyframeWriter> create(Database& database, SettingValues header);

  /// Takes the rows that are there for written: a recording is gone on with.
  Result<void> resume();

  /// Puts the next tick into the state. Bricks that it lacks are read from the rows first; more than
  /// limits::recorded_bricks_max are dropped.
  Result<void> apply(const TickDelta& delta, PublishedState& state);
  /// The same with a whole state. `read` gives the bricks of chunks that come without, once, to the next
  /// put(): the state does not keep them.
  void begin(const TickDelta& keyframe, PublishedState& state, ReadChunk read = {});

  /// The state's keyframe.
  Result<void> put(const PublishedState& state);
  /// Whether a keyframe is due after the state's tick: not while the last one still holds.
  bool is_due(const PublishedState& state) const;

  /// Drops what keyframes from that tick on do not need. There is a keyframe of the tick, when the next piece
  /// to be made was `next_piece`.
  Result<void> drop_before(Tick tick, PieceId next_piece);

 private:
  explicit KeyframeWriter(Database& database) : database_(&database) {}
  Result<void> put_chunk(const PublishedState& state, ChunkCoord chunk);
  Result<std::vector<BrickPatch>> read_whole(const PublishedChunk& published, ChunkCoord chunk) const;
  Result<void> put_piece(PieceId id, const PublishedPiece& piece);
  Result<void> bring_in(ChunkCoord chunk, PublishedState& state);
  void page_out(PublishedState& state) const;

  Database* database_;
  Statement insert_chunk_, put_piece_, put_state_;
  SettingValues header_;
  std::set<ChunkCoord> changed_;  ///< since the last keyframe
  ReadChunk read_;                ///< gives those of them of which the state has not all bricks
  std::unordered_map<ChunkCoord, uint64_t, CoordHash> written_;  ///< hashes of the latest rows
  std::set<PieceId> pieces_;  ///< alive at the last keyframe, their rows written
};

}  // namespace scree
