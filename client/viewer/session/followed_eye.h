// Looks through the eye of another person: of one who is in the world, or was in the recording that is
// replayed. The camera goes where that eye goes, smoothly. Time is an argument (seconds, never backwards).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "client/render/scene/camera.h"
#include "client/viewer/figures/figures.h"

namespace scree {

class FollowedEye {
 public:
  bool follows() const { return person_.has_value(); }
  /// The figure's number (Figures::all()) that is followed.
  std::optional<uint64_t> person() const { return person_; }
  /// The next person's, by number; after the last, one's own again.
  void next(const Figures& figures);
  void end() { person_.reset(); }
  /// Moves the camera; where the person is not there, it stays where it is.
  void step(Camera& camera, const Figures& figures, double now_s);
  /// For display: whose eye it is, and whether that person is there.
  std::string description(const Figures& figures) const;

 private:
  std::optional<uint64_t> person_;
  std::string name_;      ///< as last seen
  bool is_near_ = false;  ///< the camera is at the eye, and goes on smoothly
  double since_s_ = 0.0;
};

}  // namespace scree
