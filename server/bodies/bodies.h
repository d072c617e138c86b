// Pieces of terrain as rigid bodies, simulated by Bullet.
//
// Deterministic: the same calls in the same order give the same bits, on any build. Bullet's own snapshots do
// not restore that (docs/architecture.md, Bodies), so a Bodies is never copied. Not thread-safe. Metres,
// seconds, kilograms; a body's position is its centre of mass.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "proto/messages.h"
#include "server/bodies/terrain_collider_kind.h"
#include "shared/base/ids.h"
#include "shared/field/field.h"
#include "shared/field/piece.h"

namespace scree {

/// What Bullet needs to know of a piece. `hull_m`: corners of its convex hull, at least 4 and not all in one
/// plane, relative to the centre of mass, in the volume's axes (the world's axes at birth).
/// See server/fracture/hull.h.
struct BodyShape {
  std::vector<glm::vec3> hull_m;
  float mass_kg = 0.0F;
  glm::vec3 inertia_kg_m2{0.0F};  ///< diagonal, about the volume's axes
  /// Coefficient. Of two that touch, the geometric mean counts; the terrain's is its material's.
  float friction = 0.7F;
  /// What touches the terrain, where the hull would not do: points of a concave piece's own surface, in the
  /// same frame. None: points of the hull.
  std::vector<glm::vec3> surface_m{};
  /// What touches other bodies, where the hull would not do: convex parts of a large concave piece, each as
  /// `hull_m`. None: the hull.
  std::vector<std::vector<glm::vec3>> parts_m{};
};

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

/// Who lay on what in the last step.
struct BodyContacts {
  std::vector<PieceId> on_terrain;  ///< or on what is frozen; ordered, without duplicates
  std::vector<Carried> carried;     ///< ordered, without duplicates
};

/// The strongest contact that a body bore in the last step.
struct BodyImpact {
  PieceId id = 0;
  std::optional<PieceId> other;  ///< what struck it; nothing: terrain
  glm::vec3 point_m{0.0F};       ///< where, in the world
  glm::vec3 normal{0.0F};        ///< unit, towards the body
  float impulse_n_s = 0.0F;      ///< along the normal, over all points of the contact
};

struct BodiesConfig {
  uint32_t tick_rate_hz = 60;
  float gravity_m_s2 = 9.81F;
  float restitution = 0.05F;  ///< rubble hardly bounces
  TerrainColliderKind terrain_collider = TerrainColliderKind::field;
};

class Bodies {
 public:
  /// `field` must outlive this; it is read in step() alone.
  Bodies(Field& field, const BodiesConfig& config);
  ~Bodies();
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  /// `state.id` must not be present. Speeds above what the tick can carry are cut (server/bodies/limits.h).
  void add(const BodyShape& shape, const BodyState& state);
  /// Removes a body that is present, and wakes those that touch its bounds.
  void remove(PieceId id);
  bool contains(PieceId id) const;
  size_t size() const;

  /// Advances by one tick.
  void step();

  /// A body at rest stands still from now on: the others find it as hard as the ground, and a step costs
  /// next to nothing for it. It thaws where the terrain or a body in touch with its bounds goes away, when
  /// what it lay on thaws and moves off, and when it is struck so hard that its speed would change by
  /// limits::thaw_speed_m_s; it then takes that blow's momentum. Must be present, and not frozen.
  void freeze(PieceId id);
  void thaw_all();
  size_t frozen() const;

  /// The terrain changed within this box of voxels (after any operation: the box of its changed bricks).
  /// Must be called before the next step; bodies near it wake and look at the ground afresh.
  void terrain_changed(const VoxelBox& box);

  /// From the next step on, bodies find the terrain that way; they stay where they are, and wake.
  void set_terrain_collider(TerrainColliderKind kind);

  /// Of every body, ordered by id.
  std::vector<BodyState> states() const;
  /// Of a body that is present.
  BodyState state(PieceId id) const;
  BodyContacts contacts() const;
  /// Of the bodies whose strongest contact in the last step changed their speed by at least that, by id.
  std::vector<BodyImpact> impacts(float speed_min_m_s) const;
  float mass_kg(PieceId id) const;
  /// Radius of the sphere about the centre of mass that holds the body's hull; metres.
  float reach_m(PieceId id) const;
  /// Bodies that are awake.
  size_t awake() const;
  /// Points at which bodies touched terrain or each other in the last step.
  size_t contact_points() const;
  /// Every body, and every point where two of them or one and the terrain touched in the last step. For
  /// people to look at.
  void describe(PhysicsMessage& to) const;

  /// XXH3 of the exact transforms and velocities, in order of id.
  uint64_t state_hash() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scree
