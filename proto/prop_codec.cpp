#include "proto/prop_codec.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/content_codec.h"
#include "proto/limits.h"
#include "proto/operation_codec.h"
#include "shared/operation/added_piece_limits.h"
#include "shared/prop/limits.h"

namespace scree {

namespace {

static_assert(wire::PropPartKind_ARRAYSIZE == kind_count<PropPartKind>);
static_assert(wire::PropMotion_ARRAYSIZE == kind_count<PropMotion>);

constexpr glm::quat no_turn(1.0F, 0.0F, 0.0F, 0.0F);
constexpr glm::vec3 no_vector(0.0F);

void write_turn(wire::Turn& to, const glm::quat& from) {
  to.set_x(from.x);
  to.set_y(from.y);
  to.set_z(from.z);
  to.set_w(from.w);
}

glm::quat read_turn(const wire::Turn& from, const char* what, FieldChecker& check) {
  return {check.finite(from.w(), what), check.finite(from.x(), what), check.finite(from.y(), what),
          check.finite(from.z(), what)};
}

void write_part(wire::PropPart& to, const PropPart& from) {
  to.set_kind(static_cast<wire::PropPartKind>(from.kind));
  if (!same_bits(from.place_m, no_vector)) scree::write(*to.mutable_place(), from.place_m);
  if (!same_bits(from.turn, no_turn)) write_turn(*to.mutable_turn(), from.turn);
  if (from.kind != PropPartKind::hull || !same_bits(from.half_m, PropPart().half_m))
    scree::write(*to.mutable_half(), from.half_m);
  to.set_corners(pack_points(from.corners_m));
}

PropPart read_part(const wire::PropPart& from, FieldChecker& check) {
  PropPart part;
  part.kind = check.asked_kind<PropPartKind>(from.kind(), "kind of a prop's part");
  part.place_m = check.vec3(from.place(), "place of a prop's part");
  if (from.has_turn()) part.turn = read_turn(from.turn(), "turn of a prop's part", check);
  if (from.has_half()) part.half_m = check.vec3(from.half(), "half of a prop's part");
  part.corners_m = check.points(from.corners(), limits::prop_corners_max, "corners of a prop's part");
  return part;
}

Prop read_prop(const wire::Prop& from, FieldChecker& check) {
  Prop prop;
  if (static_cast<size_t>(from.parts_size()) > limits::prop_parts_max)
    check.refuse(fmt::format("{} parts of a prop are over the limit of {}", from.parts_size(),
                             limits::prop_parts_max));
  for (int i = 0; i < from.parts_size() && !check.failed(); ++i)
    prop.parts.push_back(read_part(from.parts(i), check));
  prop.motion = check.asked_kind<PropMotion>(from.motion(), "motion of a prop");
  prop.mass_kg = check.not_negative(from.mass_kg(), "mass of a prop");
  if (from.has_friction()) prop.friction = check.not_negative(from.friction(), "friction of a prop");
  if (from.has_restitution())
    prop.restitution = check.not_negative(from.restitution(), "restitution of a prop");
  prop.drag = check.not_negative(from.drag(), "drag of a prop");
  prop.spin_drag = check.not_negative(from.spin_drag(), "drag of a prop's spin");
  if (from.has_gravity()) prop.gravity = check.finite(from.gravity(), "gravity of a prop");
  if (from.has_groups()) prop.groups = from.groups();
  if (from.has_meets()) prop.meets = from.meets();
  prop.material = check.asked_material(from.material());
  if (!from.model().empty()) prop.model = read_digest(from.model(), "model of a prop", check);
  prop.tag = from.tag();
  const std::string data = check.bytes(from.data(), limits::prop_data_bytes_max, "data of a prop");
  prop.data.assign(data.begin(), data.end());
  return prop;
}

/// Null where there are too many bytes or voxels, or none that can be read: the world refuses it by name.
std::shared_ptr<const Volume> read_added(std::span<const uint8_t> bytes) {
  if (bytes.size() > limits::added_piece_bytes_max) return nullptr;
  const Result<VoxelBox> box = decode_volume_box(bytes);
  if (!box || !is_box_of_added_piece(*box)) return nullptr;
  Result<Volume> volume = decode_volume(bytes);
  return volume ? std::make_shared<const Volume>(std::move(*volume)) : nullptr;
}

}  // namespace

void write(wire::Prop& to, const Prop& from) {
  for (const PropPart& part : from.parts) write_part(*to.add_parts(), part);
  to.set_motion(static_cast<wire::PropMotion>(from.motion));
  to.set_mass_kg(from.mass_kg);
  const Prop usual;
  if (from.friction != usual.friction) to.set_friction(from.friction);
  if (from.restitution != usual.restitution) to.set_restitution(from.restitution);
  to.set_drag(from.drag);
  to.set_spin_drag(from.spin_drag);
  if (from.gravity != usual.gravity) to.set_gravity(from.gravity);
  if (from.groups != usual.groups) to.set_groups(from.groups);
  if (from.meets != usual.meets) to.set_meets(from.meets);
  to.set_material(static_cast<uint32_t>(from.material));
  if (from.model) to.set_model(wire_digest(*from.model));
  to.set_tag(from.tag);
  to.set_data(std::string(from.data.begin(), from.data.end()));
}

void write(wire::AddProp& to, const AddPropMessage& from) {
  to.set_request(from.request);
  write(*to.mutable_prop(), from.prop);
  scree::write(*to.mutable_place(), from.place_m);
  if (!same_bits(from.turn, no_turn)) write_turn(*to.mutable_turn(), from.turn);
  if (!same_bits(from.velocity_m_s, no_vector)) write(*to.mutable_velocity_m_s(), from.velocity_m_s);
  if (!same_bits(from.spin_rad_s, no_vector)) write(*to.mutable_spin_rad_s(), from.spin_rad_s);
}

void write(wire::RemoveProp& to, const RemovePropMessage& from) {
  to.set_request(from.request);
  to.set_prop(from.prop);
}

void write(wire::MoveProp& to, const MovePropMessage& from) {
  to.set_request(from.request);
  to.set_prop(from.prop);
  if (from.place_m) write(*to.mutable_place(), *from.place_m);
  if (from.turn) write_turn(*to.mutable_turn(), *from.turn);
  if (from.velocity_m_s) write(*to.mutable_velocity_m_s(), *from.velocity_m_s);
  if (from.spin_rad_s) write(*to.mutable_spin_rad_s(), *from.spin_rad_s);
}

void write(wire::Push& to, const PushMessage& from) {
  to.set_request(from.request);
  to.set_body(from.body);
  write(*to.mutable_impulse_n_s(), from.impulse_n_s);
  write(*to.mutable_at(), from.at_m);
}

void write(wire::Break& to, const BreakMessage& from) {
  to.set_request(from.request);
  to.set_piece(from.piece);
  write(*to.mutable_at(), from.at_m);
  to.set_seeds(from.seeds);
  to.set_random_seed(from.random_seed);
}

void write(wire::Blast& to, const BlastMessage& from) {
  to.set_request(from.request);
  write(*to.mutable_centre(), from.centre_m);
  to.set_energy_j(from.energy_j);
  to.set_random_seed(from.random_seed);
}

void write(wire::CutOut& to, const CutOutMessage& from) {
  to.set_request(from.request);
  write(*to.mutable_shape(), from.shape);
}

void write(wire::Release& to, const ReleaseMessage& from) {
  to.set_request(from.request);
  to.set_piece(from.piece);
}

void write(wire::AddPiece& to, const AddPieceMessage& from) {
  to.set_request(from.request);
  if (from.volume) to.set_volume(to_string(encode_volume(*from.volume)));
  scree::write(*to.mutable_place(), from.place_m);
  if (from.turn != no_turn) write_turn(*to.mutable_turn(), from.turn);
  scree::write(*to.mutable_velocity_m_s(), from.velocity_m_s);
  scree::write(*to.mutable_spin_rad_s(), from.spin_rad_s);
  to.set_merges(!from.kept);
}

void write(wire::PropHere& to, const PropMessage& from) {
  to.set_id(from.id);
  write(*to.mutable_prop(), from.prop);
  to.set_x(from.pose.x);
  to.set_y(from.pose.y);
  to.set_z(from.pose.z);
  to.set_rotation(from.pose.rotation);
}

AddPropMessage read(const wire::AddProp& from, FieldChecker& check) {
  AddPropMessage add;
  add.request = from.request();
  add.prop = read_prop(from.prop(), check);
  add.place_m = check.vec3(from.place(), "place of a prop");
  if (from.has_turn()) add.turn = read_turn(from.turn(), "turn of a prop", check);
  add.velocity_m_s = check.vec3(from.velocity_m_s(), "velocity of a prop");
  add.spin_rad_s = check.vec3(from.spin_rad_s(), "spin of a prop");
  return add;
}

RemovePropMessage read(const wire::RemoveProp& from, FieldChecker& /*check*/) {
  return {{from.prop()}, from.request()};
}

MovePropMessage read(const wire::MoveProp& from, FieldChecker& check) {
  MovePropMessage move;
  move.request = from.request();
  move.prop = from.prop();
  if (from.has_place()) move.place_m = check.vec3(from.place(), "place of a prop");
  if (from.has_turn()) move.turn = read_turn(from.turn(), "turn of a prop", check);
  if (from.has_velocity_m_s()) move.velocity_m_s = check.vec3(from.velocity_m_s(), "velocity of a prop");
  if (from.has_spin_rad_s()) move.spin_rad_s = check.vec3(from.spin_rad_s(), "spin of a prop");
  return move;
}

PushMessage read(const wire::Push& from, FieldChecker& check) {
  return {{from.body(), check.vec3(from.impulse_n_s(), "impulse"), check.vec3(from.at(), "place of a push")},
          from.request()};
}

BreakMessage read(const wire::Break& from, FieldChecker& check) {
  return {{from.piece(), check.vec3(from.at(), "place of a break"), from.seeds(), from.random_seed()},
          from.request()};
}

BlastMessage read(const wire::Blast& from, FieldChecker& check) {
  return {{check.vec3(from.centre(), "centre of a blast"), check.finite(from.energy_j(), "energy of a blast"),
           from.random_seed()},
          from.request()};
}

CutOutMessage read(const wire::CutOut& from, FieldChecker& check) {
  return {{check.shape(from.shape())}, from.request()};
}

ReleaseMessage read(const wire::Release& from, FieldChecker& /*check*/) {
  return {{from.piece()}, from.request()};
}

AddPieceMessage read(const wire::AddPiece& from, FieldChecker& check) {
  AddPieceMessage add;
  add.request = from.request();
  add.volume = read_added(as_span(from.volume()));
  add.place_m = check.vec3(from.place(), "place of a piece");
  if (from.has_turn()) add.turn = read_turn(from.turn(), "turn of a piece", check);
  add.velocity_m_s = check.vec3(from.velocity_m_s(), "velocity of a piece");
  add.spin_rad_s = check.vec3(from.spin_rad_s(), "spin of a piece");
  add.kept = !from.merges();
  return add;
}

PropMessage read(const wire::PropHere& from, FieldChecker& check) {
  PropMessage here;
  here.id = from.id();
  here.prop = read_prop(from.prop(), check);
  if (!check.unknown().empty()) check.refuse(check.unknown() + " is unknown");
  if (const Result<void> valid = validate(here.prop); !valid) check.refuse(valid.error().message);
  if (!(here.prop.mass_kg > 0.0F)) check.refuse("a prop without a mass");
  for (const int32_t position : {from.x(), from.y(), from.z()})
    if (position < -limits::pose_coordinate_max || position > limits::pose_coordinate_max)
      check.refuse("position of a prop is 2^30 steps or more from the origin");
  here.pose = {from.x(), from.y(), from.z(), from.rotation()};
  return here;
}

}  // namespace scree
