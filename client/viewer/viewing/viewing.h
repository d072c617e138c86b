// The common part of a window and of offscreen drawing: a session, its view, the camera, and the ordered
// pictures. Needs the GL context current.
#pragma once

#include <memory>
#include <optional>

#include "client/viewer/events/dust.h"
#include "client/viewer/events/piece_watch.h"
#include "client/viewer/session/overlay.h"
#include "client/viewer/session/view.h"
#include "client/viewer/session/viewer_session.h"
#include "client/viewer/sound/sounds.h"
#include "client/viewer/viewing/options.h"
#include "shared/base/trace.h"

namespace scree {

class Viewing {
 public:
  /// `options` must outlive it.
  static Result<std::unique_ptr<Viewing>> begin(const ViewerOptions& options);

  /// Takes in messages, begins work and shows finished work. With --gl-debug, a GL error is an error.
  Result<void> step(double now_s);
  /// Takes the screenshots that are due.
  Result<void> take_due(double now_s);
  /// The picture of this moment, of --size or of so many pixels; with --overlay, all of the overlay in it.
  Result<Image> picture(double now_s) { return picture(now_s, options.width, options.height); }
  Result<Image> picture(double now_s, int width, int height);
  /// Adds the chosen overlay's lines, and switches the server's PhysicsMessages accordingly.
  void add_overlay(LineList& lines, const OverlayChoice& choice, double now_s);
  /// Writes the trace, and ends the file of sound, if they were asked for.
  Result<void> finish();
  /// Draws by that preset, but for what options say themselves.
  void use(Quality quality);
  Quality quality() const { return quality_; }
  /// Whether breaks, blows and merges raise dust; not any more: it is gone at once.
  void show_particles(bool on);
  float view_radius_m() const;
  /// Whether everything around the camera has arrived and is shown.
  bool joined(double now_s);

  const ViewerOptions& options;
  std::unique_ptr<Trace> trace;  ///< null: no trace
  ViewerSession session;
  std::unique_ptr<View> view;
  Camera camera;
  ScreenshotQueue screenshots;
  /// Of the picture compared with --reference.
  std::optional<double> difference;

 private:
  Viewing(const ViewerOptions& options, Quality quality, std::unique_ptr<View> view, Sounds sounds);
  Moment moment(double now_s);
  Result<void> take(const ScreenshotOrder& order, double now_s);
  Result<void> check_gl_errors();
  void stand_on_ground();
  void follow_pieces(double now_s);

  Sounds sounds_;
  PieceWatch watch_;
  Dust dust_;
  bool particles_;
  Quality quality_;
  bool stands_ = false;  ///< the camera was placed by the first world's ground
};

}  // namespace scree
