#include "client/viewer/session/solid_ground.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "shared/field/voxel_vector.h"
#include "shared/field/window_sample.h"

namespace scree {
namespace {

/// As far as a step goes, and the body is high.
constexpr float near_m = 6.0F;

WalkGround::Touch touch_of(const FieldSample& sample, float voxel_m) {
  const float slope = glm::length(sample.gradient);
  return {sample.distance_voxels * voxel_m, slope > 1e-4F ? sample.gradient / slope : glm::vec3(0.0F)};
}

}  // namespace

SolidGround::SolidGround(const Scene& scene, glm::vec3 about_m)
    : field_(scene.field), voxel_m_(scene.field.source().voxel_size_m) {
  for (const auto& [id, piece] : scene.pieces) {
    const VoxelBox& box = piece.volume->window.box;
    const glm::vec3 size(static_cast<float>(box.hi.x - box.lo.x), static_cast<float>(box.hi.y - box.lo.y),
                         static_cast<float>(box.hi.z - box.lo.z));
    const float reach_m = near_m + glm::length(size) * voxel_m_;
    if (glm::distance(piece.pose.position_m, about_m) < reach_m) near_.push_back(&piece);
  }
}

WalkGround::Touch SolidGround::rock(glm::vec3 place_m) {
  return touch_of(sample(field_, place_m / voxel_m_), voxel_m_);
}

WalkGround::Touch SolidGround::loose(glm::vec3 place_m) {
  Touch nearest{std::numeric_limits<float>::max(), glm::vec3(0.0F)};
  for (const ScenePiece* piece : near_) {
    const Pose& pose = piece->pose;
    const glm::vec3 at_voxels =
        glm::conjugate(pose.rotation) * (place_m - pose.position_m) / voxel_m_ + piece->volume->centre_voxels;
    if (!covers(piece->volume->window, at_voxels)) continue;  // air
    Touch touch = touch_of(sample_covered(piece->volume->window, at_voxels), voxel_m_);
    if (touch.distance_m >= nearest.distance_m) continue;
    touch.away = pose.rotation * touch.away;
    nearest = touch;
  }
  return nearest;
}

}  // namespace scree
