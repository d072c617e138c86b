#include "server/store/keyframe_writer.h"

#include <algorithm>

#include "proto/operation_codec.h"
#include "server/formats/recording_codec.h"
#include "server/store/limits.h"
#include "server/world/recorded_values.h"
#include "shared/base/check.h"

namespace scree {

/// As it was written last: it has not changed since.
Result<void> KeyframeWriter::bring_in(ChunkCoord chunk, PublishedState& state) {
  const auto row = TRY(rows_->last_chunk(chunk));
  const auto bricks = decode_bricks(row);
  if (!bricks || !state.page_in(chunk, *bricks))
    return fail(rows_->name() + ": the last row of a chunk is damaged");
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
    return fail(rows_->name() + " cannot begin: a chunk was read that is not the world's");
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
  TRY(rows_->put_chunk(state.tick(), chunk, published.hash, data));
  written_[chunk] = published.hash;
  return {};
}

Result<void> KeyframeWriter::put_piece(PieceId id, const PublishedPiece& piece) {
  return rows_->put_piece(id, encode_recorded_piece({id, *piece.volume, piece.pose}));
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
  return rows_->put_state(keyframe.tick, encode(keyframe));
}

}  // namespace scree
