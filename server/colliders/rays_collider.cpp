#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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
  RaysProbe(const Field& field, std::vector<glm::vec3> points_m)
      : codes_(field), voxel_size_m_(field.source().voxel_size_m), points_(std::move(points_m)) {}

  bool turn(const Pose& pose, float reach_m) override {
    points_.turn(pose);
    position_m_ = pose.position_m;
    reach_m_ = reach_m;
    const auto [lo, hi] = cast_bounds();
    return codes_.has(lo, hi);
  }

  void copy_terrain() override {
    const auto [lo, hi] = cast_bounds();
    codes_.copy_around(lo, hi);
  }

  void list(std::vector<TerrainContact>& out) const override {
    if (codes_.all_air()) return;
    const LooseGround ground = cast();
    if (!ground.any) return;
    for (int point = 0; point < points_.count(); ++point) {
      const glm::vec3 offset_m = points_.offset_m(point);
      const glm::vec3 p = (position_m_ + offset_m) / voxel_size_m_;
      const LooseGround::At below = ground.at(p.x, p.z);
      const float distance_m = (p.y - below.height) * below.normal.y * voxel_size_m_;
      if (below.known && distance_m < reach_m_) out.push_back({point, offset_m, below.normal, distance_m});
    }
  }

  void terrain_changed(const VoxelBox& box) override { codes_.terrain_changed(box); }

 private:
  /// Two corners of a box around all that the rays may read.
  std::pair<glm::vec3, glm::vec3> cast_bounds() const {
    const glm::vec3 lo = points_.lo_m() / voxel_size_m_, hi = points_.hi_m() / voxel_size_m_;
    return {{lo.x, lo.y - reach_m_ / voxel_size_m_ - 1.0F, lo.z},
            {std::max(hi.x, lo.x + step_min * side), position_m_.y / voxel_size_m_,
             std::max(hi.z, lo.z + step_min * side)}};
  }

  /// Casts rays vertically down from the height of the body's centre, over its whole footprint.
  LooseGround cast() const {
    const glm::vec3 lo = points_.lo_m() / voxel_size_m_, hi = points_.hi_m() / voxel_size_m_;
    const float top = position_m_.y / voxel_size_m_;
    LooseGround ground;
    ground.corner = cast_bounds().first;
    ground.cell_x = std::max((hi.x - lo.x) / static_cast<float>(side - 1), step_min);
    ground.cell_z = std::max((hi.z - lo.z) / static_cast<float>(side - 1), step_min);
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
  glm::vec3 position_m_{0.0F};  ///< of the last turn()
  float reach_m_ = 0.0F;
};

class RaysCollider final : public TerrainCollider {
 public:
  explicit RaysCollider(const Field& field) : field_(field) {}

  std::unique_ptr<TerrainProbe> attach(std::vector<glm::vec3> points_m) override {
    return std::make_unique<RaysProbe>(field_, std::move(points_m));
  }
  void terrain_changed(const VoxelBox& /*box*/) override {}

 private:
  const Field& field_;
};

}  // namespace

std::unique_ptr<TerrainCollider> make_rays_collider(const Field& field) {
  return std::make_unique<RaysCollider>(field);
}

}  // namespace scree
