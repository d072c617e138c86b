#include "server/world/published_state.h"

#include <algorithm>

#include "server/world/shared_brick.h"
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

/// What changed of a chunk whose bricks are out gives no hash: the delta tells it.
void PublishedState::apply_terrain(const TickDelta& delta) {
  std::unordered_set<ChunkCoord, CoordHash> touched;
  for (const BrickState& state : delta.bricks) {
    CHECK_DEBUG(state.brick != nullptr &&
                state.hash == brick_hash(state.coord, *state.brick, state.materials));
    touched.insert(chunk_of(state.coord));
    PublishedChunk& chunk = chunks_[chunk_of(state.coord)];
    const auto [slot, is_new] = chunk.bricks.try_emplace(state.coord);
    if (is_new) ++bricks_in_;
    chunk.hash += state.hash - slot->second.hash;
    chunk.edited |= uint64_t{1} << index_in_chunk(state.coord);
    slot->second = state;
    in_.insert(chunk_of(state.coord));
  }
  for (const ChunkState& state : delta.chunks) {
    touched.insert(state.chunk);
    PublishedChunk& chunk = chunks_[state.chunk];
    CHECK_DEBUG((chunk.edited & ~state.edited) == 0);
    chunk.hash = state.hash;
    chunk.edited = state.edited;
  }
  for (const ChunkCoord coord : touched) {
    PublishedChunk& chunk = chunks_[coord];
    chunk.version = chunk.used = delta.tick;
    remember(chunk.history, chunk.version, chunk.hash);
  }
}

void PublishedState::page_out(ChunkCoord coord) {
  PublishedChunk& chunk = chunks_.at(coord);
  bricks_in_ -= chunk.bricks.size();
  chunk.bricks.clear();
  if (!chunk.history.entries.empty()) chunk.history.entries = {chunk.history.entries.back()};
  in_.erase(coord);
}

bool PublishedState::page_in(ChunkCoord coord, std::span<const BrickPatch> bricks) {
  const auto found = chunks_.find(coord);
  if (found == chunks_.end()) return false;
  PublishedChunk& chunk = found->second;
  std::map<BrickCoord, BrickState> whole = chunk.bricks;
  for (const BrickPatch& patch : bricks)
    if (chunk_of(patch.coord) == coord && !whole.contains(patch.coord))
      whole[patch.coord] = {patch.coord, shared_copy(patch.brick),
                            brick_hash(patch.coord, patch.brick, patch.materials), patch.materials};
  uint64_t hash = 0, edited = 0;
  for (const auto& [brick, state] : whole) {
    hash += state.hash;
    edited |= uint64_t{1} << index_in_chunk(brick);
  }
  if (hash != chunk.hash || edited != chunk.edited) return false;
  bricks_in_ += whole.size() - chunk.bricks.size();
  chunk.bricks = std::move(whole);
  chunk.used = tick_;
  in_.insert(coord);
  return true;
}

void PublishedState::apply(const TickDelta& delta) {
  CHECK(tick_ == 0 || delta.tick == tick_ + 1);
  CHECK_DEBUG(std::ranges::adjacent_find(delta.bricks, std::ranges::greater_equal{}, &BrickState::coord) ==
              delta.bricks.end());
  CHECK_DEBUG(std::ranges::is_sorted(delta.pieces, {}, &PieceState::id));
  tick_ = delta.tick;
  apply_terrain(delta);
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
  kept_ = delta.kept;
  stones_.apply(delta);
  apply_props(delta);
  apply_persons(delta);
  for (const AddedJoint& joint : delta.joints_added) joints_[joint.id] = joint.joint;
  for (const EndedJoint& joint : delta.joints_removed) joints_.erase(joint.id);
  if (delta.regions != nullptr) regions_ = delta.regions;
  if (delta.signs != nullptr) signs_ = delta.signs;
  if (delta.players != nullptr) players_ = delta.players;
  if (delta.region_masses != nullptr) region_masses_ = delta.region_masses;
  for (const StoreContent& one : delta.stores)
    if (one.masses.empty())
      stores_.erase(one.store);
    else
      stores_[one.store] = one.masses;
  pieces_made_ += delta.spawned.size();
  for (const AppliedOperation& applied : delta.operations)
    pieces_merged_ += pieces_merged_by(applied.operation);
  ledger_ = delta.ledger;
  materials_ = delta.materials;
  if (!delta.settings.empty()) settings_ = delta.settings;
  if (delta.spawn) spawn_ = delta.spawn;
  field_hash_ = delta.field_hash;
  state_hash_ = delta.state_hash;
  CHECK_DEBUG(field_hash_ == sum_of_chunks());
}

void PublishedState::apply_props(const TickDelta& delta) {
  for (const SpawnedProp& one : delta.props_spawned) props_[one.id].prop = one.prop;
  auto there = props_.begin();
  for (const PieceState& prop : delta.props) {
    while (there != props_.end() && there->first < prop.id) there = props_.erase(there);
    CHECK(there != props_.end() && there->first == prop.id);
    there->second.pose = prop.pose;
    ++there;
  }
  props_.erase(there, props_.end());
}

void PublishedState::apply_persons(const TickDelta& delta) {
  const auto is_same = [](const PersonPlace& a, const PersonPlace& b) {
    return a.session == b.session && a.body == b.body;
  };
  if (!std::ranges::equal(persons_, delta.persons, is_same)) ++persons_version_;
  persons_ = delta.persons;
}

const PersonPlace* PublishedState::person_of(uint64_t session) const {
  const auto found = std::ranges::lower_bound(persons_, session, {}, &PersonPlace::session);
  return found != persons_.end() && found->session == session ? &*found : nullptr;
}

void PublishedState::revert(BrickCoord coord) {
  const auto found = chunks_.find(chunk_of(coord));
  CHECK(found != chunks_.end() && found->second.bricks.contains(coord));
  PublishedChunk& chunk = found->second;
  CHECK(chunk.is_whole());
  chunk.hash -= chunk.bricks.at(coord).hash;
  chunk.edited &= ~(uint64_t{1} << index_in_chunk(coord));
  chunk.bricks.erase(coord);
  --bricks_in_;
  if (chunk.bricks.empty()) {
    in_.erase(found->first);
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
  CHECK_DEBUG(std::ranges::all_of(chunks_, [](const auto& entry) { return entry.second.is_whole(); }));
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
  delta.kept = kept_;
  for (const auto& [id, stone] : stones_.all()) delta.stones.push_back(stone);
  for (const auto& [id, one] : props_) {
    delta.props_spawned.push_back({id, one.prop});
    delta.props.push_back({id, one.pose});
  }
  for (const auto& [id, joint] : joints_) delta.joints_added.push_back({id, joint});
  if (!regions_->empty()) delta.regions = regions_;
  if (!signs_->empty()) delta.signs = signs_;
  if (!players_->empty()) delta.players = players_;
  delta.persons = persons_;
  for (const auto& [store, masses] : stores_) delta.stores.push_back({store, masses});
  delta.region_masses = region_masses_;
  delta.ledger = ledger_;
  delta.materials = materials_;
  delta.settings = settings_;
  delta.spawn = spawn_;
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
