#include "server/store/keyframe_tables.h"

#include <fmt/format.h>
#include <optional>
#include <utility>

#include "server/formats/recording_codec.h"
#include "server/store/schema.h"
#include "server/store/world_schema.h"

namespace scree {

Result<KeyframeTables> KeyframeTables::create(Database& database) {
  KeyframeTables tables(database);
  const std::pair<Statement*, std::string> statements[] = {
      {&tables.insert_chunk_, schema::insert_chunk()},
      {&tables.put_piece_, schema::put_into("keyframe_pieces")},
      {&tables.put_state_, schema::put_into("keyframe_states")}};
  for (const auto& [statement, sql] : statements) {
    auto prepared = TRY(database.prepare(sql));
    *statement = std::move(prepared);
  }
  return tables;
}

Result<void> KeyframeTables::put_chunk(Tick tick, ChunkCoord chunk, uint64_t hash,
                                       std::span<const uint8_t> data) {
  const int64_t keys[] = {static_cast<int64_t>(tick), static_cast<int64_t>(world_schema::chunk_key(chunk)),
                          static_cast<int64_t>(hash)};
  return database_->put(insert_chunk_, keys, data);
}

Result<void> KeyframeTables::put_piece(PieceId id, std::span<const uint8_t> data) {
  return database_->put(put_piece_, id, data);
}

Result<void> KeyframeTables::put_state(Tick tick, std::span<const uint8_t> data) {
  return database_->put(put_state_, tick, data);
}

Result<std::vector<uint8_t>> KeyframeTables::last_chunk(ChunkCoord chunk) {
  const auto damaged = [this] { return fail(database_->path() + ": the last row of a chunk is damaged"); };
  std::optional<std::vector<uint8_t>> found;
  const auto take = [&](uint64_t, std::span<const uint8_t> data, bool whole) -> Result<void> {
    if (!whole) return damaged();
    found.emplace(data.begin(), data.end());
    return {};
  };
  TRY(database_->each(
      fmt::format("SELECT tick, data, checksum FROM keyframe_chunks WHERE chunk = {} ORDER BY "
                  "tick DESC, id DESC LIMIT 1",
                  world_schema::chunk_key(chunk)),
      take));
  if (!found) return damaged();
  return std::move(*found);
}

Result<void> KeyframeTables::each_chunk(const std::function<void(ChunkCoord, uint64_t)>& visit) {
  return database_->each_number("SELECT chunk, hash FROM keyframe_chunks ORDER BY tick, id",
                                [&](std::span<const int64_t> row) -> Result<void> {
                                  visit(world_schema::chunk_of_key(static_cast<uint64_t>(row[0])),
                                        static_cast<uint64_t>(row[1]));
                                  return {};
                                });
}

Result<void> KeyframeTables::drop_before(Tick tick, PieceId next_piece) {
  const std::string at = std::to_string(tick);
  std::string alive;
  const auto add_row = [&](uint64_t, std::span<const uint8_t> data, bool) -> Result<void> {
    const auto keyframe = TRY(decode_recorded_keyframe(data));
    for (const PieceState& piece : keyframe.poses) {
      if (!alive.empty()) alive += ',';
      alive += std::to_string(piece.id);
    }
    return {};
  };
  if (auto read =
          database_->each("SELECT tick, data, checksum FROM keyframe_states WHERE tick = " + at, add_row);
      !read)
    return read;
  return database_->execute(
      fmt::format("DELETE FROM keyframe_chunks WHERE tick < {} AND EXISTS (SELECT 1 FROM keyframe_chunks AS "
                  "later WHERE later.chunk = keyframe_chunks.chunk AND later.tick > keyframe_chunks.tick AND "
                  "later.tick <= {});DELETE FROM keyframe_pieces WHERE tick < {} AND tick NOT IN ({});DELETE "
                  "FROM keyframe_states WHERE tick < {}",
                  at, at, next_piece, alive, at));
}

}  // namespace scree
