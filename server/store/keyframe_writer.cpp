#include "server/store/keyframe_writer.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/operation_codec.h"
#include "server/formats/recording_codec.h"
#include "server/store/limits.h"
#include "server/store/schema.h"
#include "server/store/world_schema.h"
#include "server/world/recorded_values.h"
#include "shared/base/check.h"

namespace scree {

namespace {

std::string key_text(ChunkCoord chunk) {
  return std::to_string(world_schema::chunk_key(chunk));
}

}  // namespace

Result<KeyframeWriter> KeyframeWriter::create(Database& database, SettingValues header) {
  KeyframeWriter writer(database);
  writer.header_ = std::move(header);
  const std::pair<Statement*, std::string> statements[] = {
      {&writer.insert_chunk_, schema::insert_chunk()},
      {&writer.put_piece_, schema::put_into("keyframe_pieces")},
      {&writer.put_state_, schema::put_into("keyframe_states")}};
  for (const auto& [statement, sql] : statements) {
    auto prepared = TRY(database.prepare(sql));
    *statement = std::move(prepared);
  }
  return writer;
}

Result<void> KeyframeWriter::resume() {
  return database_->each_number("SELECT chunk, hash FROM keyframe_chunks ORDER BY tick, id",
                                [this](std::span<const int64_t> row) -> Result<void> {
                                  written_[world_schema::chunk_of_key(static_cast<uint64_t>(row[0]))] =
                                      static_cast<uint64_t>(row[1]);
                                  return {};
                                });
}

/// As it was written last: it has not changed since.
Result<void> KeyframeWriter::bring_in(ChunkCoord chunk, PublishedState& state) {
  const auto damaged = [this] { return fail(database_->path() + ": the last row of a chunk is damaged"); };
  std::optional<std::vector<BrickPatch>> bricks;
  const auto add_row = [&](uint64_t, std::span<const uint8_t> data, bool whole) -> Result<void> {
    auto decoded = decode_bricks(data);
    if (!whole || !decoded) return damaged();
    bricks = std::move(*decoded);
    return {};
  };
  const std::string select = fmt::format(
      "SELECT tick, data, checksum FROM keyframe_chunks WHERE chunk = {} ORDER BY tick DESC, id DESC LIMIT 1",
      key_text(chunk));
  TRY(database_->each(select, add_row));
  if (!bricks || !state.page_in(chunk, *bricks)) return damaged();
  return {};
}

void KeyframeWriter::page_out(PublishedState& state) const {
  if (state.bricks_in() <= limits::recorded_bricks_max) return;
  std::vector<std::pair<Tick, ChunkCoord>> in;
  for (const ChunkCoord chunk : state.chunks_in())
    if (!changed_.contains(chunk)) in.emplace_back(state.chunks().at(chunk).used, chunk);
  std::ranges::sort(in);
  for (const auto& [used, chunk] : in) {
    if (state.bricks_in() <= limits::recorded_bricks_max / 8 * 7) return;
    state.page_out(chunk);
  }
}

Result<void> KeyframeWriter::apply(const TickDelta& delta, PublishedState& state) {
  for (const BrickState& brick : delta.bricks) {
    const ChunkCoord chunk = chunk_of(brick.coord);
    if (!changed_.insert(chunk).second) continue;
    const auto known = state.chunks().find(chunk);
    if (known == state.chunks().end() || known->second.is_whole()) continue;
    TRY(bring_in(chunk, state));
  }
  state.apply(delta);
  page_out(state);
  return {};
}

void KeyframeWriter::begin(const TickDelta& keyframe, PublishedState& state, ReadChunk read) {
  read_ = std::move(read);
  state = {};
  state.apply(keyframe);
  changed_.clear();
  for (const auto& [chunk, published] : state.chunks()) changed_.insert(chunk);
}

bool KeyframeWriter::is_due(const PublishedState& state) const {
  if (state.tick() % limits::ticks_per_idle_keyframe == 0) return true;
  if (state.tick() % limits::ticks_per_keyframe != 0) return false;
  return !changed_.empty() || !state.pieces().empty() || !pieces_.empty() || !state.props().empty();
}

Result<std::vector<BrickPatch>> KeyframeWriter::read_whole(const PublishedChunk& published,
                                                           ChunkCoord chunk) const {
  CHECK(read_ != nullptr);
  auto bricks = read_(chunk);
  if (!bricks) return bricks;
  uint64_t hash = 0;
  for (const BrickPatch& brick : *bricks) hash += brick_hash(brick.coord, brick.brick, brick.materials);
  if (hash != published.hash || bricks->empty())
    return fail(database_->path() + " cannot begin: a chunk was read that is not the world's");
  return bricks;
}

Result<void> KeyframeWriter::put_chunk(const PublishedState& state, ChunkCoord chunk) {
  const PublishedChunk& published = state.chunks().at(chunk);
  const auto written = written_.find(chunk);
  if (written != written_.end() && written->second == published.hash) return {};
  std::vector<BrickView> bricks;
  std::vector<BrickPatch> read;
  if (!published.is_whole()) {
    auto whole = TRY(read_whole(published, chunk));
    read = std::move(whole);
  }
  for (const BrickPatch& brick : read) bricks.push_back({brick.coord, &brick.brick, brick.materials});
  if (read.empty())
    for (const auto& [coord, brick] : published.bricks)
      bricks.push_back({coord, brick.brick.get(), brick.materials});
  const std::vector<uint8_t> data = encode_bricks(bricks);
  const int64_t keys[] = {static_cast<int64_t>(state.tick()),
                          static_cast<int64_t>(world_schema::chunk_key(chunk)),
                          static_cast<int64_t>(published.hash)};
  TRY(database_->put(insert_chunk_, keys, data));
  written_[chunk] = published.hash;
  return {};
}

Result<void> KeyframeWriter::put_piece(PieceId id, const PublishedPiece& piece) {
  return database_->put(put_piece_, id, encode_recorded_piece({id, *piece.volume, piece.pose}));
}

Result<void> KeyframeWriter::put(const PublishedState& state) {
  for (const ChunkCoord chunk : changed_) TRY(put_chunk(state, chunk));
  changed_.clear();
  read_ = {};
  RecordedKeyframe keyframe;
  std::set<PieceId> alive;
  for (const auto& [id, piece] : state.pieces()) {
    if (!pieces_.contains(id)) TRY(put_piece(id, piece));
    alive.insert(alive.end(), id);
    keyframe.poses.push_back({id, piece.pose});
  }
  pieces_ = std::move(alive);
  for (const auto& [id, prop] : state.props()) keyframe.props.push_back({id, *prop.prop, prop.pose});
  for (const auto& [id, joint] : state.joints()) keyframe.joints.push_back({id, *joint});
  keyframe.regions = *state.regions();
  keyframe.signs = *state.signs();
  for (const auto& [store, masses] : state.stores()) keyframe.stores.push_back({store, masses});
  keyframe.tick = state.tick();
  keyframe.ledger = state.ledger();
  keyframe.materials = state.materials();
  keyframe.field_hash = state.field_hash();
  keyframe.state_hash = state.state_hash();
  if (state.settings() != header_) keyframe.settings = state.settings();
  return database_->put(put_state_, keyframe.tick, encode(keyframe));
}

Result<void> KeyframeWriter::drop_before(Tick tick, PieceId next_piece) {
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
