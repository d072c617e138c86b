#include "tools/film/recorded_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/mirror/pose_between.h"
#include "client/viewer/base/limits.h"
#include "client/viewer/events/cue_event.h"
#include "server/replay/recorded_field.h"
#include "shared/base/check.h"
#include "shared/person/person_body.h"

namespace scree {

namespace {

/// A film begins to play so long before its first moment: pieces that merged then lie as stones.
constexpr double seconds_of_stones = 300.0;
/// Ticks after which the speeds of pieces are known, by which they raise dust.
constexpr double ticks_to_know_speeds = 3.0;

}  // namespace

/// Begins so early that all dust of the first moment is raised on the way there.
Result<std::unique_ptr<RecordedScene>> RecordedScene::open(const std::string& path, double from_tick,
                                                           const GroundGiver& ground) {
  auto source = TRY(ReplaySource::open(path, 0, ground));
  CHECK(from_tick >= static_cast<double>(source->first_tick()) &&
        from_tick <= static_cast<double>(source->last_tick()));
  static_assert(seconds_of_stones > double{limits::particle_seconds_max});
  const double stone_ticks = seconds_of_stones * source->header().world.tick_rate_hz;
  const auto start = static_cast<Tick>(std::max(static_cast<double>(source->first_tick()),
                                                std::floor(from_tick - stone_ticks) - ticks_to_know_speeds));
  TRY(source->seek(start));
  auto state = TRY(state_at_start(*source));
  std::unique_ptr<RecordedScene> scene(new RecordedScene(std::move(source), std::move(state)));
  TRY(scene->follow_persons());
  return scene;
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
    TRY(follow_persons());
  }
  const double part = tick - static_cast<double>(whole);
  if (part > 0.0) TRY(read_ahead());
  move_pieces(static_cast<float>(part));
  shown_figures_ = figures_;
  if (part > 0.0) step_figures(shown_figures_, tick);
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
  if (!now_->settings.empty()) water_ = water_of(now_->settings);
  for (const BrickState& brick : now_->bricks) changes.bricks.push_back(brick.coord);
  for (const PlacedStone& placed : now_->stones) changes.stones.push_back(placed.stone);
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

/// A film has no session and no team: what was for all is shown and heard. So are edits that make no pieces.
void RecordedScene::follow_rules(std::vector<PieceEvent>& events) {
  for (const Notice& notice : now_->notices)
    if (const auto* cue = std::get_if<Cue>(&notice.what); cue != nullptr &&
                                                          notice.to.kind == AudienceKind::all &&
                                                          events.size() < limits::piece_events_per_step_max)
      events.push_back(event_of(*cue, *palette()));
  std::vector<Cue> edits;
  for (const AppliedOperation& applied : now_->operations) add_cues_of(applied.operation, edits);
  for (const Cue& cue : edits)
    if (events.size() < limits::piece_events_per_step_max) events.push_back(event_of(cue, *palette()));
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

/// After the last whole tick, which is the last that was read.
Result<void> RecordedScene::follow_persons() {
  cursors_ = TRY(source_->cursors());
  std::vector<uint64_t> sessions;
  for (const auto& [body, session] : persons_) sessions.push_back(session);
  colours_.follow(sessions);
  move_pieces(0.0F);
  step_figures(figures_, static_cast<double>(now_->tick));
  shown_figures_ = figures_;
  return {};
}

/// Those on foot, as their bodies stand.
void RecordedScene::step_figures(Figures& figures, double tick) const {
  std::vector<PlayerCursor> on_foot;
  for (const PlayerCursor& cursor : cursors_)
    if (bodies_.contains(cursor.session)) on_foot.push_back(cursor);
  PersonFacts facts;
  facts.colours = &colours_;
  for (const auto& [session, pose] : bodies_) add_body(facts, on_foot, session, pose);
  figures.step(on_foot, seconds_of(tick), facts);
}

/// The props after the tick, where they are then.
void RecordedScene::update_props(MirrorChanges& changes) {
  std::map<PieceId, std::shared_ptr<const Prop>> added;
  for (const SpawnedProp& spawned : now_->props_spawned) {
    added[spawned.id] = spawned.prop;
    if (const auto session = person_of_body(*spawned.prop)) persons_[spawned.id] = *session;
  }
  std::map<PieceId, uint64_t> on_foot;
  SceneProps there;
  for (const PieceState& state : now_->props) {
    if (const auto person = persons_.find(state.id); person != persons_.end()) {
      on_foot.insert(*person);
      continue;
    }
    const auto is_new = added.find(state.id);
    if (is_new != added.end()) changes.props_added.push_back(state.id);
    const std::shared_ptr<const Prop> prop =
        is_new != added.end() ? is_new->second : props_.at(state.id).prop;
    props_.erase(state.id);
    there.emplace_hint(there.end(), state.id, SceneProp{prop, dequantise(state.pose)});
  }
  for (const auto& [id, prop] : props_) changes.props_removed.push_back(id);
  props_ = std::move(there);
  persons_ = std::move(on_foot);
}

Pose RecordedScene::on_the_way(const PieceState& from, const std::vector<PieceState>& to, float part) {
  const Pose pose = dequantise(from.pose);
  const auto next = std::ranges::lower_bound(to, from.id, {}, &PieceState::id);
  if (next == to.end() || next->id != from.id) return pose;
  return pose_between(pose, dequantise(next->pose), part);
}

/// Each piece, prop and person to that part of its way from the last whole tick to the next one; one that
/// ends there waits.
void RecordedScene::move_pieces(float part) {
  const std::vector<PieceState> none;
  const bool on = part > 0.0F;
  for (const PieceState& from : now_->pieces)
    pieces_.at(from.id).pose = on_the_way(from, on ? ahead_->pieces : none, part);
  bodies_.clear();
  for (const PieceState& from : now_->props) {
    const Pose pose = on_the_way(from, on ? ahead_->props : none, part);
    if (const auto person = persons_.find(from.id); person != persons_.end())
      bodies_[person->second] = pose;
    else
      props_.at(from.id).pose = pose;
  }
}

}  // namespace scree
