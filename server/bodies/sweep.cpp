#include "server/bodies/sweep.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "server/bodies/limits.h"

namespace scree {

namespace {

/// A body's speed, as points of it have it.
struct Motion {
  glm::vec3 velocity_m_s;
  glm::vec3 spin_rad_s;

  explicit Motion(const btRigidBody& rigid)
      : velocity_m_s(from_bullet(rigid.getLinearVelocity())),
        spin_rad_s(from_bullet(rigid.getAngularVelocity())) {}

  /// How fast a contact's point nears the ground.
  float approach_m_s(const TerrainContact& contact) const {
    return -glm::dot(velocity_m_s + glm::cross(spin_rad_s, contact.offset_m), contact.normal);
  }
};

/// The way from the contact to the overlap that contacts at rest have: there the solver takes the whole
/// speed.
float gap_m(const TerrainContact& contact) {
  return contact.distance_m + limits::penetration_slop_m;
}

/// Seconds until the first blow, or `free_s` without one in that time.
float until_blow_s(const Motion& motion, const std::vector<TerrainContact>& found, float free_s) {
  for (const TerrainContact& contact : found) {
    const float approach_m_s = motion.approach_m_s(contact);
    if (approach_m_s < limits::blow_min_m_s) continue;
    free_s = std::min(free_s, std::max(gap_m(contact), 0.0F) / approach_m_s);
  }
  return free_s;
}

}  // namespace

void stop_at_blows(Body& body, const StepSize& step, std::vector<TerrainContact>& found) {
  const Motion motion(*body.rigid);
  std::erase_if(found, [&](const TerrainContact& contact) {
    const float approach_m_s = motion.approach_m_s(contact);
    if (approach_m_s < limits::blow_min_m_s) return false;
    const float share = gap_m(contact) / (approach_m_s * step.step_s);
    if (share >= 1.0F || share < limits::touching_step) return false;
    body.hulls->stop_at(share);
    return true;
  });
}

bool is_fast(const Body& body, const StepSize& step) {
  const float travel_m = limits::travel_max_voxels * step.voxel_size_m;
  const float speed_m_s = body.rigid->getLinearVelocity().length();
  return speed_m_s * step.step_s * body.hulls->step_share() > 0.8F * travel_m;
}

namespace {

/// Seconds that the body takes for a stride.
float stride_s(const Body& body, const StepSize& step) {
  return 0.8F * limits::travel_max_voxels * step.voxel_size_m / body.rigid->getLinearVelocity().length();
}

/// All that a probe may read with the body that far from where it is.
VoxelBox box_at(const Body& body, glm::vec3 off_m, const StepSize& step) {
  const Bounds bounds = bounds_of(body);
  const glm::vec3 lo = (from_bullet(bounds.lo) + off_m) / step.voxel_size_m,
                  hi = (from_bullet(bounds.hi) + off_m) / step.voxel_size_m;
  return {{floor_to_int(lo.x) - 2, floor_to_int(lo.y) - 2, floor_to_int(lo.z) - 2},
          {floor_to_int(hi.x) + 3, floor_to_int(hi.y) + 3, floor_to_int(hi.z) + 3}};
}

void sweep(Body& body, const StepSize& step, size_t strides_max, SeenChunks& seen) {
  const Motion motion(*body.rigid);
  const Pose start = from_bullet(body.rigid->getWorldTransform());
  const float each_s = stride_s(body, step);
  const float all_s = step.step_s * body.hulls->step_share();
  const float reach_m =
      limits::contact_slack_m + body.round.sag_m + limits::travel_max_voxels * step.voxel_size_m;
  std::vector<TerrainContact> found;
  size_t strides = 0;
  seen.note(box_at(body, glm::vec3(0.0F), step));
  for (float at_s = 0.0F; at_s < all_s; at_s += each_s, ++strides) {
    const glm::vec3 way_m = motion.velocity_m_s * at_s;
    const glm::vec3 next_m = motion.velocity_m_s * std::min(at_s + each_s, all_s);
    if (strides >= strides_max || !seen.enter(box_at(body, next_m, step)))
      return body.hulls->stop_at(at_s / step.step_s);
    found.clear();
    body.probe->find({start.position_m + way_m, start.rotation}, reach_m, found);
    touch_as_round(body, found);
    // What it touches at the start, the solver has seen.
    if (at_s == 0.0F)
      std::erase_if(found, [](const TerrainContact& c) { return c.distance_m <= limits::contact_slack_m; });
    const float free_s = std::min(each_s, all_s - at_s);
    const float blow_s = until_blow_s(motion, found, free_s);
    if (blow_s < free_s) return body.hulls->stop_at((at_s + blow_s) / step.step_s);
  }
}

}  // namespace

void sweep(std::span<Body* const> fast, const StepSize& step, SeenChunks& seen) {
  size_t points_a_stride = 0, points = 0;
  for (const Body* body : fast) {
    const float all_s = step.step_s * body->hulls->step_share();
    points_a_stride += body->points_m.size();
    points += body->points_m.size() * (1 + static_cast<size_t>(all_s / stride_s(*body, step)));
  }
  size_t strides_max = std::numeric_limits<size_t>::max();
  if (points > limits::swept_points_max)
    strides_max = std::max<size_t>(1, limits::swept_points_max / points_a_stride);
  seen.begin_step();
  for (Body* body : fast) sweep(*body, step, strides_max, seen);
}

}  // namespace scree
