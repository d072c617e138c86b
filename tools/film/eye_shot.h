// A camera that sees what a person saw who was there.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "client/render/scene/camera.h"
#include "server/store/recording_reader.h"

namespace scree {

class EyeShot {
 public:
  /// The shot by the eye of the person of that name, or of a nameless one by number or as called(), at each
  /// of these ticks, one a frame. Where the person is not there, the camera waits where it was, or where the
  /// person will come. The error names those who are there.
  static Result<EyeShot> of(const std::string& person, RecordingReader& recording,
                            std::span<const double> ticks, double frames_per_s);

  /// `time_s`: from the film's start.
  Camera at(double time_s) const;

 private:
  std::vector<Camera> frames_;
  double frames_per_s_ = 1.0;
};

}  // namespace scree
