// The offscreen flight along --path, and its results: pictures (--frames), times (--timedemo).
// Each frame is a fixed step of the path, however long it takes to draw. Needs the GL context current.
#pragma once

#include "client/viewer/pictures/camera_path.h"
#include "client/viewer/pictures/frame_times.h"
#include "client/viewer/viewing/viewing.h"

namespace scree {

class Flight {
 public:
  explicit Flight(const CameraPath& path) : path_(path) {}

  /// One turn: steps the session, and draws the frame. A frame for a picture waits until everything around it
  /// is loaded; a timed frame does not wait. True when the frame is done.
  Result<bool> turn(Viewing& viewing, double now_s);
  bool over(const ViewerOptions& options) const;
  /// Drawn so far.
  size_t frames() const { return frame_; }

  /// One line of JSON (frame_times.h). The times of a flight that is over.
  std::string times(const Viewing& viewing) const;

 private:
  const CameraPath& path_;
  size_t frame_ = 0;  ///< the next
  std::vector<FrameTime> times_;
};

}  // namespace scree
