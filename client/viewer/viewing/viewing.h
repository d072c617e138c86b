// What a window and offscreen drawing have in common: a session, what is drawn of it, where the camera is,
// and the pictures that were ordered. Needs the GL context current.
#pragma once

#include <memory>
#include <optional>

#include "client/viewer/session/overlay.h"
#include "client/viewer/session/view.h"
#include "client/viewer/session/viewer_session.h"
#include "client/viewer/viewing/options.h"
#include "shared/base/trace.h"

namespace scree {

class Viewing {
 public:
  /// `options` must outlive it.
  static Result<std::unique_ptr<Viewing>> begin(const ViewerOptions& options);

  /// Messages come in, work begins and is shown. An error of GL's, where asked for, is an error.
  Result<void> step(double now_s);
  /// Takes the screenshots whose moment has come.
  Result<void> take_due(double now_s);
  /// The picture of this moment; with --overlay, all of the overlay in it.
  Result<Image> picture(double now_s);
  /// What the choice shows; asks the server for it, or no more.
  void add_overlay(LineList& lines, const OverlayChoice& choice, double now_s);
  /// Writes the trace, if one was asked for.
  Result<void> finish();
  /// All around the camera has arrived and is shown.
  bool joined(double now_s);

  const ViewerOptions& options;
  std::unique_ptr<Trace> trace;  ///< null: not asked for
  ViewerSession session;
  std::unique_ptr<View> view;
  Camera camera;
  ScreenshotQueue screenshots;
  /// Of the picture compared with --reference.
  std::optional<double> difference;

 private:
  Viewing(const ViewerOptions& options, std::unique_ptr<View> view);
  Moment moment(double now_s);
  Result<void> take(const ScreenshotOrder& order, double now_s);
  Result<void> check_gl_errors();
};

}  // namespace scree
