#include "shared/prop/model_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

namespace scree {

Result<ModelMesh> checked_model(std::vector<ModelVertex> vertices, std::vector<uint32_t> corners) {
  if (corners.empty() || corners.size() % 3 != 0) return fail("the model has no whole triangles");
  if (vertices.size() > limits::model_vertices_max)
    return fail("the model has more than " + std::to_string(limits::model_vertices_max) +
                " vertices (limits.model_vertices_max)");
  if (corners.size() / 3 > limits::model_triangles_max)
    return fail("the model has more than " + std::to_string(limits::model_triangles_max) +
                " triangles (limits.model_triangles_max)");
  for (const uint32_t corner : corners)
    if (corner >= vertices.size()) return fail("the model has a triangle without its vertices");
  float farthest_m2 = 0.0F;
  for (const ModelVertex& vertex : vertices) {
    const float away_m2 = glm::dot(vertex.place_m, vertex.place_m);
    // No number fails the comparison, too.
    if (!(away_m2 <= limits::model_reach_max_m * limits::model_reach_max_m))
      return fail("the model reaches farther than " +
                  std::to_string(static_cast<int>(limits::model_reach_max_m)) +
                  " m from its origin (limits.model_reach_max_m)");
    farthest_m2 = std::max(farthest_m2, away_m2);
  }
  return ModelMesh{std::move(vertices), std::move(corners), std::sqrt(farthest_m2)};
}

}  // namespace scree
