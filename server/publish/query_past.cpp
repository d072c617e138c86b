#include "server/publish/query_past.h"

#include "shared/base/check.h"

namespace scree {

namespace {

BrickBefore brick_before(BrickCoord coord, const PublishedState& state) {
  const auto chunk = state.chunks().find(chunk_of(coord));
  if (chunk == state.chunks().end() || ((chunk->second.edited >> index_in_chunk(coord)) & 1U) == 0)
    return {coord, nullptr};
  const auto brick = chunk->second.bricks.find(coord);
  if (brick == chunk->second.bricks.end()) return {coord, nullptr, {}, false};
  return {coord, brick->second.brick, brick->second.materials};
}

}  // namespace

void QueryPast::restart(const PublishedState& state) {
  ticks_.clear();
  volumes_.clear();
  props_.clear();
  PastTick past{state.tick(), {}, {}, {}};
  for (const auto& [id, piece] : state.pieces()) {
    volumes_[id] = {piece.volume};
    past.pieces.push_back({id, piece.pose});
  }
  for (const auto& [id, prop] : state.props()) {
    props_[id] = {prop.prop};
    past.props.push_back({id, prop.pose});
  }
  ticks_.push_back(std::move(past));
}

void QueryPast::before(const TickDelta& delta, const PublishedState& state) {
  PastTick past{delta.tick, delta.pieces, delta.props, {}};
  past.changed.reserve(delta.bricks.size() + delta.reverted.size());
  for (const BrickState& brick : delta.bricks) past.changed.push_back(brick_before(brick.coord, state));
  for (const BrickCoord brick : delta.reverted) past.changed.push_back(brick_before(brick, state));
  ticks_.push_back(std::move(past));
}

void QueryPast::after(const TickDelta& delta, const PublishedState& state) {
  CHECK(!ticks_.empty() && ticks_.back().tick == delta.tick);
  for (const SpawnedPiece& piece : delta.spawned) volumes_[piece.id] = {piece.volume};
  for (const SpawnedProp& prop : delta.props_spawned) props_[prop.id] = {prop.prop};
  while (ticks_.size() > kept_ + 1) ticks_.pop_front();
  if (delta.tick % (kept_ + 1) != 0) return;
  forget_gone(volumes_, state.pieces(), delta.tick);
  forget_gone(props_, state.props(), delta.tick);
}

/// Not at once: the ticks that are kept have them.
template <typename T, typename There>
void QueryPast::forget_gone(ById<T>& kept, const There& there, Tick now) const {
  for (auto entry = kept.begin(); entry != kept.end();) {
    Kept<T>& one = entry->second;
    if (one.gone == 0 && !there.contains(entry->first)) one.gone = now;
    entry = one.gone != 0 && now > one.gone + kept_ ? kept.erase(entry) : std::next(entry);
  }
}

const PastTick* QueryPast::find(Tick tick) const {
  if (ticks_.empty() || tick < ticks_.front().tick || tick > ticks_.back().tick) return nullptr;
  return &ticks_[static_cast<size_t>(tick - ticks_.front().tick)];
}

void QueryPast::add_bodies(const PastTick& past, SceneMaker& maker) const {
  for (const PieceState& piece : past.pieces)
    maker.add_piece(piece.id, dequantise(piece.pose), *volumes_.at(piece.id).value);
  for (const PieceState& prop : past.props)
    maker.add_prop(prop.id, dequantise(prop.pose), props_.at(prop.id).value);
}

std::vector<const BrickBefore*> QueryPast::changed_since(Tick tick) const {
  std::vector<const BrickBefore*> changed;
  for (const PastTick& past : ticks_)
    if (past.tick > tick)
      for (const BrickBefore& brick : past.changed) changed.push_back(&brick);
  return changed;
}

}  // namespace scree
