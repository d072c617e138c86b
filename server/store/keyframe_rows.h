// Where the rows of a KeyframeWriter go: the tables of a recording (keyframe_tables.h), or memory, from which
// a bus tells them (server/told). One thread at a time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shared/base/ids.h"
#include "shared/base/result.h"
#include "shared/field/coord.h"

namespace scree {

class KeyframeRows {
 public:
  virtual ~KeyframeRows() = default;

  /// For messages.
  virtual const std::string& name() const = 0;
  /// A chunk's edited bricks as of a tick, and their hash. It replaces an earlier row for later keyframes.
  virtual Result<void> put_chunk(Tick tick, ChunkCoord chunk, uint64_t hash,
                                 std::span<const uint8_t> data) = 0;
  virtual Result<void> put_piece(PieceId id, std::span<const uint8_t> data) = 0;
  /// The keyframe itself: all its other rows are put.
  virtual Result<void> put_state(Tick tick, std::span<const uint8_t> data) = 0;
  /// The chunk's latest row, which is there.
  virtual Result<std::vector<uint8_t>> last_chunk(ChunkCoord chunk) = 0;
};

}  // namespace scree
