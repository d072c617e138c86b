#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/colliders/body_points.h"
#include "server/colliders/limits.h"
#include "server/colliders/nearby_codes.h"
#include "server/colliders/point_bricks.h"
#include "server/colliders/terrain_collider.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// A shorter gradient has no direction: the codes saturate all around. The contact's normal is then up.
constexpr float gradient_min = 0.1F;

/// A contact of a point, or none.
void list_contact(int point, glm::vec3 offset_m, const FieldSample& at, float voxel_size_m, float reach_m,
                  std::vector<TerrainContact>& out) {
  CHECK_DEBUG(at.distance_voxels >= -1.01F * band_voxels);
  const float distance_m = at.distance_voxels * voxel_size_m;
  if (distance_m >= reach_m) return;
  const float slope = std::sqrt(glm::dot(at.gradient, at.gradient));
  if (slope < gradient_min) {
    if (distance_m < 0.0F) out.push_back({point, offset_m, glm::vec3(0.0F, 1.0F, 0.0F), distance_m});
    return;
  }
  out.push_back({point, offset_m, at.gradient / slope, distance_m});
}

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
    for (int point = 0; point < points_.count(); ++point) {
      const glm::vec3 offset_m = points_.offset_m(point);
      list_contact(point, offset_m, sample_covered(codes_.codes(), (position_m_ + offset_m) / voxel_size_m_),
                   voxel_size_m_, reach_m_, out);
    }
  }

  void terrain_changed(const VoxelBox& box) override { codes_.terrain_changed(box); }

 private:
  glm::vec3 lo() const { return points_.lo_m() / voxel_size_m_; }
  glm::vec3 hi() const { return points_.hi_m() / voxel_size_m_; }

  NearbyCodes codes_;
  float voxel_size_m_;
  BodyPoints points_;
  glm::vec3 position_m_{0.0F};  ///< of the last turn()
  float reach_m_ = 0.0F;
};

/// The same of a large body, to the last bit.
class LargeFieldProbe final : public TerrainProbe {
 public:
  LargeFieldProbe(const Field& field, std::vector<glm::vec3> points_m)
      : bricks_(field), voxel_size_m_(field.source().voxel_size_m), points_(std::move(points_m)) {}

  bool turn(const Pose& pose, float reach_m) override {
    points_.turn(pose);
    position_m_ = pose.position_m;
    reach_m_ = reach_m;
    for (int point = 0; point < points_.count(); ++point)
      if (!bricks_.has(place(point))) return false;
    return true;
  }

  void copy_terrain() override {
    bricks_.make_room();
    for (int point = 0; point < points_.count(); ++point) bricks_.add(place(point));
  }

  void list(std::vector<TerrainContact>& out) const override {
    for (int point = 0; point < points_.count(); ++point)
      list_contact(point, points_.offset_m(point), bricks_.sample(place(point)), voxel_size_m_, reach_m_,
                   out);
  }

  void terrain_changed(const VoxelBox& box) override { bricks_.terrain_changed(box); }

 private:
  glm::vec3 place(int point) const { return (position_m_ + points_.offset_m(point)) / voxel_size_m_; }

  PointBricks bricks_;
  float voxel_size_m_;
  BodyPoints points_;
  glm::vec3 position_m_{0.0F};  ///< of the last turn()
  float reach_m_ = 0.0F;
};

/// Whether a copy of all around the points would be large, however they are turned.
bool are_far_apart(const std::vector<glm::vec3>& points_m, float voxel_size_m) {
  float reach2_m = 0.0F;
  for (const glm::vec3& p : points_m) reach2_m = std::max(reach2_m, glm::dot(p, p));
  const float side = 2.0F * std::sqrt(reach2_m) / voxel_size_m;
  return side * side * side > static_cast<float>(limits::probe_window_voxels_max);
}

class FieldCollider final : public TerrainCollider {
 public:
  explicit FieldCollider(const Field& field) : field_(field) {}

  std::unique_ptr<TerrainProbe> attach(std::vector<glm::vec3> points_m) override {
    if (are_far_apart(points_m, field_.source().voxel_size_m))
      return std::make_unique<LargeFieldProbe>(field_, std::move(points_m));
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
