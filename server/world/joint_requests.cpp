#include "server/world/joint_requests.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "server/world/limits.h"
#include "server/world/person_requests.h"
#include "server/world/state_hash.h"
#include "shared/base/check.h"
#include "shared/base/plain_number.h"
#include "shared/prop/limits.h"

namespace scree {

namespace {

/// Null: the joint holds no terrain.
const JointSide* side_in_terrain(const Joint& joint) {
  if (joint.a.holds_terrain()) return &joint.a;
  return joint.b.holds_terrain() ? &joint.b : nullptr;
}

VoxelCoord anchor_voxel(const World::State& state, glm::vec3 place_m) {
  const glm::vec3 at = place_m / state.config.terrain.voxel_size_m + 0.5F;
  return {floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)};
}

/// By the nearest voxel, so that one brick decides.
bool lies_in_rock(const World::State& state, glm::vec3 place_m) {
  const VoxelCoord voxel = anchor_voxel(state, place_m);
  const VoxelCoord first = first_voxel(brick_of(voxel));
  const int index = Brick::index(voxel.x - first.x, voxel.y - first.y, voxel.z - first.z);
  return state.field.brick(brick_of(voxel)).codes[static_cast<size_t>(index)] < 0;
}

CheckedRequest check_side(const World::State& state, const JointSide& side) {
  if (side.holds_terrain()) {
    if (lies_in_rock(state, side.place_m)) return {};
    return refuse(Refusal::joint_invalid, "the joint's place in the terrain is no rock");
  }
  if (state.bodies.contains(side.body)) return check_is_no_person(state, side.body);
  return refuse(Refusal::body_missing,
                "there is no body " + std::to_string(side.body) + ": it may have become terrain");
}

bool can_be_moved(const World::State& state, const JointSide& side) {
  if (side.holds_terrain()) return false;
  const auto prop = state.props.find(side.body);
  return prop == state.props.end() || prop->second.prop->motion == PropMotion::dynamic;
}

/// A side in the world; nothing: its body is gone.
std::optional<Pose> placed(const World::State& state, const JointSide& side) {
  if (side.holds_terrain()) return Pose{side.place_m, side.turn};
  if (!state.bodies.contains(side.body)) return std::nullopt;
  const Pose pose = state.bodies.state(side.body).pose;
  return Pose{pose.position_m + pose.rotation * side.place_m, pose.rotation * side.turn};
}

/// How far the sides lie apart beyond what the joint leaves free.
float gap_m(const Joint& joint, const Pose& a, const Pose& b) {
  const glm::vec3 off_m = b.position_m - a.position_m;
  const float away_m = glm::length(off_m);
  switch (joint.kind) {
    case JointKind::distance:
      return std::abs(away_m - joint.length_m);
    case JointKind::rope:
      return away_m - joint.length_m;
    case JointKind::slider: {
      const glm::vec3 axis = a.rotation * glm::vec3(1.0F, 0.0F, 0.0F);
      const float way_m = glm::dot(axis, off_m);
      const float on_way_m = joint.limits ? std::clamp(way_m, joint.limits->low, joint.limits->high) : way_m;
      return glm::length(off_m - axis * on_way_m);
    }
    case JointKind::fixed:
    case JointKind::hinge:
    case JointKind::ball:
      break;
  }
  return away_m;
}

/// Refuses a joint that would drag its bodies together. Both of them are there.
CheckedRequest check_gap(const World::State& state, const Joint& joint) {
  const float apart_m = gap_m(joint, *placed(state, joint.a), *placed(state, joint.b));
  if (apart_m <= limits::joint_gap_max_m) return {};
  return refuse(Refusal::joint_apart, "the places of the joint's two sides are " + metres(apart_m) +
                                          " farther apart than the joint lets them be, and may be " +
                                          metres(limits::joint_gap_max_m) +
                                          ": move the bodies, or choose other places");
}

tl::unexpected<Refused> no_joint(JointId id) {
  return refuse(Refusal::joint_missing,
                "there is no joint " + std::to_string(id) + ": it may have broken, or lost a body");
}

void enter(World::State& state, JointId id, std::shared_ptr<const Joint> joint, uint64_t owner) {
  if (const JointSide* const side = side_in_terrain(*joint))
    state.anchors[brick_of(anchor_voxel(state, side->place_m))].insert(id);
  const uint64_t hash = hash_of(id, *joint, owner);
  const bool is_new = state.joints.try_emplace(id, WorldJoint{std::move(joint), owner, hash}).second;
  CHECK(is_new);
}

/// The place of a side that is still there.
std::optional<glm::vec3> place_of(const World::State& state, const Joint& joint) {
  for (const JointSide& side : {joint.a, joint.b})
    if (const std::optional<Pose> at = placed(state, side)) return at->position_m;
  return std::nullopt;
}

void take_out(World::State& state, JointId id, JointEnd why, TickDelta& delta) {
  const auto found = state.joints.find(id);
  CHECK(found != state.joints.end());
  if (const JointSide* const side = side_in_terrain(*found->second.joint)) {
    const auto there = state.anchors.find(brick_of(anchor_voxel(state, side->place_m)));
    CHECK(there != state.anchors.end());
    there->second.erase(id);
    if (there->second.empty()) state.anchors.erase(there);
  }
  const Joint& joint = *found->second.joint;
  delta.told.push_back({.kind = EventKind::joint_ended,
                        .tick = delta.tick,
                        .place_m = place_of(state, joint),
                        .text = std::string(name_of(why)),
                        .body = joint.a.body,
                        .other = joint.b.body});
  state.joints.erase(found);
  delta.joints_removed.push_back({id, why});
}

/// Only joints whose brick changed are looked at.
void let_go(World::State& state, TickDelta& delta) {
  if (state.anchors.empty()) return;
  std::vector<JointId> loose;
  for (const BrickCoord brick : state.changed) {
    const auto there = state.anchors.find(brick);
    if (there == state.anchors.end()) continue;
    for (const JointId id : there->second)
      if (!lies_in_rock(state, side_in_terrain(*state.joints.at(id).joint)->place_m)) loose.push_back(id);
  }
  for (const JointId id : loose) {
    state.bodies.remove_joint(id);
    take_out(state, id, JointEnd::let_go, delta);
  }
}

}  // namespace

CheckedRequest check(const World::State& state, const AddJointRequest& request) {
  const Joint& joint = request.joint;
  if (const Result<void> valid = validate(joint); !valid)
    return refuse(Refusal::joint_invalid, valid.error().message);
  TRY(check_side(state, joint.a));
  TRY(check_side(state, joint.b));
  if (!can_be_moved(state, joint.a) && !can_be_moved(state, joint.b))
    return refuse(Refusal::joint_invalid, "neither side of the joint is a body that can be moved");
  TRY(check_gap(state, joint));
  if (state.joints.size() < state.config.joints_max) return {};
  return refuse(Refusal::joints_max, std::to_string(state.joints.size()) +
                                         " joints are there, which is this server's limit (joints-max): "
                                         "remove some, or have the limit raised (--joints-max)");
}

CheckedRequest check(const World::State& state, const RemoveJointRequest& request) {
  if (!state.bodies.has_joint(request.joint)) return no_joint(request.joint);
  return {};
}

CheckedRequest check(const World::State& state, const SetMotorRequest& request) {
  if (!state.bodies.has_joint(request.joint)) return no_joint(request.joint);
  const JointKind kind = state.joints.at(request.joint).joint->kind;
  if (!traits_of(kind).has_axis)
    return refuse(Refusal::joint_invalid,
                  "a joint of kind " + std::string(name_of(kind)) + " has no axis for a motor");
  if (const Result<void> valid = validate(request.motor, kind); !valid)
    return refuse(Refusal::joint_invalid, valid.error().message);
  return {};
}

uint32_t perform(World::State& state, const AddJointRequest& request, uint64_t party, TickDelta& delta) {
  Joint joint = request.joint;
  for (JointSide* side : {&joint.a, &joint.b})
    side->turn = side->turn / std::sqrt(glm::dot(side->turn, side->turn));
  const JointId id = state.next_piece++;
  auto shared = std::make_shared<const Joint>(joint);
  enter(state, id, shared, party);
  state.bodies.add_joint(id, *shared);
  delta.joints_added.push_back({id, std::move(shared)});
  return id;
}

uint32_t perform(World::State& state, const RemoveJointRequest& request, uint64_t /*party*/,
                 TickDelta& delta) {
  state.bodies.remove_joint(request.joint);
  take_out(state, request.joint, JointEnd::removed, delta);
  return 0;
}

uint32_t perform(World::State& state, const SetMotorRequest& request, uint64_t /*party*/, TickDelta& delta) {
  WorldJoint& known = state.joints.at(request.joint);
  Joint joint = *known.joint;
  joint.motor = request.motor;
  known.joint = std::make_shared<const Joint>(joint);
  known.hash = hash_of(request.joint, joint, known.owner);
  state.bodies.set_motor(request.joint, joint.motor);
  delta.joints_added.push_back({request.joint, known.joint});
  return 0;
}

void end_joints(World::State& state, TickDelta& delta) {
  for (const auto& [id, why] : state.bodies.take_broken_joints()) take_out(state, id, why, delta);
  let_go(state, delta);
  sort_joints(delta);
}

Result<std::vector<KnownJoint>> restore_joints(World::State& state, const std::vector<JointRecord>& records) {
  if (records.size() > limits::joints_max_max)
    return fail("it has " + std::to_string(records.size()) + " joints; a world has at most " +
                std::to_string(limits::joints_max_max) + " (limits.joints_max_max)");
  std::vector<KnownJoint> known;
  for (const auto& [id, owner, joint] : records) {
    if (id == 0 || id >= state.next_piece || state.pieces.contains(id) || state.props.contains(id) ||
        state.joints.contains(id))
      return fail("joint " + std::to_string(id) + " is none yet, or has another's id");
    if (const Result<void> valid = validate(*joint); !valid)
      return fail("joint " + std::to_string(id) + ": " + valid.error().message);
    enter(state, id, joint, owner);
    known.push_back({id, *joint});
  }
  return known;
}

void drop_joints_without(const std::vector<BodyMotion>& bodies, std::vector<JointRecord>& records) {
  const auto is_lost = [&](const JointSide& side) {
    return !side.holds_terrain() && !std::ranges::binary_search(bodies, side.body, {}, &BodyMotion::id);
  };
  std::erase_if(records, [&](const JointRecord& record) {
    return is_lost(record.joint->a) || is_lost(record.joint->b);
  });
}

}  // namespace scree
