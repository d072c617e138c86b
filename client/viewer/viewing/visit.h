// A visit to a world: a session with its server, the view of it, and the camera. What a window, offscreen
// drawing and a page have in common. Needs the GL context current.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "client/viewer/events/dust.h"
#include "client/viewer/events/piece_event_detector.h"
#include "client/viewer/session/overlay.h"
#include "client/viewer/session/view.h"
#include "client/viewer/session/viewer_session.h"
#include "client/viewer/signs/shown_signs.h"
#include "client/viewer/viewing/auto_quality.h"
#include "client/viewer/viewing/shake.h"
#include "client/viewer/viewing/tool_preview.h"
#include "shared/base/trace.h"

namespace scree {

struct VisitChoice {
  Quality quality = AutoQuality::first;
  std::optional<float> view_radius_m;  ///< instead of the quality's
  std::optional<float> render_scale;   ///< the same
  std::optional<Camera> camera;        ///< instead of where the world's visitors begin
  bool particles = true;               ///< dust, grit and splinters
  bool details = true;                 ///< grass, bushes and stones, where the quality has them
  bool predict = true;                 ///< carves are shown before the server answers
};

class Visit {
 public:
  /// `drawn`: of the choice's view radius. `traced`: null: no trace.
  Visit(std::unique_ptr<Connector> connector, SessionChoice session_choice, const VisitChoice& choice,
        std::unique_ptr<View> drawn, std::unique_ptr<Trace> traced = nullptr);

  /// Takes in messages, begins work and shows finished work.
  Result<void> step(double now_s);
  /// What a game's signs show now, in a picture of that shape.
  std::vector<ShownSign> signs(float aspect, double now_s);
  SignMoment sign_moment(double now_s);
  /// What a game's rules had for this program since the last call; takes it. Nothing is kept before the first
  /// call, and at most limits::messages_heard_max: then the oldest are dropped.
  std::deque<ChannelData> drain_heard();
  /// What pieces did in the last step, and a game's cues; nothing while neither dust nor listen() asks for
  /// it.
  const std::vector<PieceEvent>& events() const { return events_; }
  void listen(bool on) { listens_ = on; }

  /// Lines over the world: the shape of the tool's next strike, if asked for, where others aim, the overlay.
  /// The renderer gets the bodies of the other persons, but of the one through whose eye one looks, and the
  /// wind's time.
  LineList lines(const Tool& tool, const OverlayChoice& overlay, std::optional<uint64_t> looked_through,
                 double now_s, bool with_tool = true);
  /// What a click does, as of the last lines().
  const std::optional<ToolAim>& aim() const { return preview_.aim(); }
  /// Adds the chosen overlay's lines, and switches the server's PhysicsMessages accordingly.
  void add_overlay(LineList& lines, const OverlayChoice& choice, double now_s);

  /// The camera stays there, wherever the world's visitors begin.
  void place_camera(const Camera& place);
  /// Draws by that preset, but for what was chosen apart.
  void use(Quality quality);
  Quality quality() const { return quality_; }
  /// Draws by the preset that is wanted, or by that which the first frames suggest; returns that one when it
  /// is another than before.
  std::optional<Quality> choose_quality(std::optional<Quality> wanted, float frame_ms);
  void set_view_radius(std::optional<float> metres);
  float view_radius_m() const { return chosen_radius_m_.value_or(traits_of(quality_).view_radius_m); }
  /// As far as terrain and pieces are followed: where a quality draws less, edits reach farther.
  static float interest_radius_m(std::optional<float> chosen_m, Quality quality);
  /// Whether breaks, blows and merges raise dust; not any more: it is gone at once.
  void show_particles(bool on);
  /// Whether grass, bushes and stones lie about, where the quality has them.
  void show_details(bool on);
  /// Whether blows shake the eye of a picture that is drawn by shaken_camera().
  void shake(bool on);
  Camera shaken_camera(double now_s) const { return shake_.of(camera, now_s); }
  /// Whether everything around the camera has arrived and is shown.
  bool joined(double now_s) const { return view->methods().loaded() && session.joined(now_s); }

  std::unique_ptr<Trace> trace;  ///< null: no trace
  ViewerSession session;
  std::unique_ptr<View> view;
  Camera camera;

 private:
  void stand_at_spawn();
  void follow_pieces(const SessionStep& step, double now_s);

  ToolPreview preview_;
  PieceEventDetector piece_events_;
  Dust dust_;
  std::vector<PieceEvent> events_;
  std::deque<ChannelData> heard_;
  bool hears_ = false;  ///< drain_heard() is called
  bool listens_ = false;
  bool particles_;
  bool details_;
  Shake shake_;
  bool shakes_ = false;
  Quality quality_;
  AutoQuality auto_quality_;
  std::optional<float> chosen_radius_m_;
  std::optional<float> render_scale_;
  bool stands_ =
      false;  ///< the camera is where somebody wanted it, or where the first world's visitors begin
};

}  // namespace scree
