// What the next click with a tool would do at the aim: the shape, and how much rock it takes or puts. The
// amount is that of the server's own kernels, over the field that is drawn. Main thread only; time is an
// argument.
#pragma once

#include <optional>

#include "client/render/scene/camera.h"
#include "client/render/scene/line_list.h"
#include "client/viewer/session/viewer_session.h"

namespace scree {

/// Where a round shape meets the surface, as far as that is flat.
struct ShapeRim {
  glm::vec3 centre_m{0.0F};
  glm::vec3 normal{0.0F};
  float radius_m = 0.0F;
};

struct ToolAim {
  Shape shape;
  bool is_beyond = false;            ///< the reach, or in a closed region: refused
  std::optional<Material> material;  ///< that it puts or paints; nothing: none, or as the ground
  std::optional<ShapeRim> rim{};
  std::optional<double> volume_m3{};  ///< of rock; nothing: it moves none, or cannot
};

class ToolPreview {
 public:
  /// What a click does now; nothing: there is nothing within sight to aim at, or it is a replay.
  const std::optional<ToolAim>& step(const Tool& tool, ViewerSession& session, const Camera& camera,
                                     double now_s);
  /// As of the last step.
  const std::optional<ToolAim>& aim() const { return aim_; }
  /// Adds its outline.
  void add_to(LineList& lines, const Tool& tool, const Palette& palette) const;

 private:
  std::optional<ToolAim> aim_;
  std::optional<Shape> measured_;  ///< the shape of the last volume
  ToolUse measured_use_ = ToolUse::dig;
  std::optional<double> volume_m3_;
  double next_measure_s_ = 0.0;
};

}  // namespace scree
