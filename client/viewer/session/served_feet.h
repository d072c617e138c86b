// Walking in a world whose server moves persons: sends inputs, one for each of its ticks, and carries the
// camera where the person is foreseen to be.
#pragma once

#include "client/viewer/input/fly_camera.h"
#include "client/viewer/session/viewer_session.h"

namespace scree {

class ServedFeet {
 public:
  bool walks() const { return walks_; }
  /// Asks the server to be put on foot, or to fly on.
  void change(ViewerSession& session, double now_s);
  /// As in another world.
  void stop() { walks_ = false; }

  /// Turns the camera, and walks. Only while it walks.
  void step(Camera& camera, const FlyInput& input, float elapsed_s, ViewerSession& session, double now_s);

 private:
  bool walks_ = false;
  double asked_s_ = 0.0;
  float time_left_s_ = 0.0F;  ///< of a tick that has begun
  glm::vec3 before_m_{0.0F};  ///< of the eye, a tick ago
};

}  // namespace scree
