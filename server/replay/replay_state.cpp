#include "server/replay/replay_state.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
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

ReplaySource::State::State(std::unique_ptr<RecordingReader> r, RecordingHeader h)
    : reader(std::move(r)), header(std::move(h)), field(header.world.terrain) {}

tl::unexpected<Error> ReplaySource::State::damaged(const std::string& what) const {
  return fail(fmt::format("{}: at tick {}: {}", reader->path(), tick, what));
}

Result<void> ReplaySource::State::check_hash(uint64_t recorded) const {
  if (field.hash() == recorded) return {};
  return damaged(fmt::format(
      "the field's hash is {}, recorded was {}: the recording is damaged, or another release made it",
      hex(field.hash()), hex(recorded)));
}

Result<void> ReplaySource::State::restore(KeyframeParts parts, BricksBefore& before) {
  RecordedKeyframe& keyframe = parts.keyframe;
  played.clear();
  tick = keyframe.tick;
  const PieceTable known = std::exchange(pieces, {});
  poses.clear();
  replace_edits(field, keyframe.bricks, parts.known_chunks, before);
  for (const PieceState& piece : keyframe.poses) {
    pieces[piece.id] = known.at(piece.id);
    poses[piece.id] = piece.pose;
  }
  props.clear();
  for (PropMessage& prop : keyframe.props) {
    if (pieces.contains(prop.id)) return damaged(fmt::format("prop {} has the id of a piece", prop.id));
    props[prop.id] = {std::make_shared<const Prop>(std::move(prop.prop)), prop.pose};
  }
  joints.clear();
  for (const auto& [id, joint] : keyframe.joints) joints[id] = std::make_shared<const Joint>(joint);
  stores.clear();
  for (const StoreContent& one : keyframe.stores) stores[one.store] = one.masses;
  for (PieceMessage& piece : keyframe.pieces) {
    poses[piece.id] = piece.pose;
    pieces[piece.id] = std::make_shared<const Volume>(std::move(piece.volume));
  }
  regions = std::make_shared<const std::vector<Region>>(std::move(keyframe.regions));
  signs = std::make_shared<const std::vector<Sign>>(std::move(keyframe.signs));
  ledger = keyframe.ledger;
  materials.reset();
  if (keyframe.materials.agrees(ledger)) materials = keyframe.materials;
  settings = keyframe.settings;
  state_hash = keyframe.state_hash;
  recall_stones(tick);
  return check_hash(keyframe.field_hash);
}

Result<void> ReplaySource::State::restore_before(Tick wanted, BricksBefore& before) {
  const KnownParts known{[this](ChunkCoord chunk, uint64_t hash) {
                           return field.has_edits(chunk) && field.chunk_hash(chunk) == hash;
                         },
                         [this](PieceId piece) { return pieces.contains(piece); }};
  auto keyframe = TRY(reader->keyframe_before(wanted, known));
  KeyframeParts parts;
  if (keyframe)
    parts = std::move(*keyframe);
  else
    parts.keyframe.settings = print(header.world);
  TRY(restore(std::move(parts), before));
  if (tick < start()) return damaged("the recording has no state to start from");
  return {};
}

Result<void> ReplaySource::State::apply_operation(const Operation& operation, TickDelta& delta,
                                                  std::set<BrickCoord>& changed, BricksBefore* before) {
  const float voxel_size_m = field.source().voxel_size_m;
  if (const auto valid = validate(operation, pieces, voxel_size_m); !valid)
    return damaged(valid.error().message);
  work_us += price_us(operation, field, pieces);
  const VoxelBox reads = read_box(operation, pieces, voxel_size_m);
  const BricksBefore stood = before != nullptr ? edits_within(field, reads) : BricksBefore();
  const Applied applied = apply(operation, field, pieces);
  if (materials && !materials->enter(applied.flows))
    return damaged("an operation gains more than its pieces and all dust have");
  delta.operations.push_back(describe(operation, reads, applied));
  changed.insert(applied.changed.begin(), applied.changed.end());
  for (const CreatedPiece& piece : applied.created) delta.spawned.push_back({piece.id, pieces.at(piece.id)});
  if (before == nullptr) return {};
  for (const BrickCoord brick : applied.changed) {
    const auto known = stood.find(brick);
    before->try_emplace(brick, known == stood.end() ? std::nullopt : known->second);
  }
  return {};
}

/// No operation before them names them, and those after may, so they come first.
Result<void> ReplaySource::State::add_pieces(RecordedFrame& frame, TickDelta& delta) {
  for (PieceMessage& added : frame.pieces) {
    auto volume = std::make_shared<const Volume>(std::move(added.volume));
    if (props.contains(added.id) || !pieces.try_emplace(added.id, volume).second)
      return damaged(fmt::format("piece {} is added a second time", added.id));
    if (materials && !materials->enter(flows_poured(masses_of(*volume))))
      return damaged("a piece that is added needs more than all dust");
    delta.spawned.push_back({added.id, std::move(volume)});
  }
  return {};
}

Result<void> ReplaySource::State::change_props(const RecordedFrame& frame, TickDelta& delta) {
  for (const PieceId gone : frame.props_gone)
    if (props.erase(gone) == 0) return damaged(fmt::format("prop {} is gone, and was not there", gone));
  for (const PropMessage& added : frame.props) {
    auto prop = std::make_shared<const Prop>(added.prop);
    if (pieces.contains(added.id) || !props.try_emplace(added.id, PublishedProp{prop, added.pose}).second)
      return damaged(fmt::format("prop {} is added a second time", added.id));
    delta.props_spawned.push_back({added.id, std::move(prop)});
  }
  return {};
}

Result<void> ReplaySource::State::change_joints(const RecordedFrame& frame, TickDelta& delta) {
  for (const EndedJoint& gone : frame.joints.gone)
    if (joints.erase(gone.id) == 0)
      return damaged(fmt::format("joint {} is gone, and was not there", gone.id));
  delta.joints_removed = frame.joints.gone;
  for (const auto& [id, added] : frame.joints.here) {
    if (pieces.contains(id) || props.contains(id))
      return damaged(fmt::format("joint {} has the id of a body", id));
    joints[id] = std::make_shared<const Joint>(added);
    delta.joints_added.push_back({id, joints.at(id)});
  }
  return {};
}

void ReplaySource::State::tell_props(TickDelta& delta) const {
  for (const auto& [id, one] : props) delta.props.push_back({id, one.pose});
}

Result<void> ReplaySource::State::place_pieces(const RecordedFrame& frame, TickDelta& delta) {
  for (const PieceState& moved : frame.moved) {
    if (const auto prop = props.find(moved.id); prop != props.end()) {
      prop->second.pose = moved.pose;
      continue;
    }
    if (!pieces.contains(moved.id)) return damaged(fmt::format("piece {} is not there", moved.id));
    poses[moved.id] = moved.pose;
  }
  std::erase_if(poses, [this](const auto& pose) { return !pieces.contains(pose.first); });
  for (const auto& [id, volume] : pieces) {
    const auto pose = poses.find(id);
    if (pose == poses.end()) return damaged(fmt::format("piece {} has no pose", id));
    delta.pieces.push_back({id, pose->second});
  }
  CHECK(poses.size() == pieces.size());
  return {};
}

Result<std::shared_ptr<TickDelta>> ReplaySource::State::advance(BricksBefore* before, bool undoable) {
  CHECK(tick < reader->last_tick());
  auto frame = reader->frame(tick + 1);
  TRY(frame);
  PlayedTick undo;
  if (undoable)
    undo = {{},    pieces, poses,  props,     joints,   regions,
            signs, stores, ledger, materials, settings, state_hash};
  const bool notes = before != nullptr || undoable;
  auto delta = std::make_shared<TickDelta>();
  delta->tick = ++tick;
  work_us = 0.0F;
  std::set<BrickCoord> changed;
  TRY(add_pieces(*frame, *delta));
  for (const Operation& operation : frame->operations)
    TRY(apply_operation(operation, *delta, changed, notes ? &undo.bricks : nullptr));
  std::ranges::sort(delta->spawned, {}, &SpawnedPiece::id);
  TRY(change_props(*frame, *delta));
  TRY(change_joints(*frame, *delta));
  TRY(place_pieces(*frame, *delta));
  tell_props(*delta);
  TRY(check_hash(frame->field_hash));
  for (const BrickCoord coord : changed) delta->bricks.push_back(published_brick(field, coord));
  for (const StoreContent& one : frame->stores)
    if (one.masses.empty())
      stores.erase(one.store);
    else
      stores[one.store] = one.masses;
  delta->stores = frame->stores;
  ledger = frame->ledger;
  state_hash = frame->state_hash;
  if (!frame->settings.empty()) settings = frame->settings;
  delta->settings = frame->settings;
  if (frame->regions != nullptr) regions = frame->regions;
  delta->regions = frame->regions;
  if (frame->signs != nullptr) signs = frame->signs;
  delta->signs = frame->signs;
  delta->notices = frame->notices;
  delta->ledger = ledger;
  if (materials) delta->materials = *materials;
  delta->field_hash = frame->field_hash;
  delta->state_hash = state_hash;
  if (before != nullptr) before->insert(undo.bricks.begin(), undo.bricks.end());
  if (!undoable) played.clear();
  if (undoable) played.push_back(std::move(undo));
  if (played.size() > played_ticks_max) played.pop_front();
  stones.follow(field, *delta);
  stone_history.note(*delta);
  return delta;
}

void ReplaySource::State::revert_tick(BricksBefore& before) {
  CHECK(!played.empty());
  PlayedTick last = std::move(played.back());
  played.pop_back();
  revert_bricks(field, last.bricks, before);
  pieces = std::move(last.pieces);
  poses = std::move(last.poses);
  props = std::move(last.props);
  joints = std::move(last.joints);
  regions = std::move(last.regions);
  signs = std::move(last.signs);
  stores = std::move(last.stores);
  ledger = last.ledger;
  materials = std::move(last.materials);
  settings = std::move(last.settings);
  state_hash = last.state_hash;
  --tick;
  recall_stones(tick);
}

/// Backwards from the ticks that can be taken back; else from the state there is, or a keyframe, whichever is
/// nearer. Who goes back may want to go on so: then the ticks up to there are kept.
Result<void> ReplaySource::State::go_to(Tick wanted, BricksBefore& before) {
  const bool back = wanted < tick;
  if (back && tick - wanted <= played.size()) {
    while (tick > wanted) revert_tick(before);
    return {};
  }
  const auto nearest = reader->keyframe_tick_before(wanted);
  TRY(nearest);
  if (back || *nearest > tick) TRY(restore_before(wanted, before));
  while (tick < wanted) TRY(advance(&before, back));
  CHECK_EQ(tick, wanted);
  return {};
}

std::shared_ptr<TickDelta> ReplaySource::State::unchanged() const {
  auto delta = std::make_shared<TickDelta>();
  delta->tick = tick;
  for (const auto& [id, volume] : pieces) delta->pieces.push_back({id, poses.at(id)});
  tell_props(*delta);
  delta->ledger = ledger;
  if (materials) delta->materials = *materials;
  delta->field_hash = field.hash();
  delta->state_hash = state_hash;
  return delta;
}

std::shared_ptr<const TickDelta> ReplaySource::State::whole_state() {
  auto delta = unchanged();
  for (const ChunkCoord chunk : field.edited_chunks())
    for (const BrickCoord coord : field.edited_bricks(chunk))
      delta->bricks.push_back(published_brick(field, coord));
  std::ranges::sort(delta->bricks, {}, &BrickState::coord);
  for (const auto& [id, volume] : pieces) delta->spawned.push_back({id, volume});
  for (const auto& [id, one] : props) delta->props_spawned.push_back({id, one.prop});
  for (const auto& [id, joint] : joints) delta->joints_added.push_back({id, joint});
  for (const auto& [store, masses] : stores) delta->stores.push_back({store, masses});
  delta->stones = stones.all();
  delta->settings = settings;
  if (!regions->empty()) delta->regions = regions;
  if (!signs->empty()) delta->signs = signs;
  delta->spawn = spawn();
  return delta;
}

void ReplaySource::State::tell_spawn(TickDelta& delta) {
  if (!delta.settings.empty()) chosen_spawn_ = chosen_spawn(settings);
  spawn_place_.follow(field, chosen_spawn_, delta);
}

Result<bool> ReplaySource::State::begins_something(Tick at) {
  const auto frame = reader->frame(at);
  TRY(frame);
  return std::ranges::any_of(frame->operations, [](const Operation& operation) {
    return pieces_merged_by(operation) == 0 && !std::holds_alternative<DiscardOperation>(operation);
  });
}

}  // namespace scree
