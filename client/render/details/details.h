// Grass, bushes and stones about the eye, kept and drawn. Only for the eye: depths, aiming and the server
// know nothing of them. Needs the GL context current, the destructor too.
#pragma once

#include <optional>
#include <span>

#include "client/render/details/detail_drawer.h"
#include "client/render/details/detail_field.h"
#include "shared/base/limits.h"

namespace scree {

class Details {
 public:
  /// One frame (DetailField::follow). The first range above 0 links the shaders; fails when one does not.
  Result<void> follow(const Field& field, std::span<const BrickCoord> changed, glm::vec3 eye_m, float range_m,
                      glm::vec3 sun);
  /// What stands lower is not drawn: it is under water.
  void set_floor(float floor_m) { floor_m_ = floor_m; }
  void forget() { field_.forget(); }
  bool settled() const { return field_.settled(); }
  bool empty() const { return field_.count() == 0; }
  void draw(const DrawPass& pass);

 private:
  DetailField field_;
  std::optional<DetailDrawer> drawer_;
  DetailLists lists_;  ///< of one pass
  float floor_m_ = -limits::world_half_height_m;
};

}  // namespace scree
