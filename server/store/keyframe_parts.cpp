#include "server/store/keyframe_parts.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "proto/limits.h"
#include "proto/operation_codec.h"

namespace scree {

Result<KeyframeParts> parts_of_state(std::span<const uint8_t> row, Tick tick, const SettingValues& header) {
  auto keyframe = TRY(decode_recorded_keyframe(row));
  if (keyframe.tick != tick || !keyframe.bricks.empty() || !keyframe.pieces.empty())
    return fail("it is another one's");
  if (keyframe.settings.empty()) keyframe.settings = header;
  return KeyframeParts{std::move(keyframe), {}};
}

Result<std::vector<BrickPatch>> bricks_of_row(std::span<const uint8_t> row, ChunkCoord chunk) {
  auto bricks = TRY(decode_bricks(row));
  for (const BrickPatch& patch : bricks)
    if (chunk_of(patch.coord) != chunk) return fail("a brick is in another chunk's row");
  return bricks;
}

Result<void> add_piece_rows(KeyframeParts& parts, const KnownParts& known, const PieceRow& row) {
  std::vector<PieceState> of_known;
  size_t voxels = 0;
  for (const PieceState& state : parts.keyframe.poses) {
    if (known.has_piece(state.id)) {
      of_known.push_back(state);
      continue;
    }
    const auto data = TRY(row(state.id));
    if (!data.has_value()) return fail(fmt::format("piece {} is missing", state.id));
    auto piece = TRY(decode_recorded_piece(*data));
    if (piece.id != state.id) return fail("a piece is in another one's row");
    piece.pose = state.pose;
    voxels += piece.volume.window.codes.size();
    if (voxels > limits::piece_voxels_max)
      return fail(
          fmt::format("pieces of more than {} voxels (limits.piece_voxels_max)", limits::piece_voxels_max));
    parts.keyframe.pieces.push_back(std::move(piece));
  }
  parts.keyframe.poses = std::move(of_known);
  return {};
}

void sort_parts(KeyframeParts& parts) {
  std::ranges::sort(parts.keyframe.bricks, {}, &BrickPatch::coord);
  std::ranges::sort(parts.known_chunks);
}

}  // namespace scree
