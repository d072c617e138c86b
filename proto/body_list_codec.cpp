#include "proto/body_list_codec.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

#include "proto/joint_codec.h"
#include "proto/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

template <typename To>
void write_within(To& to, const std::optional<PlacesWithin>& from) {
  if (!from) return;
  scree::write(*to.mutable_lo(), from->lo_m);
  scree::write(*to.mutable_hi(), from->hi_m);
}

template <typename From>
std::optional<PlacesWithin> read_within(const From& from, FieldChecker& check) {
  if (!from.has_lo() && !from.has_hi()) return std::nullopt;
  return PlacesWithin{check.vec3(from.lo(), "lower corner of a list's box"),
                      check.vec3(from.hi(), "upper corner of a list's box")};
}

void write_body(wire::BodyRow& to, const BodyRow& from) {
  to.set_id(from.id);
  to.set_prop(from.is_prop);
  to.set_motion(static_cast<wire::PropMotion>(from.motion));
  to.set_kept(from.kept);
  to.set_x(from.pose.x);
  to.set_y(from.pose.y);
  to.set_z(from.pose.z);
  to.set_rotation(from.pose.rotation);
  scree::write(*to.mutable_velocity_m_s(), from.velocity_m_s);
  to.set_mass_kg(from.mass_kg);
  to.set_tag(from.tag);
}

BodyRow read_body(const wire::BodyRow& from, FieldChecker& check) {
  BodyRow row;
  row.id = from.id();
  row.is_prop = from.prop();
  row.motion = check.kind_or(from.motion(), PropMotion::dynamic);
  row.kept = from.kept();
  row.pose = {from.x(), from.y(), from.z(), from.rotation()};
  for (const int32_t position : {from.x(), from.y(), from.z()})
    if (position < -limits::pose_coordinate_max || position > limits::pose_coordinate_max)
      check.refuse("position of a body is 2^30 steps or more from the origin");
  row.velocity_m_s = check.vec3(from.velocity_m_s(), "velocity of a body");
  row.mass_kg = check.not_negative(from.mass_kg(), "mass of a body");
  row.tag = from.tag();
  return row;
}

using WirePieces = google::protobuf::RepeatedField<uint32_t>;

std::vector<PieceId> read_pieces(const WirePieces& from, const char* what, FieldChecker& check) {
  if (static_cast<size_t>(from.size()) > limits::kept_pieces_max)
    check.refuse(fmt::format("{} {} are over the limit of {}", from.size(), what, limits::kept_pieces_max));
  else if (std::adjacent_find(from.begin(), from.end(), std::greater_equal<>()) != from.end())
    check.refuse(fmt::format("the ids of {} do not ascend", what));
  else
    return {from.begin(), from.end()};
  return {};
}

}  // namespace

void write(wire::ListBodies& to, const ListBodiesRequest& from) {
  write_within(to, from.within);
  CHECK(from.ids.size() <= limits::bodies_named_max);
  to.mutable_ids()->Add(from.ids.begin(), from.ids.end());
}

void write(wire::ListJoints& to, const ListJointsRequest& from) {
  write_within(to, from.within);
}

void write_bodies(wire::AdminList& to, const AdminListMessage& from) {
  const size_t bodies = std::min(from.bodies.size(), limits::admin_rows_max);
  const size_t joints = std::min(from.joints.size(), limits::admin_rows_max);
  for (size_t i = 0; i < bodies; ++i) write_body(*to.add_bodies(), from.bodies[i]);
  for (size_t i = 0; i < joints; ++i) write(*to.add_joints(), from.joints[i]);
  const size_t cut = from.bodies.size() - bodies + from.joints.size() - joints;
  to.set_left_out(from.left_out + static_cast<uint32_t>(cut));
}

void write(wire::KeptPieces& to, const KeptPiecesMessage& from) {
  CHECK(from.kept.size() <= limits::kept_pieces_max && from.released.size() <= limits::kept_pieces_max);
  to.mutable_kept()->Add(from.kept.begin(), from.kept.end());
  to.mutable_released()->Add(from.released.begin(), from.released.end());
}

ListBodiesRequest read(const wire::ListBodies& from, FieldChecker& check) {
  ListBodiesRequest list{read_within(from, check), {}};
  if (static_cast<size_t>(from.ids_size()) > limits::bodies_named_max)
    check.refuse(fmt::format("{} ids of bodies to list are over the limit of {}", from.ids_size(),
                             limits::bodies_named_max));
  else
    list.ids.assign(from.ids().begin(), from.ids().end());
  return list;
}

ListJointsRequest read(const wire::ListJoints& from, FieldChecker& check) {
  return {read_within(from, check)};
}

void read_bodies(const wire::AdminList& from, AdminListMessage& to, FieldChecker& check) {
  for (const wire::BodyRow& row : from.bodies()) to.bodies.push_back(read_body(row, check));
  for (const wire::JointHere& row : from.joints()) to.joints.push_back(read(row, check));
  to.left_out = from.left_out();
}

KeptPiecesMessage read(const wire::KeptPieces& from, FieldChecker& check) {
  return {read_pieces(from.kept(), "kept pieces", check),
          read_pieces(from.released(), "released pieces", check)};
}

}  // namespace scree
