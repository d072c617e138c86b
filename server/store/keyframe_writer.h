// Writes keyframes, each as the rows of what changed since the one before (keyframe_rows.h): a world may be
// as large as it likes. One thread at a time.
#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>

#include "server/store/keyframe_rows.h"
#include "server/world/published_state.h"

namespace scree {

class KeyframeWriter {
 public:
  /// `header`: how the settings stood at the start of what the rows are of. `rows` must outlive it.
  KeyframeWriter(KeyframeRows& rows, SettingValues header) : rows_(&rows), header_(std::move(header)) {}

  /// The chunk's latest row is there, and has this hash: a recording is gone on with.
  void note_written(ChunkCoord chunk, uint64_t hash) { written_[chunk] = hash; }

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

 private:
  Result<void> put_chunk(const PublishedState& state, ChunkCoord chunk);
  Result<std::vector<BrickPatch>> read_whole(const PublishedChunk& published, ChunkCoord chunk) const;
  Result<void> put_piece(PieceId id, const PublishedPiece& piece);
  Result<void> bring_in(ChunkCoord chunk, PublishedState& state);
  void page_out(PublishedState& state) const;

  KeyframeRows* rows_;
  SettingValues header_;
  std::set<ChunkCoord> changed_;  ///< since the last keyframe
  ReadChunk read_;                ///< gives those of them of which the state has not all bricks
  std::unordered_map<ChunkCoord, uint64_t, CoordHash> written_;  ///< hashes of the latest rows
  std::set<PieceId> pieces_;  ///< alive at the last keyframe, their rows written
};

}  // namespace scree
