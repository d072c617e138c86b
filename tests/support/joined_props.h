// Props that joints hold, in a world that is stepped by hand.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "server/world/world_snapshot.h"
#include "shared/prop/joint.h"
#include "tests/support/prop_world.h"

namespace scree {

class JointWorld : public PropWorld {
 public:
  using PropWorld::PropWorld;

  /// Where a body is; 0: the terrain.
  JointFrame frame(PieceId id) const {
    if (id == 0) return {};
    const Pose at = pose(id);
    return {id, at.position_m, at.rotation};
  }
  JointId join(const Joint& joint) {
    const Reply reply = ask(AddJointRequest{joint});
    EXPECT_EQ(reply.refusal, "");
    EXPECT_TRUE(reply.joint.has_value());
    return reply.joint.value_or(0);
  }
  /// The same, and takes the speed from a body that fell since it was added.
  JointId join_still(const Joint& joint, PieceId id) {
    step({{0, 1, MovePropRequest{id, {}, {}, glm::vec3(0.0F), glm::vec3(0.0F)}},
          {0, 2, AddJointRequest{joint}}});
    EXPECT_EQ(last().replies.size(), 2U);
    EXPECT_EQ(last().replies.back().refusal, "");
    return last().replies.back().joint.value_or(0);
  }
  JointId join(JointKind kind, PieceId a, PieceId b, glm::vec3 place_m, glm::vec3 axis = {1.0F, 0.0F, 0.0F}) {
    return join(joint_at(kind, frame(a), frame(b), place_m, axis));
  }
  /// A prop that stands in the air, to hang others from.
  PieceId add_post(glm::vec3 place_m) {
    Prop post = crate(0.2F);
    post.motion = PropMotion::fixed;
    return add(post, place_m);
  }
  BodyMotion motion(PieceId id) {
    for (const BodyMotion& one : world().moment().motion.bodies)
      if (one.id == id) return one;
    ADD_FAILURE() << "no body " << id;
    return {};
  }
  float speed_m_s(PieceId id) { return glm::length(motion(id).velocity_m_s); }
  /// Why a joint ended in the last tick; nothing: it did not.
  std::optional<JointEnd> end(JointId id) const {
    for (const EndedJoint& one : last().joints_removed)
      if (one.id == id) return one.why;
    return std::nullopt;
  }
};

/// Capsules of half a metre that hang from a post, one below the other.
inline std::vector<PieceId> hang_chain(JointWorld& world, glm::vec3 top_m, int links, float mass_kg = 5.0F) {
  std::vector<PieceId> chain{world.add_post(top_m)};
  for (int i = 0; i < links; ++i) {
    const glm::vec3 upper_m = top_m - glm::vec3(0.0F, 0.5F * static_cast<float>(i), 0.0F);
    const Prop link = prop_of({.kind = PropPartKind::capsule, .half_m = {0.06F, 0.19F, 0.0F}}, mass_kg);
    chain.push_back(world.add(link, upper_m - glm::vec3(0.0F, 0.25F, 0.0F)));
    world.join(JointKind::ball, chain[chain.size() - 2], chain.back(), upper_m);
  }
  return chain;
}

struct Car {
  PieceId chassis = 0;
  std::vector<PieceId> wheels;
  std::vector<JointId> axles;
};

/// A chassis on four wheels of 0.6 m, which goes along x by their motors.
inline Car add_car(JointWorld& world, glm::vec3 place_m, float speed_m_s, float torque_nm = 1500.0F) {
  constexpr float wheel_m = 0.6F;
  Car car;
  car.chassis =
      world.add(prop_of({.kind = PropPartKind::box, .half_m = {1.5F, 0.2F, 0.7F}}, 900.0F), place_m);
  Prop wheel = prop_of({.kind = PropPartKind::cylinder,
                        .turn = {0.70710678F, 0.70710678F, 0.0F, 0.0F},
                        .half_m = {wheel_m, 0.2F, 0.0F}},
                       60.0F);
  wheel.friction = 1.5F;
  for (const float x : {-1.4F, 1.4F})
    for (const float z : {-1.0F, 1.0F}) {
      const glm::vec3 at_m = place_m + glm::vec3(x, -0.1F, z);
      car.wheels.push_back(world.add(wheel, at_m));
      Joint axle = joint_at(JointKind::hinge, world.frame(car.chassis), world.frame(car.wheels.back()), at_m,
                            {0, 0, 1});
      axle.motor = {-speed_m_s / wheel_m, torque_nm};
      car.axles.push_back(world.join(axle));
    }
  return car;
}

}  // namespace scree
