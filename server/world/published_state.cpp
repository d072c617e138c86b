#include "server/world/published_state.h"

#include <algorithm>
#include <variant>

#include "shared/base/check.h"

namespace scree {

namespace {

void remember(ChunkHistory& history, Tick version, uint64_t hash) {
  CHECK(history.entries.empty() || history.entries.back().version <= version);
  if (!history.entries.empty() && history.entries.back().version == version) {
    history.entries.back().hash = hash;
    return;
  }
  if (history.entries.size() == ChunkHistory::depth) history.entries.erase(history.entries.begin());
  history.entries.push_back({version, hash});
  CHECK(history.entries.size() <= ChunkHistory::depth);
}

}  // namespace

void PublishedState::apply(const TickDelta& delta) {
  CHECK(tick_ == 0 || delta.tick == tick_ + 1);
  CHECK_DEBUG(std::ranges::adjacent_find(delta.bricks, std::ranges::greater_equal{}, &BrickState::coord) ==
              delta.bricks.end());
  CHECK_DEBUG(std::ranges::is_sorted(delta.pieces, {}, &PieceState::id));
  tick_ = delta.tick;
  for (const BrickState& state : delta.bricks) {
    CHECK_DEBUG(state.brick != nullptr && state.hash == brick_hash(state.coord, *state.brick, state.paint));
    PublishedChunk& chunk = chunks_[chunk_of(state.coord)];
    BrickState& slot = chunk.bricks[state.coord];
    chunk.hash += state.hash - slot.hash;
    slot = state;
    chunk.version = delta.tick;
    remember(chunk.history, chunk.version, chunk.hash);
  }
  for (const BrickCoord coord : delta.reverted) revert(coord);
  std::map<PieceId, PublishedPiece> alive;
  for (const PieceState& piece : delta.pieces) {
    const auto known = pieces_.find(piece.id);
    if (known != pieces_.end()) alive[piece.id] = {known->second.volume, piece.pose};
  }
  for (const SpawnedPiece& piece : delta.spawned) {
    const auto at = std::ranges::lower_bound(delta.pieces, piece.id, {}, &PieceState::id);
    if (at != delta.pieces.end() && at->id == piece.id) alive[piece.id] = {piece.volume, at->pose};
  }
  CHECK(alive.size() == delta.pieces.size());
  pieces_ = std::move(alive);
  pieces_made_ += delta.spawned.size();
  for (const AppliedOperation& applied : delta.operations)
    pieces_merged_ += pieces_merged_by(applied.operation);
  ledger_ = delta.ledger;
  if (!delta.settings.empty()) settings_ = delta.settings;
  field_hash_ = delta.field_hash;
  state_hash_ = delta.state_hash;
  CHECK_DEBUG(field_hash_ == sum_of_chunks());
}

void PublishedState::revert(BrickCoord coord) {
  const auto found = chunks_.find(chunk_of(coord));
  CHECK(found != chunks_.end() && found->second.bricks.contains(coord));
  PublishedChunk& chunk = found->second;
  chunk.hash -= chunk.bricks.at(coord).hash;
  chunk.bricks.erase(coord);
  if (chunk.bricks.empty()) {
    chunks_.erase(found);
    return;
  }
  chunk.version = tick_;
  remember(chunk.history, chunk.version, chunk.hash);
}

uint64_t PublishedState::sum_of_chunks() const {
  uint64_t sum = 0;
  for (const auto& [coord, chunk] : chunks_) sum += chunk.hash;
  return sum;
}

TickDelta PublishedState::as_delta() const {
  TickDelta delta = without_bricks();
  for (const auto& [coord, chunk] : chunks_)
    for (const auto& [brick, state] : chunk.bricks) delta.bricks.push_back(state);
  std::ranges::sort(delta.bricks, {}, &BrickState::coord);
  return delta;
}

TickDelta PublishedState::as_delta(const std::set<BrickCoord>& bricks) const {
  TickDelta delta = without_bricks();
  for (const BrickCoord brick : bricks) delta.bricks.push_back(chunks_.at(chunk_of(brick)).bricks.at(brick));
  return delta;
}

TickDelta PublishedState::without_bricks() const {
  TickDelta delta;
  delta.tick = tick_;
  for (const auto& [id, piece] : pieces_) {
    delta.spawned.push_back({id, piece.volume});
    delta.pieces.push_back({id, piece.pose});
  }
  delta.ledger = ledger_;
  delta.settings = settings_;
  delta.field_hash = field_hash_;
  delta.state_hash = state_hash_;
  return delta;
}

std::optional<uint64_t> PublishedState::hash_at(ChunkCoord chunk, Tick version) const {
  const auto found = chunks_.find(chunk);
  if (found == chunks_.end()) return std::nullopt;
  for (const ChunkHistory::Entry& entry : found->second.history.entries)
    if (entry.version == version) return entry.hash;
  return std::nullopt;
}

}  // namespace scree
