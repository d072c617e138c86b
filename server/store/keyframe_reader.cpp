#include "server/store/keyframe_reader.h"

#include <algorithm>
#include <fmt/format.h>

#include "server/store/schema.h"
#include "server/store/world_schema.h"

namespace scree {

tl::unexpected<Error> KeyframeReader::damaged(const std::string& what, Tick tick) const {
  return fail(fmt::format("{}: damaged: the keyframe of tick {}: {}", database_->path(), tick, what));
}

Result<KeyframeReader> KeyframeReader::open(Database& database, SettingValues header) {
  KeyframeReader reader(database);
  reader.header_ = std::move(header);
  const std::pair<Statement*, std::string> statements[] = {
      {&reader.select_chunk_, schema::select_chunk()},
      {&reader.select_piece_, schema::select_from("keyframe_pieces")},
      {&reader.select_state_, schema::select_from("keyframe_states")}};
  for (const auto& [statement, sql] : statements) {
    auto prepared = TRY(database.prepare(sql));
    *statement = std::move(prepared);
  }
  return reader;
}

Result<uint64_t> KeyframeReader::count() {
  const auto count = database_->number("SELECT count(*) FROM keyframe_states");
  TRY(count);
  return static_cast<uint64_t>(count->value_or(0));
}

Result<std::optional<Tick>> KeyframeReader::tick_before(Tick tick) {
  const auto latest =
      database_->number(fmt::format("SELECT max(tick) FROM keyframe_states WHERE tick <= {}", tick));
  TRY(latest);
  return latest->has_value() ? std::optional(static_cast<Tick>(**latest)) : std::nullopt;
}

/// Rows come in the order of their ids, and of a chunk in that of their ticks.
Result<void> KeyframeReader::index() {
  const auto add_row = [this](std::span<const int64_t> row) -> Result<void> {
    chunks_[static_cast<uint64_t>(row[1])].push_back(
        {static_cast<Tick>(row[2]), row[0], static_cast<uint64_t>(row[3])});
    indexed_ = std::max(indexed_, row[0]);
    return {};
  };
  const auto latest = TRY(database_->number("SELECT max(id) FROM keyframe_chunks"));
  if (latest.value_or(0) <= indexed_) return {};
  // Without the blobs: from the index alone, unless few rows are new.
  const std::string since = indexed_ == 0 ? "" : fmt::format(" NOT INDEXED WHERE id > {}", indexed_);
  if (auto read =
          database_->each_number("SELECT id, chunk, tick, hash FROM keyframe_chunks" + since, add_row);
      !read)
    return read;
  for (auto& [key, rows] : chunks_)
    std::ranges::sort(rows, {}, [](const Row& row) { return std::pair(row.tick, row.id); });
  return {};
}

void KeyframeReader::forget_before(Tick tick) {
  for (auto& [key, rows] : chunks_) {
    const auto after = std::ranges::upper_bound(rows, tick, {}, &Row::tick);
    if (after - rows.begin() > 1) rows.erase(rows.begin(), std::prev(after));
  }
}

const KeyframeReader::Row* KeyframeReader::latest(const std::vector<Row>& rows, Tick tick) {
  const auto after = std::ranges::upper_bound(rows, tick, {}, &Row::tick);
  return after == rows.begin() ? nullptr : &*std::prev(after);
}

Result<std::vector<BrickPatch>> KeyframeReader::read_chunk(const Row& row, ChunkCoord chunk) {
  const auto data = TRY(database_->get(select_chunk_, static_cast<uint64_t>(row.id)));
  if (!data.has_value()) return damaged("a chunk's row was dropped", row.tick);
  auto bricks = bricks_of_row(*data, chunk);
  if (!bricks) return damaged(bricks.error().message, row.tick);
  return bricks;
}

Result<void> KeyframeReader::each_chunk(Tick tick, const ChunkVisitor& visit) {
  TRY(index());
  for (const auto& [key, rows] : chunks_) {
    const Row* const row = latest(rows, tick);
    if (row == nullptr) continue;
    const ChunkCoord chunk = world_schema::chunk_of_key(key);
    const auto bricks = TRY(read_chunk(*row, chunk));
    TRY(visit(chunk, bricks));
  }
  return {};
}

Result<bool> KeyframeReader::has_chunk(ChunkCoord chunk, uint64_t hash, Tick tick) {
  TRY(index());
  const auto rows = chunks_.find(world_schema::chunk_key(chunk));
  const Row* const row = rows == chunks_.end() ? nullptr : latest(rows->second, tick);
  return row != nullptr && row->hash == hash;
}

Result<std::vector<BrickPatch>> KeyframeReader::chunk(ChunkCoord chunk, uint64_t hash) {
  const auto rows = chunks_.find(world_schema::chunk_key(chunk));
  if (rows != chunks_.end())
    for (const Row& row : rows->second)
      if (row.hash == hash) return read_chunk(row, chunk);
  return fail(database_->path() + " does not have a chunk any more");
}

Result<void> KeyframeReader::read_chunks(KeyframeParts& parts, Tick tick, const KnownParts& known) {
  TRY(index());
  for (const auto& [key, rows] : chunks_) {
    const Row* const row = latest(rows, tick);
    if (row == nullptr) continue;
    const ChunkCoord chunk = world_schema::chunk_of_key(key);
    if (known.has_chunk(chunk, row->hash)) {
      parts.known_chunks.push_back(chunk);
      continue;
    }
    const auto bricks = TRY(read_chunk(*row, chunk));
    parts.keyframe.bricks.insert(parts.keyframe.bricks.end(), bricks.begin(), bricks.end());
  }
  sort_parts(parts);
  return {};
}

Result<void> KeyframeReader::read_pieces(KeyframeParts& parts, const KnownParts& known) {
  std::optional<Error> unread;
  const Tick tick = parts.keyframe.tick;
  const auto added = add_piece_rows(parts, known, [&](PieceId piece) {
    auto row = database_->get(select_piece_, piece);
    if (!row) unread = row.error();
    return row;
  });
  if (unread) return tl::unexpected(*unread);
  if (!added) return damaged(added.error().message, tick);
  return {};
}

Result<KeyframeParts> KeyframeReader::read(Tick tick, const KnownParts& known) {
  const auto data = TRY(database_->get(select_state_, tick));
  if (!data.has_value()) return damaged("it is not there", tick);
  auto parts = parts_of_state(*data, tick, header_);
  if (!parts) return damaged(parts.error().message, tick);
  TRY(read_chunks(*parts, tick, known));
  TRY(read_pieces(*parts, known));
  return parts;
}

}  // namespace scree
