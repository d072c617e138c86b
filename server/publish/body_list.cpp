#include "server/publish/body_list.h"

#include <algorithm>

#include "proto/limits.h"
#include "server/world/spawn.h"

namespace scree {

namespace {

/// False of a place that is no number.
bool lies_in(const std::optional<PlacesWithin>& box, glm::vec3 place_m) {
  if (!box) return true;
  for (int axis = 0; axis < 3; ++axis)
    if (!(place_m[axis] >= box->lo_m[axis] && place_m[axis] <= box->hi_m[axis])) return false;
  return true;
}

BodyRow body_row(const ListedWorld& world, const TrackedMotion& body) {
  BodyRow row;
  row.id = body.id;
  const float steps_a_second =
      static_cast<float>(world.rates.tick_rate_hz) / static_cast<float>(world.rates.ticks_per_transform);
  if (body.target.steps > 1)
    row.velocity_m_s = glm::vec3(body.target.moved) / static_cast<float>(motion_steps_per_m) * steps_a_second;
  if (const auto piece = world.state.pieces().find(body.id); piece != world.state.pieces().end()) {
    row.pose = piece->second.pose;
    if (world.palette != nullptr)
      row.mass_kg = mass_kg(*piece->second.volume, *world.palette, world.voxel_size_m);
    row.kept = std::ranges::binary_search(world.state.kept(), body.id);
    return row;
  }
  const PublishedProp& prop = world.state.props().at(body.id);
  row.is_prop = true;
  row.pose = prop.pose;
  row.motion = prop.prop->motion;
  row.mass_kg = prop.prop->mass_kg;
  row.tag = prop.prop->tag;
  return row;
}

/// The place of a joint's side; the pieces and props that joints hold are there.
glm::vec3 side_place(const PublishedState& state, const JointSide& side) {
  if (side.holds_terrain()) return side.place_m;
  const auto prop = state.props().find(side.body);
  const Pose pose =
      dequantise(prop != state.props().end() ? prop->second.pose : state.pieces().at(side.body).pose);
  return pose.position_m + pose.rotation * side.place_m;
}

}  // namespace

AdminListMessage list_bodies(const ListedWorld& world, const ListBodiesRequest& request) {
  AdminListMessage list;
  for (const TrackedMotion& body : world.motions.all()) {
    if (!request.ids.empty() && std::ranges::find(request.ids, body.id) == request.ids.end()) continue;
    if (!lies_in(request.within, body.place_m)) continue;
    if (list.bodies.size() < limits::admin_rows_max)
      list.bodies.push_back(body_row(world, body));
    else
      ++list.left_out;
  }
  return list;
}

AdminListMessage list_joints(const ListedWorld& world, const ListJointsRequest& request) {
  AdminListMessage list;
  for (const auto& [id, joint] : world.state.joints()) {
    const auto lies_within = [&](const JointSide& side) {
      return lies_in(request.within, side_place(world.state, side));
    };
    if (request.within && !lies_within(joint->a) && !lies_within(joint->b)) continue;
    if (list.joints.size() < limits::admin_rows_max)
      list.joints.push_back({id, *joint});
    else
      ++list.left_out;
  }
  return list;
}

}  // namespace scree
