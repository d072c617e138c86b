// Walking instead of flying: carries a camera on a walker's shoulders.
#pragma once

#include <optional>

#include "client/render/scene/draw_method.h"
#include "client/viewer/input/fly_camera.h"
#include "client/viewer/input/walker.h"

namespace scree {

class OnFoot {
 public:
  bool walks() const { return walker_.has_value(); }
  /// Begins to walk where the camera is, or flies on from there.
  void change(const Camera& camera);
  /// Flies, as in another world, until change().
  void stop() { walker_.reset(); }

  /// Turns the camera, and moves it as far as the scene lets it go; input upwards is a jump. Only while it
  /// walks.
  void step(Camera& camera, const FlyInput& input, float elapsed_s, const Scene& scene);

 private:
  std::optional<Walker> walker_;
};

}  // namespace scree
