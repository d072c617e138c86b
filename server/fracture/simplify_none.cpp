// The simplifier `none`: all points, up to a limit.
#include "server/fracture/hull_corners.h"
#include "server/fracture/point_spread.h"
#include "server/fracture/simplify.h"

namespace scree {

std::vector<glm::vec3> choose_all(const std::vector<glm::vec3>& surface) {
  constexpr float least_spacing_voxels = 0.5F;
  return if_thick(
      surface.size() <= whole_points_max ? surface : spread(surface, least_spacing_voxels, whole_points_max));
}

}  // namespace scree
