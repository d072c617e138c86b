#include "client/viewer/session/sight.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace scree {

size_t pieces_in_sight(const Scene& scene, const Camera& camera, float aspect, float view_radius_m) {
  const Frustum frustum(camera.projection(aspect, view_radius_m) * camera.view());
  const float voxel_m = scene.field.source().voxel_size_m;
  const auto hidden = [&](glm::vec3 place_m) {
    const glm::vec3 way = place_m - camera.eye_m;
    const float far_m = glm::length(way);
    if (far_m < voxel_m) return false;
    // The last voxels do not count: there the piece may touch the rock that it came from.
    const float reach = far_m / voxel_m - 2.0F;
    return trace(scene.field, camera.eye_m / voxel_m, way / far_m, reach).has_value();
  };
  return static_cast<size_t>(std::ranges::count_if(scene.pieces, [&](const auto& entry) {
    const glm::vec3 place_m = entry.second.pose.position_m;
    return frustum.touches(place_m, 0.0F) && !hidden(place_m);
  }));
}

}  // namespace scree
