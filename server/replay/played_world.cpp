#include "server/replay/played_world.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <functional>
#include <utility>

#include "server/world/applied_operation.h"
#include "server/world/settings.h"
#include "shared/base/check.h"
#include "shared/operation/price.h"

namespace scree {

namespace {

/// Ticks that can be taken back at once: as many as lie between two keyframes. The earliest are forgotten.
constexpr size_t played_ticks_max = 600;

std::string hex(uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace

PlayedWorld::PlayedWorld(std::string name, const TerrainSource& terrain)
    : name_(std::move(name)), field_(terrain) {}

tl::unexpected<Error> PlayedWorld::damaged(const std::string& what) const {
  return fail(fmt::format("{}: at tick {}: {}", name_, tick_, what));
}

Result<void> PlayedWorld::check_hash(uint64_t recorded) const {
  if (field_.hash() == recorded) return {};
  return damaged(
      fmt::format("the field's hash is {}, recorded was {}: it is damaged, or another release made it",
                  hex(field_.hash()), hex(recorded)));
}

Result<void> PlayedWorld::restore(KeyframeParts parts, BricksBefore& before) {
  RecordedKeyframe& keyframe = parts.keyframe;
  played_.clear();
  tick_ = keyframe.tick;
  const PieceTable known = std::exchange(pieces_, {});
  poses_.clear();
  replace_edits(field_, keyframe.bricks, parts.known_chunks, before);
  for (const PieceState& piece : keyframe.poses) {
    pieces_[piece.id] = known.at(piece.id);
    poses_[piece.id] = piece.pose;
  }
  props_.clear();
  for (PropMessage& prop : keyframe.props) {
    if (pieces_.contains(prop.id)) return damaged(fmt::format("prop {} has the id of a piece", prop.id));
    props_[prop.id] = {std::make_shared<const Prop>(std::move(prop.prop)), prop.pose};
  }
  joints_.clear();
  for (const auto& [id, joint] : keyframe.joints) joints_[id] = std::make_shared<const Joint>(joint);
  stores_.clear();
  for (const StoreContent& one : keyframe.stores) stores_[one.store] = one.masses;
  for (PieceMessage& piece : keyframe.pieces) {
    poses_[piece.id] = piece.pose;
    pieces_[piece.id] = std::make_shared<const Volume>(std::move(piece.volume));
  }
  regions_ = std::make_shared<const std::vector<Region>>(std::move(keyframe.regions));
  signs_ = std::make_shared<const std::vector<Sign>>(std::move(keyframe.signs));
  ledger_ = keyframe.ledger;
  materials_.reset();
  if (keyframe.materials.agrees(ledger_)) materials_ = keyframe.materials;
  settings_ = keyframe.settings;
  state_hash_ = keyframe.state_hash;
  recall_stones(tick_);
  return check_hash(keyframe.field_hash);
}

KnownParts PlayedWorld::known() {
  return {[this](ChunkCoord chunk, uint64_t hash) {
            return field_.has_edits(chunk) && field_.chunk_hash(chunk) == hash;
          },
          [this](PieceId piece) { return pieces_.contains(piece); }};
}

Result<void> PlayedWorld::apply_operation(const Operation& operation, TickDelta& delta,
                                          std::set<BrickCoord>& changed, BricksBefore* before) {
  const float voxel_size_m = field_.source().voxel_size_m;
  if (const auto valid = validate(operation, pieces_, voxel_size_m); !valid)
    return damaged(valid.error().message);
  work_us_ += price_us(operation, field_, pieces_);
  const VoxelBox reads = read_box(operation, pieces_, voxel_size_m);
  const BricksBefore stood = before != nullptr ? edits_within(field_, reads) : BricksBefore();
  const Applied applied = apply(operation, field_, pieces_);
  if (materials_ && !materials_->enter(applied.flows))
    return damaged("an operation gains more than its pieces and all dust have");
  delta.operations.push_back(describe(operation, reads, applied));
  changed.insert(applied.changed.begin(), applied.changed.end());
  for (const CreatedPiece& piece : applied.created) delta.spawned.push_back({piece.id, pieces_.at(piece.id)});
  if (before == nullptr) return {};
  for (const BrickCoord brick : applied.changed) {
    const auto known = stood.find(brick);
    before->try_emplace(brick, known == stood.end() ? std::nullopt : known->second);
  }
  return {};
}

/// No operation before them names them, and those after may, so they come first.
Result<void> PlayedWorld::add_pieces(RecordedFrame& frame, TickDelta& delta) {
  for (PieceMessage& added : frame.pieces) {
    auto volume = std::make_shared<const Volume>(std::move(added.volume));
    if (props_.contains(added.id) || !pieces_.try_emplace(added.id, volume).second)
      return damaged(fmt::format("piece {} is added a second time", added.id));
    if (materials_ && !materials_->enter(flows_poured(masses_of(*volume))))
      return damaged("a piece that is added needs more than all dust");
    delta.spawned.push_back({added.id, std::move(volume)});
  }
  return {};
}

Result<void> PlayedWorld::change_props(const RecordedFrame& frame, TickDelta& delta) {
  for (const PieceId gone : frame.props_gone)
    if (props_.erase(gone) == 0) return damaged(fmt::format("prop {} is gone, and was not there", gone));
  for (const PropMessage& added : frame.props) {
    auto prop = std::make_shared<const Prop>(added.prop);
    if (pieces_.contains(added.id) || !props_.try_emplace(added.id, PublishedProp{prop, added.pose}).second)
      return damaged(fmt::format("prop {} is added a second time", added.id));
    delta.props_spawned.push_back({added.id, std::move(prop)});
  }
  return {};
}

Result<void> PlayedWorld::change_joints(const RecordedFrame& frame, TickDelta& delta) {
  for (const EndedJoint& gone : frame.joints.gone)
    if (joints_.erase(gone.id) == 0)
      return damaged(fmt::format("joint {} is gone, and was not there", gone.id));
  delta.joints_removed = frame.joints.gone;
  for (const auto& [id, added] : frame.joints.here) {
    if (pieces_.contains(id) || props_.contains(id))
      return damaged(fmt::format("joint {} has the id of a body", id));
    joints_[id] = std::make_shared<const Joint>(added);
    delta.joints_added.push_back({id, joints_.at(id)});
  }
  return {};
}

void PlayedWorld::tell_props(TickDelta& delta) const {
  for (const auto& [id, one] : props_) delta.props.push_back({id, one.pose});
}

Result<void> PlayedWorld::place_pieces(const RecordedFrame& frame, TickDelta& delta) {
  for (const PieceState& moved : frame.moved) {
    if (const auto prop = props_.find(moved.id); prop != props_.end()) {
      prop->second.pose = moved.pose;
      continue;
    }
    if (!pieces_.contains(moved.id)) return damaged(fmt::format("piece {} is not there", moved.id));
    poses_[moved.id] = moved.pose;
  }
  std::erase_if(poses_, [this](const auto& pose) { return !pieces_.contains(pose.first); });
  for (const auto& [id, volume] : pieces_) {
    const auto pose = poses_.find(id);
    if (pose == poses_.end()) return damaged(fmt::format("piece {} has no pose", id));
    delta.pieces.push_back({id, pose->second});
  }
  CHECK(poses_.size() == pieces_.size());
  return {};
}

PlayedTick PlayedWorld::as_it_is() const {
  return {{},     pieces_, poses_,  props_,     joints_,   regions_,
          signs_, stores_, ledger_, materials_, settings_, state_hash_};
}

/// What the frame says as it is, without the field.
void PlayedWorld::take_values(const RecordedFrame& frame, TickDelta& delta) {
  for (const StoreContent& one : frame.stores)
    if (one.masses.empty())
      stores_.erase(one.store);
    else
      stores_[one.store] = one.masses;
  delta.stores = frame.stores;
  ledger_ = frame.ledger;
  state_hash_ = frame.state_hash;
  if (!frame.settings.empty()) settings_ = frame.settings;
  delta.settings = frame.settings;
  if (frame.regions != nullptr) regions_ = frame.regions;
  delta.regions = frame.regions;
  if (frame.signs != nullptr) signs_ = frame.signs;
  delta.signs = frame.signs;
  delta.notices = frame.notices;
  delta.ledger = ledger_;
  if (materials_) delta.materials = *materials_;
  delta.field_hash = frame.field_hash;
  delta.state_hash = state_hash_;
}

Result<std::shared_ptr<TickDelta>> PlayedWorld::advance(RecordedFrame frame, BricksBefore* before,
                                                        bool undoable) {
  CHECK_EQ(frame.tick, tick_ + 1);
  PlayedTick undo;
  if (undoable) undo = as_it_is();
  const bool notes = before != nullptr || undoable;
  auto delta = std::make_shared<TickDelta>();
  delta->tick = ++tick_;
  work_us_ = 0.0F;
  std::set<BrickCoord> changed;
  TRY(add_pieces(frame, *delta));
  for (const Operation& operation : frame.operations)
    TRY(apply_operation(operation, *delta, changed, notes ? &undo.bricks : nullptr));
  std::ranges::sort(delta->spawned, {}, &SpawnedPiece::id);
  TRY(change_props(frame, *delta));
  TRY(change_joints(frame, *delta));
  TRY(place_pieces(frame, *delta));
  tell_props(*delta);
  TRY(check_hash(frame.field_hash));
  for (const BrickCoord coord : changed) delta->bricks.push_back(published_brick(field_, coord));
  take_values(frame, *delta);
  if (before != nullptr) before->insert(undo.bricks.begin(), undo.bricks.end());
  if (!undoable) played_.clear();
  if (undoable) played_.push_back(std::move(undo));
  if (played_.size() > played_ticks_max) played_.pop_front();
  stones_.follow(field_, *delta);
  stone_history_.note(*delta);
  return delta;
}

void PlayedWorld::revert_tick(BricksBefore& before) {
  CHECK(!played_.empty());
  PlayedTick last = std::move(played_.back());
  played_.pop_back();
  revert_bricks(field_, last.bricks, before);
  pieces_ = std::move(last.pieces);
  poses_ = std::move(last.poses);
  props_ = std::move(last.props);
  joints_ = std::move(last.joints);
  regions_ = std::move(last.regions);
  signs_ = std::move(last.signs);
  stores_ = std::move(last.stores);
  ledger_ = last.ledger;
  materials_ = std::move(last.materials);
  settings_ = std::move(last.settings);
  state_hash_ = last.state_hash;
  --tick_;
  recall_stones(tick_);
}

std::shared_ptr<TickDelta> PlayedWorld::unchanged() const {
  auto delta = std::make_shared<TickDelta>();
  delta->tick = tick_;
  for (const auto& [id, volume] : pieces_) delta->pieces.push_back({id, poses_.at(id)});
  tell_props(*delta);
  delta->ledger = ledger_;
  if (materials_) delta->materials = *materials_;
  delta->field_hash = field_.hash();
  delta->state_hash = state_hash_;
  return delta;
}

std::shared_ptr<TickDelta> PlayedWorld::whole_state() {
  auto delta = unchanged();
  for (const ChunkCoord chunk : field_.edited_chunks())
    for (const BrickCoord coord : field_.edited_bricks(chunk))
      delta->bricks.push_back(published_brick(field_, coord));
  std::ranges::sort(delta->bricks, {}, &BrickState::coord);
  for (const auto& [id, volume] : pieces_) delta->spawned.push_back({id, volume});
  for (const auto& [id, one] : props_) delta->props_spawned.push_back({id, one.prop});
  for (const auto& [id, joint] : joints_) delta->joints_added.push_back({id, joint});
  for (const auto& [store, masses] : stores_) delta->stores.push_back({store, masses});
  delta->stones = stones_.all();
  delta->settings = settings_;
  if (!regions_->empty()) delta->regions = regions_;
  if (!signs_->empty()) delta->signs = signs_;
  delta->spawn = spawn();
  return delta;
}

PlayedMoment PlayedWorld::moment() const {
  return {pieces_, props_, joints_, stores_, settings_, stones_.all(), regions_, signs_};
}

std::shared_ptr<TickDelta> PlayedWorld::differences(const PlayedMoment& from, const BricksBefore& before) {
  auto delta = unchanged();
  add_differences(field_, before, *delta);
  for (const auto& [id, volume] : pieces_)
    if (!from.pieces.contains(id)) delta->spawned.push_back({id, volume});
  for (const auto& [id, one] : props_)
    if (!from.props.contains(id)) delta->props_spawned.push_back({id, one.prop});
  for (const auto& [id, joint] : joints_)
    if (const auto known = from.joints.find(id); known == from.joints.end() || known->second != joint)
      delta->joints_added.push_back({id, joint});
  for (const auto& [id, joint] : from.joints)
    if (!joints_.contains(id)) delta->joints_removed.push_back({id, JointEnd::removed});
  if (*regions_ != *from.regions) delta->regions = regions_;
  if (*signs_ != *from.signs) delta->signs = signs_;
  for (const auto& [store, masses] : from.stores)
    if (!stores_.contains(store)) delta->stores.push_back({store, {}});
  for (const auto& [store, masses] : stores_)
    if (const auto known = from.stores.find(store); known == from.stores.end() || known->second != masses)
      delta->stores.push_back({store, masses});
  std::ranges::sort(delta->stores, std::less<>(), &StoreContent::store);
  delta->stones_gone = from.stones;
  delta->stones = stones_.all();
  if (settings_ != from.settings) delta->settings = settings_;
  return delta;
}

void PlayedWorld::tell_spawn(TickDelta& delta) {
  if (!delta.settings.empty()) chosen_spawn_ = chosen_spawn(settings_);
  spawn_place_.follow(field_, chosen_spawn_, delta);
}

}  // namespace scree
