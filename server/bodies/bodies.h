// Pieces of terrain, and a game's props, as rigid bodies, simulated by Bullet.
//
// Deterministic: the same calls in the same order give the same bits, on any build and on any number of
// threads. Bullet's own snapshots do not restore that, so a Bodies is never copied; restore() takes up
// motions without contacts. Not thread-safe: one thread calls, and step() shares its work with others.
// Metres, seconds, kilograms. A body's pose and speed are those of its piece: of the volume's centre, which
// is the centre of mass where the piece is of one material (BodyShape::centre_m).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "content/builtin_palette.h"
#include "proto/messages.h"
#include "server/colliders/terrain_collider_kind.h"
#include "server/formats/world_value.h"
#include "shared/base/ids.h"
#include "shared/base/result.h"
#include "shared/field/field.h"
#include "shared/field/piece.h"
#include "shared/prop/joint.h"

namespace scree {

struct BodyState {
  PieceId id = 0;
  Pose pose;
  glm::vec3 velocity_m_s{0.0F};
  glm::vec3 spin_rad_s{0.0F};
  bool frozen = false;  ///< see Bodies::freeze
};

/// `upper` lies on `lower` (or leans on it from above).
struct Carried {
  PieceId upper = 0;
  PieceId lower = 0;

  auto operator<=>(const Carried&) const = default;
};

/// The supports between bodies and the terrain in the last step.
struct BodyContacts {
  std::vector<PieceId> on_terrain;  ///< or on a frozen body; ordered, without duplicates
  std::vector<Carried> carried;     ///< ordered, without duplicates
};

/// The strongest contact that a body bore in the last step.
struct BodyImpact {
  PieceId id = 0;
  std::optional<PieceId> other;  ///< the other body of the contact; nothing: terrain
  glm::vec3 point_m{0.0F};       ///< where, in the world
  glm::vec3 normal{0.0F};        ///< unit, towards the body
  float impulse_n_s = 0.0F;      ///< along the normal, summed over the points of the contact; positive
  /// Change of the speed of that place of the body, by its mass and inertia: more than that of its centre,
  /// where a corner strikes. Half of the impulse's product with it is the blow's energy.
  float give_m_s = 0.0F;
  /// How fast the two places neared each other at the step's start, along the normal; not negative. What
  /// presses at rest has an impulse, too, and hardly nears.
  float nears_m_s = 0.0F;
  /// What the contact took: the impulse's product with how fast they neared in the mean of the step. A blow
  /// that takes several steps has a part in each.
  float energy_j = 0.0F;
  /// How fast the two places still near each other after the step: the blow goes on; not negative.
  float still_m_s = 0.0F;
};

/// How a prop lies: `way_out`: in the terrain, from which it is pushed to a free place that is no farther
/// than it is long; `no_way_out`: in the terrain, where it stays.
enum class InTerrain : uint8_t { no, way_out, no_way_out };

/// A body's strongest blow on terrain in the last tick.
struct TerrainBlow {
  PieceId id = 0;
  glm::vec3 point_m{0.0F};          ///< their mean, by impulse
  glm::vec3 normal{0.0F};           ///< unit, towards the body
  float impulse_n_s = 0.0F;         ///< along the normal
  float own_n_s = 0.0F;             ///< part of it that took the body's own speed; the rest others handed on
  float speed_m_s = 0.0F;           ///< speed there that the contact took, of the body or of those behind it
  std::vector<glm::vec3> points_m;  ///< where it touched

  /// What the contact took.
  float energy_j() const { return 0.5F * impulse_n_s * speed_m_s; }
};

/// What a joint bore in the last step that moved its bodies, without its motor's part.
struct JointLoad {
  float force_n = 0.0F;
  float torque_nm = 0.0F;
};

struct BodiesConfig {
  uint32_t tick_rate_hz = 60;
  float gravity_m_s2 = 9.81F;
  std::shared_ptr<const Palette> palette =
      shared_builtin_palette();  ///< what the terrain rubs and bounces by
  TerrainColliderKind terrain_collider = TerrainColliderKind::field;
  float air_drag = 0.0F;  ///< share of its speed and spin that a body loses in a second, 0 to 1
  size_t threads = 1;     ///< that step() takes, its own included; 0: as many as the machine has cores
};

class Bodies {
 public:
  /// `field` must outlive this object; only step() reads it. The tick rate must be positive.
  Bodies(Field& field, const BodiesConfig& config);
  ~Bodies();
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  /// The shape as `BodyShape` (server/formats/world_value.h) says. `state.id` must be new, the position
  /// finite, the rotation a unit quaternion. Speeds beyond limits::speed_max_m_s are reduced to it; a body
  /// whose speed is not finite is stopped by the next step.
  void add(BodyShape given, const BodyState& state);
  /// Changes a body that is no piece, and wakes it: where it is, and its speeds, as far as they are given.
  /// The body must be present; a fixed one has no speeds. Numbers as of add().
  void set_motion(PieceId id, const std::optional<Pose>& pose, const std::optional<glm::vec3>& velocity_m_s,
                  const std::optional<glm::vec3>& spin_rad_s);
  /// Puts a body elsewhere, with another speed, and wakes it: contacts are of where it was. The body must be
  /// present, and no fixed one. Numbers as of add().
  void put_back(PieceId id, const Pose& pose, glm::vec3 velocity_m_s);
  /// Whether a prop that contacts move lies in the terrain, which is read. The body must be present. Steps
  /// look by themselves, too: what sinks there is pushed out at limits::undo_buried_m_s.
  InTerrain look_whether_in_terrain(PieceId id);
  /// Gives a body an impulse at a place, and wakes it. What does not move, but for a frozen piece, stays as
  /// it is. The body must be present. It does not become faster than a body may be.
  void push(PieceId id, glm::vec3 impulse_n_s, glm::vec3 at_m);
  /// Removes a body, which must be present. In the next step the bodies that touch its bounds wake. Its
  /// joints end (take_broken_joints).
  void remove(PieceId id);
  bool contains(PieceId id) const;
  size_t size() const;

  /// Joins two bodies, or one to the terrain, and wakes them. The joint must be valid, its id new among
  /// joints, and its bodies present. A body whose motion is set (set_motion) keeps its joints.
  void add_joint(JointId id, const Joint& joint);
  /// Ends a joint, which must be present, and wakes its bodies.
  void remove_joint(JointId id);
  /// Changes the motor of a joint, which must be present and of a kind that has one.
  void set_motor(JointId id, const JointMotor& motor);
  bool has_joint(JointId id) const;
  size_t joints() const;
  /// Number of joints of which a body is awake.
  size_t awake_joints() const;
  /// Whether a joint holds the body.
  bool is_joined(PieceId id) const;
  /// The joint must be present.
  JointLoad joint_load(JointId id) const;
  /// The joints that broke, or whose bodies were removed, since they were last taken; ordered by id.
  std::vector<EndedJoint> take_broken_joints();

  /// Advances by one tick.
  void step();

  /// Makes a body static: other bodies collide with it as with the ground, and a step costs almost nothing
  /// for it. It thaws when the terrain changes or a body is removed within its bounds, when a body that it
  /// touched thaws and moves away, and when a blow would change its speed by limits::thaw_speed_m_s; it then
  /// takes that blow's momentum. The body must be present and not frozen.
  void freeze(PieceId id);
  void thaw_all();
  /// Number of frozen bodies.
  size_t frozen() const;

  /// Tells the bodies that the terrain changed within this box of voxels (after an operation: the box of its
  /// changed bricks). Bodies near the box wake and read the terrain again in the next step.
  void terrain_changed(const VoxelBox& box);

  /// Changes what the terrain rubs and bounces by, from the next step on. Not null.
  void set_palette(std::shared_ptr<const Palette> palette);
  /// Changes what the air takes, from the next step on.
  void set_air_drag(float share_a_second);
  /// Changes the way in which bodies find the terrain, from the next step on. Poses and speeds stay; all
  /// bodies wake.
  void set_terrain_collider(TerrainColliderKind kind);

  /// The bodies whose bounds meet that box of the world, metres, and some that lie a little beyond; ordered
  /// by id.
  std::vector<PieceId> near(glm::vec3 lo_m, glm::vec3 hi_m) const;
  /// The bodies whose positions are farther from the origin than that along an axis; ordered by id.
  std::vector<PieceId> beyond(glm::vec3 half_m) const;
  /// States of all bodies, ordered by id.
  std::vector<BodyState> states() const;
  /// The body must be present.
  BodyState state(PieceId id) const;
  BodyContacts contacts() const;
  /// The strongest contact of each body in the last step, if it changed the body's speed by at least
  /// `speed_min_m_s`, which is positive; ordered by id.
  std::vector<BodyImpact> impacts(float speed_min_m_s) const;
  /// The blows on terrain of the last tick that took at least limits::struck_speed_min_m_s; ordered by id.
  const std::vector<TerrainBlow>& terrain_blows() const;
  /// Gives a body back a part of the impulse that a blow on terrain took, because the terrain broke. The body
  /// must be present and not frozen. It does not become faster than a piece may be.
  void give_back(PieceId id, glm::vec3 impulse_n_s, glm::vec3 at_m);
  /// The body must be present.
  float mass_kg(PieceId id) const;
  /// Radius of the sphere about the centre of mass that holds the body's hull; metres. The body must be
  /// present.
  float reach_m(PieceId id) const;

  /// Steps of the simulation in one tick: one up to limits::step_max_s, more in longer ticks.
  int steps_a_tick() const;
  /// Whether the body, which must be present, is awake.
  bool is_awake(PieceId id) const;
  /// Number of bodies that are awake.
  size_t awake() const;
  /// Number of points at which bodies touched terrain or each other in the last step.
  size_t contact_points() const;
  /// Number of pairs of bodies whose bounds met in the last step.
  size_t pairs() const;
  /// Number of points of bodies that are awake which are compared with the ground in a step.
  size_t ground_points() const;
  /// Number of pairs of hulls, or parts of them, that overlapped in the last step.
  size_t overlaps() const;
  /// Appends every body, and every point of contact of the last step, for display.
  void describe(PhysicsMessage& to) const;

  /// The exact motions, and what the bodies have not been told yet. Which bodies sleep, and their contacts,
  /// are left out.
  MotionValue motions() const;
  /// What add() was given.
  std::shared_ptr<const BodyShape> shape(PieceId id) const;
  /// Gives bodies the shapes and motions that shape() and motions() told, bit for bit; awake, and without
  /// contacts. There must be no body yet, and one shape for each motion. Joints begin without a load. Refuses
  /// a value that no Bodies has.
  Result<void> restore(const std::vector<std::shared_ptr<const BodyShape>>& shapes,
                       const MotionValue& motions, std::span<const KnownJoint> joints = {});

  /// Makes of these bodies what restore() makes of their shapes and motions: all wake, and contacts are gone.
  void renew();

  /// The thread that calls step() lets go: the thread of the next call owns the bodies.
  void release_thread();

  /// XXH3 of the exact transforms and velocities, in order of id.
  uint64_t state_hash() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scree
