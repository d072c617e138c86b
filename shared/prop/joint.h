// Joints: what holds two bodies together, or a body to the terrain, such as hinges, axles and ropes. Plain
// values: a joint never changes while it lives, but for its motor. One that comes from outside is untrusted
// until validate() has passed it. Metres, radians, newtons.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shared/base/ids.h"
#include "shared/base/kind_table.h"
#include "shared/base/result.h"

namespace scree {

/// A joint's id is from the same numbers as those of pieces and props.
using JointId = PieceId;

/// Every joint holds two places together, one on each side, but for a slider, which holds side b's place on a
/// line, and for a distance and a rope, which hold the two places apart.
enum class JointKind : uint8_t { fixed = 0, hinge = 1, slider = 2, ball = 3, distance = 4, rope = 5 };

struct JointRow {
  std::string_view name;
  bool has_axis = false;    ///< it moves along or about its axis, and may have limits and a motor
  bool has_length = false;  ///< Joint::length_m counts
  bool has_torque = false;  ///< it bears a torque, by which it may break
};

constexpr JointRow row_of(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return {"fixed", false, false, true};
    case JointKind::hinge:
      return {"hinge", true, false, true};
    case JointKind::slider:
      return {"slider", true, false, true};
    case JointKind::ball:
      return {"ball", false, false, false};
    case JointKind::distance:
      return {"distance", false, true, false};
    case JointKind::rope:
      return {"rope", false, true, false};
  }
  return {};
}

/// Why a joint is no more.
enum class JointEnd : uint8_t { removed = 0, broken = 1, let_go = 2, body_gone = 3 };

struct JointEndRow {
  std::string_view name;
};

constexpr JointEndRow row_of(JointEnd end) {
  switch (end) {
    case JointEnd::removed:  // by a request
      return {"removed"};
    case JointEnd::broken:  // by a force or a torque
      return {"broken"};
    case JointEnd::let_go:  // the terrain at its place is rock no more
      return {"let_go"};
    case JointEnd::body_gone:
      return {"body_gone"};
  }
  return {};
}

/// Where a joint holds a body: a place and axes in the body's own frame, of a piece in its volume's. Without
/// a body it holds the terrain, and the frame is the world's.
struct JointSide {
  PieceId body = 0;  ///< 0: the terrain
  glm::vec3 place_m{0.0F};
  glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};  ///< from the joint's axes to the frame's; a hinge turns about x

  bool holds_terrain() const { return body == 0; }
  bool operator==(const JointSide&) const = default;
};

/// Bounds of a hinge's angle, by which side b is turned about x from side a, or of a slider's way, by which
/// b's place lies along a's x. Both are 0 where the sides' axes, or places, are the same.
struct JointLimits {
  float low = 0.0F, high = 0.0F;

  bool operator==(const JointLimits&) const = default;
};

/// Drives side b against side a: rad/s and N m about a hinge's axis, m/s and N along a slider's.
struct JointMotor {
  float speed = 0.0F;
  float greatest = 0.0F;  ///< force or torque; 0: there is no motor

  bool operator==(const JointMotor&) const = default;
};

struct Joint {
  JointKind kind = JointKind::fixed;
  JointSide a, b;
  std::optional<JointLimits> limits{};  ///< of kinds with an axis; nothing: it turns, or slides, freely
  JointMotor motor{};                   ///< of kinds with an axis
  float length_m = 0.0F;                ///< of a distance, and of a rope at most
  float break_force_n = 0.0F;           ///< 0: no force breaks it; the motor's own is not counted
  float break_torque_nm = 0.0F;         ///< likewise, of kinds that bear one
  bool touches = false;                 ///< whether the two bodies may touch each other

  bool operator==(const Joint&) const = default;
};

struct KnownJoint {
  JointId id = 0;
  Joint joint;

  bool operator==(const KnownJoint&) const = default;
};

/// A joint that is no more.
struct EndedJoint {
  JointId id = 0;
  JointEnd why = JointEnd::removed;

  bool operator==(const EndedJoint&) const = default;
};

/// Refuses what no world can take: numbers beyond their bounds, members that are another kind's, and a joint
/// of a body with itself, or of the terrain alone.
Result<void> validate(const Joint& joint);
/// The same of a motor, for a joint of that kind.
Result<void> validate(const JointMotor& motor, JointKind kind);

/// A body's frame in the world. Without a body: the terrain's, which is the world's.
struct JointFrame {
  PieceId body = 0;
  glm::vec3 origin_m{0.0F};
  glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};
};

/// A joint of two bodies as they stand, at a place of the world and about (or along) an axis of any length
/// but 0, with angle or way 0.
Joint joint_at(JointKind kind, const JointFrame& a, const JointFrame& b, glm::vec3 place_m,
               glm::vec3 axis = {1.0F, 0.0F, 0.0F});
/// A distance or a rope between two places of the world, as long as they are apart.
Joint line_between(JointKind kind, const JointFrame& a, glm::vec3 place_a_m, const JointFrame& b,
                   glm::vec3 place_b_m);

}  // namespace scree
