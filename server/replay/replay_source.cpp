#include "server/replay/replay_source.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "server/world/applied_operation.h"
#include "shared/base/check.h"

namespace scree {

namespace {

std::string hex(uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace

struct ReplaySource::State {
  State(std::unique_ptr<RecordingReader> r, RecordingHeader h) : reader(std::move(r)), header(std::move(h)) {
    restart();
  }

  /// Goes back to the untouched terrain before tick 1.
  void restart();
  Result<void> restore(const RecordedKeyframe& keyframe);
  Result<std::shared_ptr<const TickDelta>> advance();
  Result<void> apply_operation(const Operation& operation, TickDelta& delta, std::set<BrickCoord>& changed);
  Result<void> place_pieces(const RecordedFrame& frame, TickDelta& delta);
  Result<void> check_hash(uint64_t recorded) const;
  std::shared_ptr<const TickDelta> whole_state();
  BrickState brick_state(BrickCoord coord);
  tl::unexpected<Error> damaged(const std::string& what) const {
    return fail(reader->path() + ": at tick " + std::to_string(tick) + ": " + what);
  }

  std::unique_ptr<RecordingReader> reader;
  const RecordingHeader header;  ///< with its ground
  std::unique_ptr<MapField> field;
  PieceTable pieces;
  std::map<PieceId, QuantisedPose> poses;
  Ledger ledger;
  SettingValues settings;
  uint64_t state_hash = 0;
  Tick tick = 0;
  bool keyframe_due = false;  ///< next() returns the whole state
};

void ReplaySource::State::restart() {
  field = std::make_unique<MapField>(header.world.terrain);
  pieces.clear();
  poses.clear();
  ledger = {};
  settings.clear();
  state_hash = 0;
  tick = 0;
  keyframe_due = false;
}

Result<void> ReplaySource::State::check_hash(uint64_t recorded) const {
  if (field->hash() == recorded) return {};
  return damaged("the field's hash is " + hex(field->hash()) + ", recorded was " + hex(recorded) +
                 ": the recording is damaged, or another release made it");
}

Result<void> ReplaySource::State::restore(const RecordedKeyframe& keyframe) {
  restart();
  tick = keyframe.tick;
  for (const BrickPatch& patch : keyframe.bricks) {
    field->set_brick(patch.coord, patch.brick);
    field->paint_brick(patch.coord, patch.paint);
  }
  for (const PieceMessage& piece : keyframe.pieces) {
    pieces[piece.id] = std::make_shared<const Volume>(piece.volume);
    poses[piece.id] = piece.pose;
  }
  ledger = from_recorded(keyframe.ledger);
  settings = keyframe.settings;
  state_hash = keyframe.state_hash;
  return check_hash(keyframe.field_hash);
}

BrickState ReplaySource::State::brick_state(BrickCoord coord) {
  auto brick = std::make_shared<const Brick>(field->brick(coord));
  const std::optional<Material> paint = field->painted(coord);
  const uint64_t hash = brick_hash(coord, *brick, paint);
  return {coord, std::move(brick), hash, paint};
}

Result<void> ReplaySource::State::apply_operation(const Operation& operation, TickDelta& delta,
                                                  std::set<BrickCoord>& changed) {
  if (const auto valid = validate(operation, pieces, field->source().voxel_size_m); !valid)
    return damaged(valid.error().message);
  const VoxelBox reads = read_box(operation, pieces, field->source().voxel_size_m);
  const Applied applied = apply(operation, *field, pieces);
  delta.operations.push_back(describe(operation, reads, applied));
  changed.insert(applied.changed.begin(), applied.changed.end());
  for (const CreatedPiece& piece : applied.created) delta.spawned.push_back({piece.id, pieces.at(piece.id)});
  return {};
}

Result<void> ReplaySource::State::place_pieces(const RecordedFrame& frame, TickDelta& delta) {
  for (const PieceState& moved : frame.moved) {
    if (!pieces.contains(moved.id)) return damaged("piece " + std::to_string(moved.id) + " is not there");
    poses[moved.id] = moved.pose;
  }
  std::erase_if(poses, [this](const auto& pose) { return !pieces.contains(pose.first); });
  for (const auto& [id, volume] : pieces) {
    const auto pose = poses.find(id);
    if (pose == poses.end()) return damaged("piece " + std::to_string(id) + " is nowhere");
    delta.pieces.push_back({id, pose->second});
  }
  CHECK_EQ(poses.size(), pieces.size());
  return {};
}

Result<std::shared_ptr<const TickDelta>> ReplaySource::State::advance() {
  CHECK(tick < reader->last_tick());
  const auto frame = reader->frame(tick + 1);
  if (!frame) return tl::unexpected(frame.error());
  auto delta = std::make_shared<TickDelta>();
  delta->tick = ++tick;
  std::set<BrickCoord> changed;
  for (const Operation& operation : frame->operations)
    if (auto applied = apply_operation(operation, *delta, changed); !applied)
      return tl::unexpected(applied.error());
  if (auto placed = place_pieces(*frame, *delta); !placed) return tl::unexpected(placed.error());
  if (auto equal = check_hash(frame->field_hash); !equal) return tl::unexpected(equal.error());
  for (const BrickCoord coord : changed) delta->bricks.push_back(brick_state(coord));
  ledger = from_recorded(frame->ledger);
  state_hash = frame->state_hash;
  if (!frame->settings.empty()) settings = frame->settings;
  delta->settings = frame->settings;
  delta->ledger = ledger;
  delta->field_hash = frame->field_hash;
  delta->state_hash = state_hash;
  return delta;
}

std::shared_ptr<const TickDelta> ReplaySource::State::whole_state() {
  auto delta = std::make_shared<TickDelta>();
  delta->tick = tick;
  for (const ChunkCoord chunk : field->edited_chunks())
    for (const BrickCoord coord : field->edited_bricks(chunk)) delta->bricks.push_back(brick_state(coord));
  std::ranges::sort(delta->bricks, {}, &BrickState::coord);
  for (const auto& [id, volume] : pieces) {
    delta->spawned.push_back({id, volume});
    delta->pieces.push_back({id, poses.at(id)});
  }
  delta->ledger = ledger;
  delta->settings = settings;
  delta->field_hash = field->hash();
  delta->state_hash = state_hash;
  return delta;
}

ReplaySource::ReplaySource(std::unique_ptr<State> state) : state_(std::move(state)) {}
ReplaySource::~ReplaySource() = default;

Result<std::unique_ptr<ReplaySource>> ReplaySource::open(const std::string& path, Tick from,
                                                         const GroundGiver& ground) {
  auto reader = RecordingReader::open(path);
  if (!reader) return tl::unexpected(reader.error());
  RecordingHeader header = (*reader)->header();
  if (auto given = give_ground(header.world.ground, header.world.terrain, ground); !given)
    return fail(path + ": " + given.error().message);
  auto source = std::unique_ptr<ReplaySource>(
      new ReplaySource(std::make_unique<State>(std::move(*reader), std::move(header))));
  if (auto sought = source->seek(from); !sought) return tl::unexpected(sought.error());
  return source;
}

const RecordingHeader& ReplaySource::header() const {
  return state_->header;
}
Tick ReplaySource::tick() const {
  return state_->tick;
}
Tick ReplaySource::last_tick() const {
  return state_->reader->last_tick();
}

Result<std::shared_ptr<const TickDelta>> ReplaySource::next() {
  if (state_->keyframe_due) {
    state_->keyframe_due = false;
    return state_->whole_state();
  }
  if (state_->tick >= last_tick()) return nullptr;
  return state_->advance();
}

Result<void> ReplaySource::seek(Tick tick) {
  if (tick > last_tick())
    return fail(state_->reader->path() + ": tick " + std::to_string(tick) + " is after its end, " +
                std::to_string(last_tick()) + " (--from)");
  const Tick start = state_->reader->first_tick() - 1;
  if (tick == 0) tick = start;
  if (tick < start)
    return fail(state_->reader->path() + ": tick " + std::to_string(tick) + " is before its start, " +
                std::to_string(start) + " (--from)");
  const auto keyframe = state_->reader->keyframe_before(tick);
  if (!keyframe) return tl::unexpected(keyframe.error());
  state_->restart();
  if (keyframe->has_value())
    if (auto restored = state_->restore(**keyframe); !restored) return restored;
  if (state_->tick < start) return state_->damaged("the recording has no state to start from");
  while (state_->tick < tick)
    if (const auto delta = state_->advance(); !delta) return tl::unexpected(delta.error());
  CHECK_EQ(state_->tick, tick);
  state_->keyframe_due = tick != 0;
  return {};
}

}  // namespace scree
