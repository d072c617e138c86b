#include "tools/film/recorded_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/mirror/pose_between.h"
#include "client/viewer/base/limits.h"
#include "client/viewer/events/cue_event.h"
#include "server/replay/recorded_field.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Ticks after which the speeds of pieces are known, by which they raise dust.
constexpr double ticks_to_know_speeds = 3.0;

}  // namespace

/// Begins so early that all dust of the first moment is raised on the way there.
Result<std::unique_ptr<RecordedScene>> RecordedScene::open(const std::string& path, double from_tick,
                                                           const GroundGiver& ground) {
  auto source = TRY(ReplaySource::open(path, 0, ground));
  CHECK(from_tick >= static_cast<double>(source->first_tick()) &&
        from_tick <= static_cast<double>(source->last_tick()));
  const double dust_ticks = double{limits::particle_seconds_max} * source->header().world.tick_rate_hz;
  const auto start = static_cast<Tick>(std::max(static_cast<double>(source->first_tick()),
                                                std::floor(from_tick - dust_ticks) - ticks_to_know_speeds));
  TRY(source->seek(start));
  auto state = TRY(state_at_start(*source));
  return std::unique_ptr<RecordedScene>(new RecordedScene(std::move(source), std::move(state)));
}

RecordedScene::RecordedScene(std::unique_ptr<ReplaySource> source, std::shared_ptr<const TickDelta> state)
    : source_(std::move(source)),
      field_(source_->header().world.terrain),
      moment_(static_cast<double>(state->tick)) {
  show(std::move(state), unseen_);
}

Result<MirrorChanges> RecordedScene::go_to(double tick) {
  CHECK(tick >= moment_ && tick <= static_cast<double>(source_->last_tick()));
  const auto whole = static_cast<Tick>(tick);
  events_.clear();
  while (now_->tick < whole) {
    TRY(read_ahead());
    show(std::exchange(ahead_, nullptr), unseen_);
  }
  const double part = tick - static_cast<double>(whole);
  if (part > 0.0) TRY(read_ahead());
  move_pieces(static_cast<float>(part));
  moment_ = tick;
  return std::exchange(unseen_, {});
}

Result<void> RecordedScene::read_ahead() {
  if (ahead_ != nullptr) return {};
  auto next = source_->next();
  TRY(next);
  CHECK(*next != nullptr);  // the caller stays within the recording
  CHECK_EQ((*next)->tick, now_->tick + 1);
  ahead_ = std::move(*next);
  return {};
}

void RecordedScene::show(std::shared_ptr<const TickDelta> delta, MirrorChanges& changes) {
  now_ = std::move(delta);
  follow_bricks(*now_, field_);
  for (const BrickState& brick : now_->bricks) changes.bricks.push_back(brick.coord);
  for (const SpawnedPiece& piece : now_->spawned) volumes_[piece.id] = piece.volume;
  update_pieces(changes);
  update_props(changes);
  for (const AddedJoint& added : now_->joints_added) joints_.insert_or_assign(added.id, *added.joint);
  for (const EndedJoint& ended : now_->joints_removed) joints_.erase(ended.id);
  const double now_s = seconds_of(static_cast<double>(now_->tick));
  std::vector<PieceEvent> events = piece_events_.step(scene(), now_s, *palette());
  follow_rules(events);
  dust_.add(events, now_s);
  if (!events.empty()) events_.push_back({static_cast<double>(now_->tick), std::move(events)});
}

/// A film has no session and no team: what was for all is shown and heard.
void RecordedScene::follow_rules(std::vector<PieceEvent>& events) {
  for (const Notice& notice : now_->notices)
    if (const auto* cue = std::get_if<Cue>(&notice.what); cue != nullptr &&
                                                          notice.to.kind == AudienceKind::all &&
                                                          events.size() < limits::piece_events_per_step_max)
      events.push_back(event_of(*cue, *palette()));
  if (now_->signs == nullptr) return;
  signs_ = *now_->signs;
  std::erase_if(signs_, [](const Sign& sign) { return sign.to.kind != AudienceKind::all; });
}

/// The pieces alive after the tick, where they are then.
void RecordedScene::update_pieces(MirrorChanges& changes) {
  ScenePieces alive;
  for (const PieceState& piece : now_->pieces) {
    alive.emplace_hint(alive.end(), piece.id, ScenePiece{volumes_.at(piece.id), dequantise(piece.pose)});
    if (pieces_.erase(piece.id) == 0) changes.pieces_added.push_back(piece.id);
  }
  for (const auto& [id, piece] : pieces_) changes.pieces_removed.push_back(id);
  pieces_ = std::move(alive);
  std::erase_if(volumes_, [this](const auto& volume) { return !pieces_.contains(volume.first); });
}

/// The props after the tick, where they are then.
void RecordedScene::update_props(MirrorChanges& changes) {
  std::map<PieceId, std::shared_ptr<const Prop>> added;
  for (const SpawnedProp& prop : now_->props_spawned) added[prop.id] = prop.prop;
  SceneProps there;
  for (const PieceState& state : now_->props) {
    const auto is_new = added.find(state.id);
    if (is_new != added.end()) changes.props_added.push_back(state.id);
    const std::shared_ptr<const Prop> prop =
        is_new != added.end() ? is_new->second : props_.at(state.id).prop;
    props_.erase(state.id);
    there.emplace_hint(there.end(), state.id, SceneProp{prop, dequantise(state.pose)});
  }
  for (const auto& [id, prop] : props_) changes.props_removed.push_back(id);
  props_ = std::move(there);
}

Pose RecordedScene::on_the_way(const PieceState& from, const std::vector<PieceState>& to, float part) {
  const Pose pose = dequantise(from.pose);
  const auto next = std::ranges::lower_bound(to, from.id, {}, &PieceState::id);
  if (next == to.end() || next->id != from.id) return pose;
  return pose_between(pose, dequantise(next->pose), part);
}

/// Each piece and prop to that part of its way from the last whole tick to the next one; one that ends there
/// waits.
void RecordedScene::move_pieces(float part) {
  const std::vector<PieceState> none;
  const bool on = part > 0.0F;
  for (const PieceState& from : now_->pieces)
    pieces_.at(from.id).pose = on_the_way(from, on ? ahead_->pieces : none, part);
  for (const PieceState& from : now_->props)
    props_.at(from.id).pose = on_the_way(from, on ? ahead_->props : none, part);
}

}  // namespace scree
