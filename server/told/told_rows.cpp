#include "server/told/told_rows.h"

#include <algorithm>
#include <utility>

#include "server/store/keyframe_parts.h"
#include "server/store/world_schema.h"

namespace scree {

Result<void> ToldRows::put_chunk(Tick, ChunkCoord chunk, uint64_t hash, std::span<const uint8_t> data) {
  chunks_[chunk] = {hash, {data.begin(), data.end()}};
  return {};
}

Result<void> ToldRows::put_piece(PieceId id, std::span<const uint8_t> data) {
  pieces_[id] = {data.begin(), data.end()};
  return {};
}

Result<void> ToldRows::put_state(Tick, std::span<const uint8_t> data) {
  state_ = {data.begin(), data.end()};
  return {};
}

Result<std::vector<uint8_t>> ToldRows::last_chunk(ChunkCoord chunk) {
  const auto found = chunks_.find(chunk);
  if (found == chunks_.end()) return fail(name_ + ": a chunk has no row");
  return found->second.data;
}

Result<ToldKeyframe> ToldRows::keyframe(std::span<const uint8_t> header, uint64_t world) {
  const RecordedKeyframe state = TRY(decode_recorded_keyframe(state_));
  ToldKeyframe told{world, {header.begin(), header.end()}, state_, {}, {}};
  for (const auto& [chunk, row] : chunks_)
    told.chunks.push_back({world_schema::chunk_key(chunk), row.hash, row.data});
  std::ranges::sort(told.chunks, {}, &ToldKeyframe::Chunk::key);
  std::map<PieceId, std::vector<uint8_t>> alive;
  for (const PieceState& piece : state.poses) {
    const auto row = pieces_.find(piece.id);
    if (row == pieces_.end()) return fail(name_ + ": a piece has no row");
    told.pieces.push_back(row->second);
    alive.insert(pieces_.extract(row));
  }
  pieces_ = std::move(alive);
  return told;
}

Result<RecordedHeader> header_of(const ToldKeyframe& keyframe) {
  return decode_recorded_header(keyframe.header);
}

Result<KeyframeParts> parts_of(const ToldKeyframe& keyframe, Tick tick, const SettingValues& header,
                               const KnownParts& known) {
  KeyframeParts parts = TRY(parts_of_state(keyframe.state, tick, header));
  if (parts.keyframe.poses.size() != keyframe.pieces.size())
    return fail("it has not as many pieces as it names");
  const ToldKeyframe::Chunk* before = nullptr;
  for (const ToldKeyframe::Chunk& row : keyframe.chunks) {
    if (before != nullptr && row.key <= before->key) return fail("its chunks are in no order");
    before = &row;
    const ChunkCoord chunk = world_schema::chunk_of_key(row.key);
    if (world_schema::chunk_key(chunk) != row.key) return fail("it has a chunk of no place");
    if (known.has_chunk(chunk, row.hash)) {
      parts.known_chunks.push_back(chunk);
      continue;
    }
    const auto bricks = TRY(bricks_of_row(row.data, chunk));
    parts.keyframe.bricks.insert(parts.keyframe.bricks.end(), bricks.begin(), bricks.end());
  }
  sort_parts(parts);
  std::map<PieceId, const std::vector<uint8_t>*> rows;
  for (size_t i = 0; i < keyframe.pieces.size(); ++i) rows[parts.keyframe.poses[i].id] = &keyframe.pieces[i];
  TRY(add_piece_rows(parts, known, [&](PieceId piece) -> Result<std::optional<std::vector<uint8_t>>> {
    return *rows.at(piece);
  }));
  return parts;
}

}  // namespace scree
