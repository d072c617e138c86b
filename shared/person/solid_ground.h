// The field, and posed pieces and props, as what stands in a walker's way. It uses + − × ÷ and sqrt
// alone: the same field and solids, added in the same order, give the same bits.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/piece.h"
#include "shared/person/walker.h"
#include "shared/prop/prop.h"

namespace scree {

class SolidGround final : public WalkGround {
 public:
  /// For steps about that place, metres. The field, and what is added, must outlive it and stay as they are.
  SolidGround(const Field& field, glm::vec3 about_m);

  /// Adds a solid, if it is near. Pieces come first, then props, each in order of their ids.
  void add(const Volume& piece, const Pose& pose);
  void add(const Prop& prop, const Pose& pose);

  Touch rock(glm::vec3 place_m) override;
  Touch loose(glm::vec3 place_m) override;

 private:
  struct NearPiece {
    const Volume* volume = nullptr;
    Pose pose;
    float reach_m = 0.0F;  ///< from the pose's place; beyond is air
  };
  /// A convex part in the prop's own axes, with a radius about its points.
  struct NearPart {
    std::vector<glm::dvec3> points_m;
    double radius_m = 0.0;
    Pose pose;
  };

  Touch touch_of_part(const NearPart& part, glm::vec3 place_m) const;

  const Field& field_;
  glm::vec3 about_m_;
  float voxel_m_;
  std::vector<NearPiece> pieces_;
  std::vector<NearPart> parts_;
};

}  // namespace scree
