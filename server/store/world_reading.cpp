#include "server/store/world_reading.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/limits.h"
#include "server/formats/world_stones.h"
#include "server/store/readable_rows.h"
#include "server/store/world_schema.h"
#include "server/world/limits.h"

namespace scree {

namespace {

template <typename T>
Result<void> put_into(T& to, Result<T> decoded) {
  TRY(decoded);
  to = std::move(*decoded);
  return {};
}

}  // namespace

Result<WorldChunk> chunk_of_row(uint64_t key, std::span<const uint8_t> data) {
  auto decoded = decode_world_chunk(data);
  if (decoded && world_schema::chunk_key(decoded->chunk) != key) return fail("it is another chunk's");
  return decoded;
}

Result<WorldRows> WorldReading::run(bool with_chunks) {
  if (auto done =
          one("header", [&](auto, auto data) { return put_into(rows_.header, decode_world_header(data)); });
      !done)
    return tl::unexpected(done.error());
  WorldMoment& moment = rows_.world.moment;
  if (auto done = one("moment", [&](auto, auto data) { return put_into(moment, decode_world_moment(data)); });
      !done) {
    if (lost_ == nullptr) return tl::unexpected(done.error());
    lost_->reasons.push_back(done.error().message);
    moment = WorldMoment();
    moment.config = rows_.header.config;
    has_moment_ = false;
  }
  if (auto done = every("pieces", [&](uint64_t key, auto data) { return piece(key, data); }); !done)
    return tl::unexpected(done.error());
  TRY(stones());
  if (with_chunks) {
    const auto add_chunk = [&](WorldChunk decoded) {
      auto& bricks = rows_.world.bricks;
      bricks.insert(bricks.end(), decoded.bricks.begin(), decoded.bricks.end());
      decoded.bricks.clear();
      if (decoded.ground_mass) rows_.ground[decoded.chunk] = *decoded.ground_mass;
      rows_.chunks.push_back(std::move(decoded));
      return Result<void>();
    };
    TRY(chunks(add_chunk));
  }
  std::ranges::sort(rows_.world.bricks, {}, &BrickPatch::coord);
  if (!has_moment_) begin_anew();
  return std::move(rows_);
}

Result<void> WorldReading::chunks(const ChunkVisitor& visit) {
  return every("chunks", [&](uint64_t key, auto data) -> Result<void> {
    auto decoded = TRY(chunk_of_row(key, data));
    return visit(std::move(decoded));
  });
}

/// Ids and ticks that were given away are not given again.
void WorldReading::begin_anew() {
  WorldMoment& moment = rows_.world.moment;
  for (const WorldChunk& chunk : rows_.chunks) moment.tick = std::max(moment.tick, chunk.version);
  for (const PieceRecord& piece : moment.pieces)
    moment.next_piece = std::max(moment.next_piece, piece.id + 1);
}

tl::unexpected<Error> WorldReading::damaged(const std::string& what) const {
  return fail(fmt::format("{}: damaged: {}", database_.path(), what));
}

Result<void> WorldReading::one(const std::string& table, const BytesVisitor& visit) {
  size_t count = 0;
  auto read =
      database_.each(world_schema::all_of(table), [&](uint64_t key, Bytes data, bool whole) -> Result<void> {
        ++count;
        rows_.bytes += data.size();
        if (!whole) return damaged(fmt::format("the {} is not what was saved", table));
        if (auto taken = visit(key, data); !taken) return damaged(taken.error().message);
        return {};
      });
  if (read && count != 1) return damaged(fmt::format("it has {} rows of its {}", count, table));
  return read;
}

Result<void> WorldReading::every(const std::string& table, const BytesVisitor& visit) {
  const auto row = [&](uint64_t key, Bytes data, bool whole) -> Result<void> {
    rows_.bytes += data.size();
    const std::string name = fmt::format("row {} of its {}", key, table);
    if (!whole) return lose(name + " is not what was saved");
    if (auto taken = visit(key, data); !taken)
      return lose(fmt::format("{}: {}", name, taken.error().message));
    return {};
  };
  if (lost_ == nullptr) return database_.each(world_schema::all_of(table), row);
  return each_readable(database_, world_schema::all_from(table), row,
                       [&](uint64_t first, uint64_t last, const std::string& why) {
                         lost_->reasons.push_back(fmt::format("rows {} to {} of its {} cannot be read ({})",
                                                              first, last, table, why));
                       });
}

Result<void> WorldReading::lose(const std::string& what) {
  if (lost_ == nullptr) return damaged(what);
  lost_->reasons.push_back(what);
  return {};
}

/// They are for the eye alone: no stone keeps a world from going on.
Result<void> WorldReading::stones() {
  if (!TRY(database_.has_table("stones"))) return {};
  const auto leave_out = [&](const std::string& what) {
    if (rows_.stones_left_out++ == 0) rows_.stone_left_out = what;
  };
  const auto row = [&](uint64_t key, Bytes data, bool whole) -> Result<void> {
    rows_.bytes += data.size();
    const Result<void> taken = whole ? stone(key, data) : fail("it is not what was saved");
    if (!taken) leave_out(fmt::format("row {} of its stones: {}", key, taken.error().message));
    return {};
  };
  return each_readable(
      database_, world_schema::all_from("stones"), row,
      [&](uint64_t first, uint64_t last, const std::string& why) {
        leave_out(fmt::format("rows {} to {} of its stones cannot be read ({})", first, last, why));
      });
}

Result<void> WorldReading::stone(uint64_t key, Bytes data) {
  std::vector<SettledStone>& stones = rows_.world.moment.stones;
  if (stones.size() >= limits::kept_stones_max)
    return fail(fmt::format("more than {} stones (limits.kept_stones_max)", limits::kept_stones_max));
  auto decoded = TRY(decode_stone(data));
  if (decoded.id != key) return fail("it is another piece's");
  const size_t voxels = decoded.volume->window.codes.size();
  if (stone_voxels_ + voxels > limits::kept_stone_bytes_max)
    return fail(fmt::format("stones of more than {} voxels (limits.kept_stone_bytes_max)",
                            limits::kept_stone_bytes_max));
  stone_voxels_ += voxels;
  stones.push_back(std::move(decoded));
  return {};
}

Result<void> WorldReading::piece(uint64_t key, Bytes data) {
  auto decoded = TRY(decode_piece_record(data));
  if (decoded.id != key) return fail("it is another piece's");
  voxels_ += decoded.volume->window.codes.size();
  if (voxels_ > limits::piece_voxels_max)
    return fail(
        fmt::format("pieces of more than {} voxels (limits.piece_voxels_max)", limits::piece_voxels_max));
  rows_.world.moment.pieces.push_back(std::move(decoded));
  return {};
}

}  // namespace scree
