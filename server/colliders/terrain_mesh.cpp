#include "server/colliders/terrain_mesh.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "server/colliders/limits.h"
#include "server/colliders/nearby_codes.h"
#include "shared/base/check.h"
#include "shared/surface/surface_nets.h"

namespace scree {

namespace {

/// Side of a block, voxels: most voxels that a smaller block reads would lie around it.
constexpr int block_bits = 4;
constexpr int block_voxels = 1 << block_bits;

/// Block of a voxel, on one axis.
int block_of(int voxel) {
  return voxel >> block_bits;
}

VoxelBox box_of_block(VoxelCoord block) {
  const VoxelCoord lo{block.x * block_voxels, block.y * block_voxels, block.z * block_voxels};
  return {lo, lo + VoxelCoord{block_voxels, block_voxels, block_voxels}};
}

/// Calls `use` for every block that has a voxel of the box.
template <typename F>
void for_blocks(const VoxelBox& box, F&& use) {
  for (int x = block_of(box.lo.x); x <= block_of(box.hi.x - 1); ++x)
    for (int y = block_of(box.lo.y); y <= block_of(box.hi.y - 1); ++y)
      for (int z = block_of(box.lo.z); z <= block_of(box.hi.z - 1); ++z) use(VoxelCoord{x, y, z});
}

glm::vec3 corner_of(const SurfaceMesh& mesh, uint32_t vertex) {
  const auto& p = mesh.vertices[vertex].position;
  const glm::vec3 steps(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
  const glm::vec3 origin(static_cast<float>(mesh.origin.x), static_cast<float>(mesh.origin.y),
                         static_cast<float>(mesh.origin.z));
  return origin + steps / surface_steps_per_voxel;
}

std::vector<TerrainTriangle> triangles_of(const SurfaceMesh& mesh) {
  CHECK(mesh.indices.size() % 3 == 0);
  std::vector<TerrainTriangle> triangles;
  triangles.reserve(mesh.indices.size() / 3);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    TerrainTriangle triangle;
    for (size_t k = 0; k < 3; ++k) triangle.corners[k] = corner_of(mesh, mesh.indices[i + k]);
    const auto& [a, b, c] = triangle.corners;
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const float length = std::sqrt(glm::dot(normal, normal));
    if (!(length > 0.0F)) continue;  // no area
    triangle.normal = normal / length;
    triangles.push_back(triangle);
  }
  return triangles;
}

bool touches(const TerrainTriangle& triangle, glm::vec3 lo, glm::vec3 hi) {
  const auto& [a, b, c] = triangle.corners;
  const glm::vec3 least = glm::min(a, glm::min(b, c)), most = glm::max(a, glm::max(b, c));
  return most.x >= lo.x && least.x <= hi.x && most.y >= lo.y && least.y <= hi.y && most.z >= lo.z &&
         least.z <= hi.z;
}

glm::vec3 point_at(VoxelCoord v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

const std::vector<TerrainTriangle>& TerrainMesh::block(VoxelCoord coord) {
  const auto known = blocks_.find(coord);
  if (known != blocks_.end()) return known->second;
  if (blocks_.size() >= limits::mesh_blocks_max) blocks_.clear();
  const VoxelBox owned = box_of_block(coord);
  return blocks_[coord] = triangles_of(surface_nets(gather(field_, owned.grown(surface_nets_apron)), owned));
}

std::vector<TerrainTriangle> TerrainMesh::near(const VoxelBox& box) {
  std::vector<TerrainTriangle> found;
  const glm::vec3 lo = point_at(box.lo), hi = point_at(box.hi);
  // A block's triangles reach a voxel beyond it.
  for_blocks(box.grown(1), [&](VoxelCoord coord) {
    for (const TerrainTriangle& triangle : block(coord))
      if (touches(triangle, lo, hi)) found.push_back(triangle);
  });
  return found;
}

void TerrainMesh::terrain_changed(const VoxelBox& box) {
  for_blocks(box.grown(surface_nets_apron), [&](VoxelCoord coord) { blocks_.erase(coord); });
}

}  // namespace scree
