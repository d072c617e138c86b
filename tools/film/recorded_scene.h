// A recording's world at any moment, to be drawn: the terrain after the last whole tick, pieces, props and
// persons on foot between that tick and the next one, and the dust that they raised. What is shown at a
// moment does not depend on which moments were shown before. Nothing is simulated. One thread at a time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "client/mirror/mirror.h"
#include "client/render/scene/draw_method.h"
#include "client/render/scene/joint_lines.h"
#include "client/render/scene/particle.h"
#include "client/viewer/events/dust.h"
#include "client/viewer/events/piece_event_detector.h"
#include "client/viewer/figures/figures.h"
#include "client/viewer/signs/shown_signs.h"
#include "server/replay/replay_source.h"

namespace scree {

/// What pieces did, and a game's cues that all got, from one tick to the next.
struct TickEvents {
  double tick = 0.0;  ///< the later one
  std::vector<PieceEvent> events;
};

class RecordedScene {
 public:
  /// Opens a recording, to be shown from a moment on, which lies within its ticks.
  static Result<std::unique_ptr<RecordedScene>> open(const std::string& path, double from_tick,
                                                     const GroundGiver& ground);

  /// Goes to a moment, in ticks and parts of one: not before the last one, and not after the recording's end.
  /// The result is what changed since the last moment, or since untouched terrain.
  Result<MirrorChanges> go_to(double tick);

  /// As of the last moment.
  Field& field() { return field_; }
  const Field& field() const { return field_; }
  const ScenePieces& pieces() const { return pieces_; }
  Scene scene() const { return {field_, pieces_, props_}; }
  const SceneJoints& joints() const { return joints_; }
  /// The recording's, as it starts. Not null.
  const std::shared_ptr<const Palette>& palette() const { return source_->header().world.palette; }
  WaterLevel water() const { return water_; }
  /// From the recording's first moment.
  double seconds() const { return seconds_of(moment_); }
  /// What pieces did since the moment before, in order.
  const std::vector<TickEvents>& events() const { return events_; }
  /// A game's signs that all saw, and the moment by which they are shown.
  const std::vector<Sign>& signs() const { return signs_; }
  SignMoment sign_moment() const {
    return {moment_, static_cast<double>(source_->header().world.tick_rate_hz)};
  }
  /// The persons on foot; their bodies are no props here.
  const Figures& figures() const { return shown_figures_; }
  /// In the air; the farthest from the eye first.
  std::vector<Particle> particles(glm::vec3 eye_m) { return dust_.at(seconds_of(moment_), eye_m); }

 private:
  RecordedScene(std::unique_ptr<ReplaySource> source, std::shared_ptr<const TickDelta> state);

  double seconds_of(double tick) const { return tick / source_->header().world.tick_rate_hz; }
  Result<void> read_ahead();
  void show(std::shared_ptr<const TickDelta> delta, MirrorChanges& changes);
  void follow_rules(std::vector<PieceEvent>& events);
  void update_pieces(MirrorChanges& changes);
  void update_props(MirrorChanges& changes);
  void move_pieces(float part);
  Result<void> follow_persons();
  void step_figures(Figures& figures, double tick) const;
  /// Where what was there after the last tick is at that part of the way to the next one.
  static Pose on_the_way(const PieceState& from, const std::vector<PieceState>& to, float part);

  std::unique_ptr<ReplaySource> source_;
  MapField field_;
  std::map<PieceId, std::shared_ptr<const Volume>> volumes_;  ///< of the pieces alive
  ScenePieces pieces_;
  SceneProps props_;
  std::map<PieceId, uint64_t> persons_;  ///< the sessions of those on foot, by body
  std::map<uint64_t, Pose> bodies_;      ///< where these are at the moment, by session
  std::vector<PlayerCursor> cursors_;    ///< after the last whole tick
  PersonColours colours_;
  Figures figures_, shown_figures_;  ///< after the last whole tick, and at the moment
  SceneJoints joints_;
  WaterLevel water_;
  std::vector<Sign> signs_;
  PieceEventDetector piece_events_;
  Dust dust_;
  std::vector<TickEvents> events_;
  MirrorChanges unseen_;                    ///< since the last moment that was asked for
  std::shared_ptr<const TickDelta> now_;    ///< the last whole tick
  std::shared_ptr<const TickDelta> ahead_;  ///< the tick after it, once it was read
  double moment_ = 0.0;
};

}  // namespace scree
