// The published terrain as a field, for questions. It has no bricks of its own: those that are edited are
// read from the state, and a chunk that is out of memory there ends the read (ChunkUnreadable) and is noted
// as missing. It generates unedited ground and keeps it. One thread.
#pragma once

#include <unordered_set>
#include <vector>

#include "server/world/published_state.h"
#include "shared/field/field.h"

namespace scree {

class PublishedField final : public Field {
 public:
  /// The state outlives it. All chunks are to be followed at first.
  PublishedField(const TerrainSource& source, const PublishedState& state);

  /// The chunk of the state has changed.
  void note(ChunkCoord chunk) { behind_.insert(chunk); }
  /// Takes up what has changed, of so many chunks at most. False: there is more, and nothing may be read.
  [[nodiscard]] bool follow(size_t chunks_max);
  /// Chunks that somebody came to since the last call, and whose bricks, or what they say, were out of
  /// memory. They are to be followed again.
  std::vector<ChunkCoord> take_missing();

 protected:
  const Brick* find_edited(BrickCoord coord) const override;
  void store_edited(BrickCoord coord, const Brick& brick) override;
  void erase_edited(BrickCoord coord) override;

 private:
  using Chunks = std::unordered_set<ChunkCoord, CoordHash>;
  void take_up(ChunkCoord chunk);

  const PublishedState& state_;
  Chunks behind_;
  Chunks partial_;          ///< whose materials are not all known, because bricks were out
  mutable Chunks missing_;  ///< since the last take_missing()
};

}  // namespace scree
