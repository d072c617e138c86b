// The field and the posed pieces as what stands in a walker's way.
#pragma once

#include <utility>
#include <vector>

#include "client/render/scene/draw_method.h"
#include "client/viewer/input/walker.h"

namespace scree {

class SolidGround final : public WalkGround {
 public:
  /// For steps about that place, metres; looks at the pieces near it alone. `scene` must outlive it and stay
  /// as it is.
  SolidGround(const Scene& scene, glm::vec3 about_m);

  Touch rock(glm::vec3 place_m) override;
  Touch loose(glm::vec3 place_m) override;

 private:
  const Field& field_;
  float voxel_m_;
  std::vector<const ScenePiece*> near_;
};

}  // namespace scree
