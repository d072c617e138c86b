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

  bool turn(const Pose& pose, float reach_m) override {
    points_.turn(pose);
    position_m_ = pose.position_m;
    reach_m_ = reach_m;
    reach_ = std::max(reach_m / voxel_size_m_, limits::mesh_depth_voxels);
    const VoxelBox needed = bounds();
    const VoxelBox& box = triangles_.box();
    return needed.lo.x >= box.lo.x && needed.lo.y >= box.lo.y && needed.lo.z >= box.lo.z &&
           needed.hi.x <= box.hi.x && needed.hi.y <= box.hi.y && needed.hi.z <= box.hi.z;
  }

  void copy_terrain() override {
    const VoxelBox wider = bounds().grown(limits::probe_slack_voxels);
    triangles_ = TriangleBins(mesh_.near(wider), wider);
  }

  void list(std::vector<TerrainContact>& out) const override {
    if (triangles_.empty()) return;
    for (int point = 0; point < points_.count(); ++point) {
      const glm::vec3 offset_m = points_.offset_m(point);
      const auto nearest = triangles_.nearest((position_m_ + offset_m) / voxel_size_m_, reach_);
      if (!nearest || nearest->distance < -limits::mesh_depth_voxels) continue;
      const float distance_m = nearest->distance * voxel_size_m_;
      if (distance_m < reach_m_) out.push_back({point, offset_m, nearest->normal, distance_m});
    }
  }

  void terrain_changed(const VoxelBox& box) override {
    // A triangle depends on codes up to surface_nets_apron voxels away.
    if (overlap(box.grown(surface_nets_apron), triangles_.box())) triangles_ = TriangleBins();
  }

 private:
  VoxelBox bounds() const {
    return box_around(points_.lo_m() / voxel_size_m_ - reach_, points_.hi_m() / voxel_size_m_ + reach_);
  }

  TerrainMesh& mesh_;
  float voxel_size_m_;
  BodyPoints points_;
  TriangleBins triangles_;
  glm::vec3 position_m_{0.0F};  ///< of the last turn()
  float reach_m_ = 0.0F;
  float reach_ = 0.0F;  ///< voxels; at least as far as triangles are looked for behind the surface
};

class MeshCollider final : public TerrainCollider {
 public:
  explicit MeshCollider(const Field& field) : mesh_(field), voxel_size_m_(field.source().voxel_size_m) {}

  std::unique_ptr<TerrainProbe> attach(std::vector<glm::vec3> points_m) override {
    return std::make_unique<MeshProbe>(mesh_, voxel_size_m_, std::move(points_m));
  }
  void terrain_changed(const VoxelBox& box) override { mesh_.terrain_changed(box); }

 private:
  TerrainMesh mesh_;
  float voxel_size_m_;
};

}  // namespace

std::unique_ptr<TerrainCollider> make_mesh_collider(const Field& field) {
  return std::make_unique<MeshCollider>(field);
}

}  // namespace scree
