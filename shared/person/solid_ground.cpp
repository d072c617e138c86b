#include "shared/person/solid_ground.h"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "shared/field/voxel_vector.h"
#include "shared/field/window_sample.h"
#include "shared/prop/prop_solid.h"
#include "shared/query/convex.h"

namespace scree {
namespace {

/// As far as a step goes, and the body is high.
constexpr float near_m = 6.0F;

WalkGround::Touch touch_of(const FieldSample& sample, float voxel_m) {
  const float slope = glm::length(sample.gradient);
  return {sample.distance_voxels * voxel_m, slope > 1e-4F ? sample.gradient / slope : glm::vec3(0.0F)};
}

/// A surface that lies where the field says has at most that distance there, voxels.
constexpr float surface_voxels = 0.5F;

/// Along the axes and between them: unit.
constexpr float third = 0.57735027F;  // 1 / sqrt(3)
constexpr std::array<glm::vec3, 14> directions = {{{0.0F, -1.0F, 0.0F},
                                                   {0.0F, 1.0F, 0.0F},
                                                   {1.0F, 0.0F, 0.0F},
                                                   {-1.0F, 0.0F, 0.0F},
                                                   {0.0F, 0.0F, 1.0F},
                                                   {0.0F, 0.0F, -1.0F},
                                                   {third, third, third},
                                                   {third, third, -third},
                                                   {third, -third, third},
                                                   {third, -third, -third},
                                                   {-third, third, third},
                                                   {-third, third, -third},
                                                   {-third, -third, third},
                                                   {-third, -third, -third}}};

/// The nearest rock within a body's radius, as far as rays meet it.
WalkGround::Touch nearest_rock(const Field& field, glm::vec3 place_m, float voxel_m) {
  WalkGround::Touch nearest{Walker::radius_m, glm::vec3(0.0F)};
  const glm::vec3 from = place_m / voxel_m;
  for (const glm::vec3& direction : directions) {
    const std::optional<float> along = trace(field, from, direction, nearest.distance_m / voxel_m);
    if (!along || *along * voxel_m >= nearest.distance_m) continue;
    nearest = {*along * voxel_m, touch_of(sample(field, from + direction * *along), voxel_m).away};
  }
  return nearest;
}

}  // namespace

SolidGround::SolidGround(const Field& field, glm::vec3 about_m)
    : field_(field), about_m_(about_m), voxel_m_(field.source().voxel_size_m) {}

void SolidGround::add(const Volume& piece, const Pose& pose) {
  const VoxelBox& box = piece.window.box;
  const glm::vec3 size(static_cast<float>(box.hi.x - box.lo.x), static_cast<float>(box.hi.y - box.lo.y),
                       static_cast<float>(box.hi.z - box.lo.z));
  // A voxel more than any place within the box lies from one in it.
  const float reach_m = (glm::length(size) + 1.0F) * voxel_m_;
  if (glm::distance(pose.position_m, about_m_) < near_m + reach_m) pieces_.push_back({&piece, pose, reach_m});
}

void SolidGround::add(const Prop& prop, const Pose& pose) {
  if (!(glm::distance(pose.position_m, about_m_) < near_m + reach_of(prop))) return;
  for (const PropPart& part : prop.parts) {
    const RoundedHull hull = rounded_hull_of(part);
    NearPart& added = parts_.emplace_back();
    added.radius_m = static_cast<double>(hull.radius_m);
    added.pose = pose;
    for (const glm::vec3& point : hull.points_m) added.points_m.emplace_back(point);
  }
}

WalkGround::Touch SolidGround::rock(glm::vec3 place_m) {
  const Touch touch = touch_of(sample(field_, place_m / voxel_m_), voxel_m_);
  if (touch.distance_m <= 0.0F || touch.distance_m >= Walker::radius_m) return touch;
  // Above a surface that was taken away, the field may still say how far it was: no more than what is true.
  const glm::vec3 surface_m = place_m - touch.away * touch.distance_m;
  if (sample(field_, surface_m / voxel_m_).distance_voxels <= surface_voxels) return touch;
  return nearest_rock(field_, place_m, voxel_m_);
}

WalkGround::Touch SolidGround::touch_of_part(const NearPart& part, glm::vec3 place_m) const {
  const glm::vec3 at_m = glm::conjugate(part.pose.rotation) * (place_m - part.pose.position_m);
  uint32_t steps = 0;
  const ConvexNear near = nearest_of_convex(glm::dvec3(at_m), {part.points_m, part.radius_m}, steps);
  if (near.meet) return {0.0F, glm::vec3(0.0F)};
  return {static_cast<float>(near.gap), part.pose.rotation * glm::vec3(near.normal)};
}

WalkGround::Touch SolidGround::loose(glm::vec3 place_m) {
  Touch nearest{std::numeric_limits<float>::max(), glm::vec3(0.0F)};
  for (const NearPiece& piece : pieces_) {
    const Pose& pose = piece.pose;
    const glm::vec3 off_m = place_m - pose.position_m;
    if (glm::dot(off_m, off_m) > piece.reach_m * piece.reach_m) continue;
    const glm::vec3 at_voxels =
        glm::conjugate(pose.rotation) * off_m / voxel_m_ + piece.volume->centre_voxels;
    if (!covers(piece.volume->window, at_voxels)) continue;  // air
    Touch touch = touch_of(sample_covered(piece.volume->window, at_voxels), voxel_m_);
    if (touch.distance_m >= nearest.distance_m) continue;
    touch.away = pose.rotation * touch.away;
    nearest = touch;
  }
  for (const NearPart& part : parts_) {
    const Touch touch = touch_of_part(part, place_m);
    if (touch.distance_m < nearest.distance_m) nearest = touch;
  }
  return nearest;
}

}  // namespace scree
