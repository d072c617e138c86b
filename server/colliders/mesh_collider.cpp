#include <algorithm>

#include "server/colliders/body_points.h"
#include "server/colliders/limits.h"
#include "server/colliders/nearby_codes.h"
#include "server/colliders/nearest_triangle.h"
#include "server/colliders/terrain_collider.h"
#include "shared/surface/surface_nets.h"

namespace scree {

namespace {

class MeshProbe final : public TerrainProbe {
 public:
  MeshProbe(TerrainMesh& mesh, float voxel_size_m, std::vector<glm::vec3> points_m)
      : mesh_(mesh), voxel_size_m_(voxel_size_m), points_(std::move(points_m)) {}

  void find(const Pose& pose, float reach_m, std::vector<TerrainContact>& out) override {
    points_.turn(pose);
    const float reach = std::max(reach_m / voxel_size_m_, limits::mesh_depth_voxels);
    look(points_.lo_m() / voxel_size_m_ - reach, points_.hi_m() / voxel_size_m_ + reach);
    if (triangles_.empty()) return;
    for (int point = 0; point < points_.count(); ++point) {
      const glm::vec3 offset_m = points_.offset_m(point);
      const auto nearest = triangles_.nearest((pose.position_m + offset_m) / voxel_size_m_, reach);
      if (!nearest || nearest->distance < -limits::mesh_depth_voxels) continue;
      const float distance_m = nearest->distance * voxel_size_m_;
      if (distance_m < reach_m) out.push_back({point, offset_m, nearest->normal, distance_m});
    }
  }

  void terrain_changed(const VoxelBox& box) override {
    // A triangle depends on codes up to surface_nets_apron voxels away.
    if (overlap(box.grown(surface_nets_apron), triangles_.box())) triangles_ = TriangleBins();
  }

 private:
  /// Makes triangles_ cover the bounds.
  void look(glm::vec3 lo, glm::vec3 hi) {
    const VoxelBox bounds = box_around(lo, hi);
    const VoxelBox& box = triangles_.box();
    if (bounds.lo.x >= box.lo.x && bounds.lo.y >= box.lo.y && bounds.lo.z >= box.lo.z &&
        bounds.hi.x <= box.hi.x && bounds.hi.y <= box.hi.y && bounds.hi.z <= box.hi.z)
      return;
    const VoxelBox wider = bounds.grown(limits::probe_slack_voxels);
    triangles_ = TriangleBins(mesh_.near(wider), wider);
  }

  TerrainMesh& mesh_;
  float voxel_size_m_;
  BodyPoints points_;
  TriangleBins triangles_;
};

class MeshCollider final : public TerrainCollider {
 public:
  explicit MeshCollider(Field& field) : mesh_(field), voxel_size_m_(field.source().voxel_size_m) {}

  std::unique_ptr<TerrainProbe> attach(std::vector<glm::vec3> points_m) override {
    return std::make_unique<MeshProbe>(mesh_, voxel_size_m_, std::move(points_m));
  }
  void terrain_changed(const VoxelBox& box) override { mesh_.terrain_changed(box); }

 private:
  TerrainMesh mesh_;
  float voxel_size_m_;
};

}  // namespace

std::unique_ptr<TerrainCollider> make_mesh_collider(Field& field) {
  return std::make_unique<MeshCollider>(field);
}

}  // namespace scree
