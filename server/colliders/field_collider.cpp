#include <cmath>
#include <glm/geometric.hpp>

#include "server/colliders/body_points.h"
#include "server/colliders/nearby_codes.h"
#include "server/colliders/terrain_collider.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// A shorter gradient has no direction: the codes saturate all around. The contact's normal is then up.
constexpr float gradient_min = 0.1F;

class FieldProbe final : public TerrainProbe {
 public:
  FieldProbe(const Field& field, std::vector<glm::vec3> points_m)
      : codes_(field), voxel_size_m_(field.source().voxel_size_m), points_(std::move(points_m)) {}

  bool turn(const Pose& pose, float reach_m) override {
    points_.turn(pose);
    position_m_ = pose.position_m;
    reach_m_ = reach_m;
    return codes_.has(lo(), hi());
  }

  void copy_terrain() override { codes_.copy_around(lo(), hi()); }

  void list(std::vector<TerrainContact>& out) const override {
    if (codes_.all_air()) return;
    for (int point = 0; point < points_.count(); ++point) test(point, out);
  }

  void terrain_changed(const VoxelBox& box) override { codes_.terrain_changed(box); }

 private:
  glm::vec3 lo() const { return points_.lo_m() / voxel_size_m_; }
  glm::vec3 hi() const { return points_.hi_m() / voxel_size_m_; }

  void test(int point, std::vector<TerrainContact>& out) const {
    const glm::vec3 offset_m = points_.offset_m(point);
    const FieldSample at = sample_covered(codes_.codes(), (position_m_ + offset_m) / voxel_size_m_);
    CHECK_DEBUG(at.distance_voxels >= -1.01F * band_voxels);
    const float distance_m = at.distance_voxels * voxel_size_m_;
    if (distance_m >= reach_m_) return;
    const float slope = std::sqrt(glm::dot(at.gradient, at.gradient));
    if (slope < gradient_min) {
      if (distance_m < 0.0F) out.push_back({point, offset_m, glm::vec3(0.0F, 1.0F, 0.0F), distance_m});
      return;
    }
    out.push_back({point, offset_m, at.gradient / slope, distance_m});
  }

  NearbyCodes codes_;
  float voxel_size_m_;
  BodyPoints points_;
  glm::vec3 position_m_{0.0F};  ///< of the last turn()
  float reach_m_ = 0.0F;
};

class FieldCollider final : public TerrainCollider {
 public:
  explicit FieldCollider(const Field& field) : field_(field) {}

  std::unique_ptr<TerrainProbe> attach(std::vector<glm::vec3> points_m) override {
    return std::make_unique<FieldProbe>(field_, std::move(points_m));
  }
  void terrain_changed(const VoxelBox& /*box*/) override {}

 private:
  const Field& field_;
};

}  // namespace

std::unique_ptr<TerrainCollider> make_field_collider(const Field& field) {
  return std::make_unique<FieldCollider>(field);
}

}  // namespace scree
