#include <algorithm>
#include <array>
#include <cmath>

#include "server/colliders/body_points.h"
#include "server/colliders/limits.h"
#include "server/colliders/nearby_codes.h"
#include "server/colliders/terrain_collider.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr int side = limits::rays_side;
static_assert(side >= 2, "the ground is interpolated between rays");

/// Shortest step of a ray, voxels: near the surface the distances are small.
constexpr float step_min = 0.25F;

/// The ground under a body: heights where its rays met rock, over a square grid, voxels. Between four rays it
/// is bilinear: the paper's loose mesh.
struct LooseGround {
  glm::vec3 corner{0.0F};  ///< lowest x and z; y: the lower end of the rays
  float cell_x = 1.0F;
  float cell_z = 1.0F;
  std::array<std::array<float, side>, side> height{};
  bool any = false;  ///< at least one ray met rock

  struct At {
    float height;
    glm::vec3 normal;
    bool known;  ///< at least one of the four rays around met rock
  };
  At at(float x, float z) const {
    CHECK_DEBUG(cell_x > 0.0F && cell_z > 0.0F);
    const auto place = [](float offset, float cell) {
      return std::clamp(offset / cell, 0.0F, static_cast<float>(side - 1));
    };
    const float gx = place(x - corner.x, cell_x), gz = place(z - corner.z, cell_z);
    const auto i = static_cast<size_t>(std::min(static_cast<int>(gx), side - 2));
    const auto k = static_cast<size_t>(std::min(static_cast<int>(gz), side - 2));
    const float fx = gx - static_cast<float>(i), fz = gz - static_cast<float>(k);
    const float h00 = height[i][k], h01 = height[i][k + 1], h10 = height[i + 1][k],
                h11 = height[i + 1][k + 1];
    const float low = h00 + (h01 - h00) * fz, high = h10 + (h11 - h10) * fz;
    const float slope_x = (high - low) / cell_x;
    const float slope_z = ((h01 - h00) * (1.0F - fx) + (h11 - h10) * fx) / cell_z;
    const float length = std::sqrt(slope_x * slope_x + slope_z * slope_z + 1.0F);
    const float highest = std::max({h00, h01, h10, h11});
    return {low + (high - low) * fx, glm::vec3(-slope_x, 1.0F, -slope_z) / length, highest > corner.y};
  }
};

class RaysProbe final : public TerrainProbe {
 public:
  RaysProbe(Field& field, std::vector<glm::vec3> points_m)
      : codes_(field), voxel_size_m_(field.source().voxel_size_m), points_(std::move(points_m)) {}

  void find(const Pose& pose, float reach_m, std::vector<TerrainContact>& out) override {
    points_.turn(pose);
    const LooseGround ground = cast(pose, reach_m / voxel_size_m_);
    if (!ground.any) return;
    for (int point = 0; point < points_.count(); ++point) {
      const glm::vec3 offset_m = points_.offset_m(point);
      const glm::vec3 p = (pose.position_m + offset_m) / voxel_size_m_;
      const LooseGround::At below = ground.at(p.x, p.z);
      const float distance_m = (p.y - below.height) * below.normal.y * voxel_size_m_;
      if (below.known && distance_m < reach_m) out.push_back({point, offset_m, below.normal, distance_m});
    }
  }

  void terrain_changed(const VoxelBox& box) override { codes_.terrain_changed(box); }

 private:
  /// Casts rays vertically down from the height of the body's centre, over its whole footprint.
  LooseGround cast(const Pose& pose, float reach) {
    const glm::vec3 lo = points_.lo_m() / voxel_size_m_, hi = points_.hi_m() / voxel_size_m_;
    const float top = pose.position_m.y / voxel_size_m_;
    LooseGround ground;
    ground.corner = {lo.x, lo.y - reach - 1.0F, lo.z};
    ground.cell_x = std::max((hi.x - lo.x) / static_cast<float>(side - 1), step_min);
    ground.cell_z = std::max((hi.z - lo.z) / static_cast<float>(side - 1), step_min);
    const glm::vec3 far_end(std::max(hi.x, lo.x + step_min * side), top,
                            std::max(hi.z, lo.z + step_min * side));
    codes_.look(ground.corner, far_end);
    if (codes_.all_air()) return ground;
    for (int i = 0; i < side; ++i)
      for (int k = 0; k < side; ++k) {
        const glm::vec3 from(lo.x + ground.cell_x * static_cast<float>(i), top,
                             lo.z + ground.cell_z * static_cast<float>(k));
        const float met = fall(from, ground.corner.y);
        CHECK_DEBUG(met >= ground.corner.y);
        ground.height[static_cast<size_t>(i)][static_cast<size_t>(k)] = met;
        ground.any = ground.any || met > ground.corner.y;
      }
    return ground;
  }

  /// Height at which a vertical ray meets rock: its start, if that is in rock; `end`, if it meets none above
  /// `end`.
  float fall(glm::vec3 from, float end) const {
    glm::vec3 p = from;
    float before = 0.0F, step = 0.0F;
    for (;;) {
      const float distance = sample_covered(codes_.codes(), p).distance_voxels;
      if (distance <= 0.0F) return step == 0.0F ? from.y : p.y + step * (-distance / (before - distance));
      before = distance;
      step = std::max(distance, step_min);
      if (p.y - step <= end) return end;
      p.y -= step;
    }
  }

  NearbyCodes codes_;
  float voxel_size_m_;
  BodyPoints points_;
};

class RaysCollider final : public TerrainCollider {
 public:
  explicit RaysCollider(Field& field) : field_(field) {}

  std::unique_ptr<TerrainProbe> attach(std::vector<glm::vec3> points_m) override {
    return std::make_unique<RaysProbe>(field_, std::move(points_m));
  }
  void terrain_changed(const VoxelBox& /*box*/) override {}

 private:
  Field& field_;
};

}  // namespace

std::unique_ptr<TerrainCollider> make_rays_collider(Field& field) {
  return std::make_unique<RaysCollider>(field);
}

}  // namespace scree
