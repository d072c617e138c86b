// The common part of a window and of offscreen drawing: a visit by the options, with sound and the ordered
// pictures. Needs the GL context current.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client/viewer/signs/sign_painter.h"
#include "client/viewer/sound/sounds.h"
#include "client/viewer/viewing/options.h"
#include "client/viewer/viewing/visit.h"

namespace scree {

class Viewing : public Visit {
 public:
  /// `options` must outlive it.
  static Result<std::unique_ptr<Viewing>> begin(const ViewerOptions& options);

  /// As a visit; what happens is heard, and with --gl-debug a GL error is an error.
  Result<void> step(double now_s);
  /// What happens is heard by the device, if there is one, or not any more. To a file it goes in any case.
  void play_sound(bool on);
  /// Takes the screenshots that are due.
  Result<void> shoot_due(double now_s);
  /// The picture of this moment, of --size or of so many pixels, with a game's signs; with --overlay, all of
  /// the overlay in it.
  Result<Image> picture(double now_s) { return picture(now_s, options.width, options.height); }
  Result<Image> picture(double now_s, int width, int height);
  /// Writes the trace, and ends the file of sound, if they were asked for.
  Result<void> finish();

  const ViewerOptions& options;
  ScreenshotQueue screenshots;
  /// The difference of the picture to --reference.
  std::optional<double> difference;

 private:
  Viewing(const ViewerOptions& options, Quality quality, std::unique_ptr<View> view, Sounds sounds);
  Moment moment(double now_s);
  Result<void> shoot(const ScreenshotOrder& order, double now_s);
  Result<void> check_gl_errors();
  void tell_content_faults();

  Sounds sounds_;
  SignPainter painter_;
  std::string told_fault_;  ///< of the server's content
};

}  // namespace scree
