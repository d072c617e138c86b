// The parts of a prop as solids: how they weigh, how they collide, and how they are drawn. Deterministic:
// + − × ÷ and sqrt alone. Metres, in the prop's axes. Props must have passed validate().
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/prop/prop.h"

namespace scree {

/// Volume, its middle, and the tensor of inertia about that of a mass of 1 kg a cubic metre. Where parts
/// overlap, both count.
struct PropMeasure {
  float volume_m3 = 0.0F;
  glm::vec3 middle_m{0.0F};
  glm::mat3 inertia_m5{0.0F};
};
PropMeasure measure_of(const Prop& prop);
/// The part of validate() that costs next to nothing: all but measure_checked().
Result<void> validate_bounds(const Prop& prop);
/// The same as measure_of(), and the rest of validate() for a prop that has passed validate_bounds(): refuses
/// hulls without volume, and what is too thin to be turned. Faces of hulls are searched once.
Result<PropMeasure> measure_checked(const Prop& prop);

/// A convex solid: the hull of its points, grown by a ball of that radius. A cylinder is a prism of 24 sides.
struct RoundedHull {
  std::vector<glm::vec3> points_m;
  float radius_m = 0.0F;
};
RoundedHull rounded_hull_of(const PropPart& part);

/// Points of a part's surface, whose hull is the part, about: of its round sides as many as it takes.
std::vector<glm::vec3> outline_of(const PropPart& part);

/// A part's surface as triangles, three corners each, counterclockwise as seen from outside, with a normal
/// for each corner.
struct PropMesh {
  std::vector<glm::vec3> corners_m;
  std::vector<glm::vec3> normals;
};
PropMesh mesh_of(const PropPart& part);

/// The farthest that any of its points lies from its origin.
float reach_of(const Prop& prop);

}  // namespace scree
