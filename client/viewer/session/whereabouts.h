// How a person is in the world: flies, walks, or looks through another person's eye.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "client/viewer/session/followed_eye.h"
#include "client/viewer/session/on_foot.h"
#include "client/viewer/session/served_feet.h"
#include "client/viewer/session/viewer_session.h"

namespace scree {

class Whereabouts {
 public:
  bool walks() const { return feet_.walks() || served_feet_.walks(); }
  const FollowedEye& eye() const { return eye_; }

  /// Moves the camera by the input of one frame. Who moves looks through their own eye again. `now_s`: never
  /// backwards.
  void step(Camera& camera, const FlyInput& input, float elapsed_s, ViewerSession& session, double now_s);
  /// Walks from where the camera is, or flies on; only in a world. Where the server moves persons, the walk
  /// begins where it says.
  void walk_or_fly(const Camera& camera, ViewerSession& session, double now_s);
  /// Through the next person's eye, or the own one again. False: there is nobody.
  bool follow_next_eye(ViewerSession& session, double now_s);

 private:
  void move(Camera& camera, const FlyInput& input, float elapsed_s, ViewerSession& session, double now_s);
  /// Nothing: the person is not on foot.
  std::optional<glm::vec3> feet_m(ViewerSession& session) const;

  OnFoot feet_;             ///< where the server moves nobody
  ServedFeet served_feet_;  ///< where it does
  FollowedEye eye_;
};

}  // namespace scree
