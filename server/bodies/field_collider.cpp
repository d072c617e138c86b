#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "server/bodies/terrain_collider.h"
#include "shared/field/window_sample.h"

namespace scree {

namespace {

/// Voxels kept around a body beyond its bounds: it may move that far before they are gathered again.
constexpr int slack_voxels = 2;

/// Gradients shorter than this point nowhere: the codes saturate all around.
constexpr float gradient_min = 0.1F;

/// Each body keeps its own copy of the codes around it: a hash lookup a corner would cost ten times more.
class FieldProbe final : public TerrainProbe {
 public:
  FieldProbe(Field& field, std::vector<glm::vec3> points_m)
      : field_(field),
        voxel_size_m_(field.source().voxel_size_m),
        points_m_(std::move(points_m)),
        offsets_m_(points_m_.size()) {}

  void find(const Pose& pose, float reach_m, std::vector<TerrainContact>& out) override {
    const glm::mat3 turn = glm::mat3_cast(pose.rotation);
    glm::vec3 lo(0.0F), hi(0.0F);
    for (size_t i = 0; i < points_m_.size(); ++i) {
      offsets_m_[i] = turn * points_m_[i];
      lo = glm::min(lo, offsets_m_[i]);
      hi = glm::max(hi, offsets_m_[i]);
    }
    look(pose.position_m + lo, pose.position_m + hi);
    if (all_air_) return;
    for (size_t i = 0; i < points_m_.size(); ++i) test(pose, static_cast<int>(i), reach_m, out);
  }

  void terrain_changed(const VoxelBox& box) override {
    const VoxelBox& mine = codes_.box;
    const bool apart = box.hi.x <= mine.lo.x || box.lo.x >= mine.hi.x || box.hi.y <= mine.lo.y ||
                       box.lo.y >= mine.hi.y || box.hi.z <= mine.lo.z || box.lo.z >= mine.hi.z;
    if (!apart) codes_ = Window();
  }

 private:
  /// Makes codes_ cover the bounds.
  void look(glm::vec3 lo_m, glm::vec3 hi_m) {
    const glm::vec3 lo = lo_m / voxel_size_m_, hi = hi_m / voxel_size_m_;
    if (covers(codes_, lo) && covers(codes_, hi)) return;
    const VoxelBox bounds{{floor_to_voxel(lo.x), floor_to_voxel(lo.y), floor_to_voxel(lo.z)},
                          {floor_to_voxel(hi.x) + 2, floor_to_voxel(hi.y) + 2, floor_to_voxel(hi.z) + 2}};
    codes_ = gather(field_, bounds.grown(slack_voxels));
    all_air_ = std::ranges::all_of(codes_.codes, [](Code code) { return code == code_air; });
  }

  void test(const Pose& pose, int point, float reach_m, std::vector<TerrainContact>& out) const {
    const glm::vec3 offset_m = offsets_m_[static_cast<size_t>(point)];
    const FieldSample at = sample_covered(codes_, (pose.position_m + offset_m) / voxel_size_m_);
    const float distance_m = at.distance_voxels * voxel_size_m_;
    if (distance_m >= reach_m) return;
    const float slope = std::sqrt(glm::dot(at.gradient, at.gradient));
    if (slope < gradient_min) {
      if (distance_m < 0.0F) out.push_back({point, offset_m, glm::vec3(0.0F, 1.0F, 0.0F), distance_m});
      return;
    }
    out.push_back({point, offset_m, at.gradient / slope, distance_m});
  }

  Field& field_;
  float voxel_size_m_;
  std::vector<glm::vec3> points_m_;
  std::vector<glm::vec3> offsets_m_;  ///< scratch: points_m_ turned to the world's axes
  Window codes_;
  bool all_air_ = false;
};

class FieldCollider final : public TerrainCollider {
 public:
  explicit FieldCollider(Field& field) : field_(field) {}

  std::unique_ptr<TerrainProbe> attach(std::vector<glm::vec3> points_m) override {
    return std::make_unique<FieldProbe>(field_, std::move(points_m));
  }

 private:
  Field& field_;
};

}  // namespace

std::unique_ptr<TerrainCollider> make_field_collider(Field& field) {
  return std::make_unique<FieldCollider>(field);
}

}  // namespace scree
