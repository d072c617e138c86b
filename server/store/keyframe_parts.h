// What a keyframe's rows (keyframe_rows.h) say together, wherever they come from. Every byte is checked. Pure
// functions.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "server/formats/recording_codec.h"
#include "shared/base/result.h"
#include "shared/field/coord.h"

namespace scree {

/// What somebody has already and need not be read.
struct KnownParts {
  std::function<bool(ChunkCoord chunk, uint64_t hash)> has_chunk = [](ChunkCoord, uint64_t) { return false; };
  std::function<bool(PieceId piece)> has_piece = [](PieceId) { return false; };
};

/// A keyframe without what is known: the bricks of the other chunks, and the other pieces. `poses` are those
/// of the pieces that are known.
struct KeyframeParts {
  RecordedKeyframe keyframe;
  std::vector<ChunkCoord> known_chunks;  ///< ordered
};

/// The keyframe's own row. It is of that tick, and has the settings `header` where it has none.
Result<KeyframeParts> parts_of_state(std::span<const uint8_t> row, Tick tick, const SettingValues& header);
/// The bricks of a chunk's row.
Result<std::vector<BrickPatch>> bricks_of_row(std::span<const uint8_t> row, ChunkCoord chunk);
/// Replaces the poses of pieces that are not known by the pieces. `row` gives a piece's row; nothing: it is
/// missing.
using PieceRow = std::function<Result<std::optional<std::vector<uint8_t>>>(PieceId piece)>;
Result<void> add_piece_rows(KeyframeParts& parts, const KnownParts& known, const PieceRow& row);
/// Puts bricks and chunks in order, once all are there.
void sort_parts(KeyframeParts& parts);

}  // namespace scree
