// The members of a Bodies: Bullet's world, and each piece as a body in it. Private to this folder.
//
// Its parts: TerrainBody (contacts with the ground), PieceWorld (Bullet's world), PendingChanges (what the
// bodies have not been told), TickBlows (impacts of a tick's earlier steps). The state itself says the order
// of a step, and which bodies sleep, wake and freeze.
//
// Invariant: `State::frozen` counts the frozen bodies.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "server/bodies/bodies.h"
#include "server/bodies/body.h"
#include "server/bodies/body_maker.h"
#include "server/bodies/body_speeds.h"
#include "server/bodies/hull_algorithm.h"
#include "server/bodies/joint_rows.h"
#include "server/bodies/pair_dispatcher.h"
#include "server/bodies/pending_changes.h"
#include "server/bodies/piece_world.h"
#include "server/bodies/seen_chunks.h"
#include "server/bodies/terrain_body.h"
#include "server/bodies/tick_blows.h"
#include "shared/base/workers.h"

namespace scree {

/// Which bodies meet: those whose groups meet each other, and of which one can move. Frozen pieces of a heap
/// lie one on another by hundreds.
struct MeetingFilter final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
};

struct Bodies::State {
  State(Field& field, const BodiesConfig& c);

  /// A new body, as of make_body(), with a probe.
  Body& make(PieceId id, std::shared_ptr<const BodyShape> given, std::vector<glm::vec3> points_m = {});
  /// Refuses what no Bodies has.
  Result<void> restore(const BodyMotion& motion, std::shared_ptr<const BodyShape> shape,
                       std::vector<glm::vec3> points_m = {});
  /// Advances by one step.
  void step();
  /// Wakes the body; thaws it if it is frozen.
  void wake(Body& body);
  void wake_near(const Bounds& bounds);
  /// Tells the bodies what changed since the last step: each looks at all changes in turn, because a
  /// tick has hundreds of both. Each body is one thread's.
  void tell_changes();
  /// Adds the body to Bullet's world, and removes it; a body whose mass is set to 0 is static there.
  void enter(Body& body);
  void leave(Body& body);
  void freeze(PieceId id, Body& body);
  /// Thaws the frozen bodies that the last step struck hard. The solver saw them as static, so the impulse
  /// is applied here.
  void thaw_struck();
  /// Wakes the neighbours of a thawed body once it has moved by limits::thawed_leash_m.
  void wake_around_thawed(Body& body);
  /// Takes a body out. Its joints go on, and must end, or get it back by enter_joints().
  void take_out(PieceId id);

  /// Searches the way out for props that sank into the terrain, and keeps those awake that have one.
  void look_for_ways_out();
  /// Whether the body lies in the terrain; searches its way out.
  bool look_for_way_out(Body& body);

  // bodies_joints.cpp:
  /// Adds a joint, and wakes nothing.
  void enter_joint(JointId id, const Joint& joint);
  /// Takes a joint out, and wakes its bodies.
  void end_joint(JointId id);
  /// Tells Bullet's world which joints there are, if they are others than before.
  void list_joints();
  /// Two bodies that a joint keeps apart make no contacts.
  void keep_apart(JointRows& joint, bool apart);
  /// The joints of a body let its object in Bullet go, and hold its new one; their bodies wake.
  void leave_joints(PieceId body);
  void enter_joints(PieceId body);
  /// Ends the joints that the last step's load breaks.
  void break_joints();
  /// Bodies that joints hold move by the same share of the step: the least of theirs.
  void stop_together();
  Result<void> restore_joints(std::span<const KnownJoint> known);

  BodiesConfig config;
  int steps_a_tick;  ///< a tick longer than limits::step_max_s takes several
  StepSize step_size;
  TickBlows blows;
  std::vector<TerrainBlow> terrain_blows;  ///< of the tick, ordered by id
  HullAlgorithmCreator hull_algorithm;
  btDefaultCollisionConfiguration collision_configuration;
  Workers workers;
  PairDispatcher dispatcher;
  MeetingFilter meeting;
  btDbvtBroadphase broadphase;
  PieceWorld dynamics;
  TerrainBody terrain;
  std::map<PieceId, Body> bodies;
  std::map<JointId, JointRows> joints;
  std::map<PieceId, std::set<JointId>> joints_of;  ///< by body; none is empty
  bool joints_listed = true;                       ///< as of list_joints()
  std::vector<EndedJoint> ended;                   ///< that were not told yet
  PendingChanges pending;
  size_t frozen = 0;     ///< number of frozen bodies
  float moved_m = 0.0F;  ///< farthest that a point of any body moved in the last step, at most
  SeenChunks seen;
  std::vector<Body*> loose;  ///< scratch memory of step(): those that are not frozen
  std::vector<Body*> fast;   ///< likewise: those that sweep() looks at
};

}  // namespace scree
