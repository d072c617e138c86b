#include "proto/physics_codec.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "proto/byte_stream.h"
#include "proto/limits.h"
#include "shared/base/text.h"

namespace scree {
namespace {

constexpr float steps_per_m = 256.0F;
constexpr int64_t corner_max = 1 << 16;
constexpr int64_t point_max = 1 << 21;
constexpr float steps_per_unit = 127.0F;
constexpr int64_t unit_max = 127;
constexpr uint8_t awake_bit = 1;
constexpr uint8_t island_bit = 2;

void write_steps(ByteWriter& writer, glm::vec3 value, float steps, int64_t max) {
  for (const float part : {value.x, value.y, value.z})
    writer.zigzag(std::clamp(static_cast<int64_t>(std::lround(part * steps)), -max, max));
}

glm::vec3 read_steps(ByteReader& reader, const char* what, float steps, int64_t max) {
  glm::vec3 value;
  for (int i = 0; i < 3; ++i) value[i] = static_cast<float>(reader.zigzag(what, max)) / steps;
  return value;
}

std::vector<uint8_t> pack(const std::vector<BodyView>& bodies) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  PieceId before = 0;
  for (const BodyView& body : std::span(bodies).first(std::min(bodies.size(), limits::physics_bodies_max))) {
    writer.varint(body.id - before);
    before = body.id;
    writer.u8(static_cast<uint8_t>((body.awake ? awake_bit : 0) | (body.island ? island_bit : 0)));
    const size_t corners = std::min(body.hull_m.size(), limits::hull_corners_max);
    writer.varint(corners);
    for (size_t i = 0; i < corners; ++i) write_steps(writer, body.hull_m[i], steps_per_m, corner_max);
  }
  return bytes;
}

std::vector<BodyView> unpack_bodies(const std::string& packed, FieldChecker& check) {
  std::vector<BodyView> bodies;
  ByteReader reader(as_span(packed), "watched bodies");
  uint64_t id = 0;
  while (!reader.at_end()) {
    if (bodies.size() == limits::physics_bodies_max) reader.refuse("too many");
    const uint64_t step = reader.varint("piece id", 0xFFFFFFFFULL);
    id += step;
    if ((step == 0 && !bodies.empty()) || id > 0xFFFFFFFFULL) reader.refuse("piece ids do not ascend");
    BodyView body;
    body.id = static_cast<PieceId>(id);
    const uint8_t state = reader.u8("state", awake_bit | island_bit);
    body.awake = (state & awake_bit) != 0;
    body.island = (state & island_bit) != 0;
    const uint64_t corners = reader.varint("corners", limits::hull_corners_max);
    for (uint64_t i = 0; i < corners && !reader.failed(); ++i)
      body.hull_m.push_back(read_steps(reader, "corner", steps_per_m, corner_max));
    bodies.push_back(std::move(body));
  }
  if (reader.failed()) check.refuse(reader.error().message);
  return bodies;
}

std::vector<uint8_t> pack(const std::vector<ContactView>& contacts) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  for (const ContactView& contact :
       std::span(contacts).first(std::min(contacts.size(), limits::physics_contacts_max))) {
    write_steps(writer, contact.point_m, steps_per_m, point_max);
    write_steps(writer, contact.normal, steps_per_unit, unit_max);
    writer.f32(contact.impulse_n_s);
  }
  return bytes;
}

std::vector<ContactView> unpack_contacts(const std::string& packed, FieldChecker& check) {
  std::vector<ContactView> contacts;
  ByteReader reader(as_span(packed), "watched contacts");
  while (!reader.at_end()) {
    if (contacts.size() == limits::physics_contacts_max) reader.refuse("too many");
    ContactView contact;
    contact.point_m = read_steps(reader, "point", steps_per_m, point_max);
    contact.normal = read_steps(reader, "normal", steps_per_unit, unit_max);
    contact.impulse_n_s = reader.f32("impulse");
    if (contact.impulse_n_s < 0.0F) reader.refuse("an impulse is negative");
    contacts.push_back(contact);
  }
  if (reader.failed()) check.refuse(reader.error().message);
  return contacts;
}

std::vector<BrickCoord> unpack_bricks(const std::string& packed, FieldChecker& check) {
  std::vector<BrickCoord> bricks;
  ByteReader reader(as_span(packed), "searched bricks");
  BrickCoord at;
  while (!reader.at_end()) {
    if (bricks.size() == limits::physics_bricks_max) reader.refuse("too many");
    at = read_coord(reader, at, limits::voxel_coordinate_max / brick_size, "a brick's coordinate");
    bricks.push_back(at);
  }
  if (reader.failed()) check.refuse(reader.error().message);
  return bricks;
}

}  // namespace

void write(wire::Cursors& to, const CursorsMessage& from) {
  for (const PlayerCursor& cursor :
       std::span(from.cursors).first(std::min(from.cursors.size(), limits::cursors_max))) {
    wire::PlayerCursor& one = *to.add_cursors();
    one.set_session(cursor.session);
    one.set_name(showable(cursor.name, limits::person_name_bytes_max));
    write(*one.mutable_eye(), cursor.eye_m);
    write(*one.mutable_aim(), cursor.aim_m);
  }
}

CursorsMessage read(const wire::Cursors& from, FieldChecker& check) {
  CursorsMessage message;
  if (static_cast<size_t>(from.cursors_size()) > limits::cursors_max) {
    check.refuse(
        fmt::format("{} cursors are over the limit of {}", from.cursors_size(), limits::cursors_max));
    return message;
  }
  for (const wire::PlayerCursor& cursor : from.cursors())
    message.cursors.push_back({cursor.session(),
                               check.text(cursor.name(), limits::person_name_bytes_max, "name"),
                               check.vec3(cursor.eye(), "eye"), check.vec3(cursor.aim(), "aim")});
  return message;
}

void write(wire::Physics& to, const PhysicsMessage& from) {
  to.set_tick(from.tick);
  to.set_bodies(to_string(pack(from.bodies)));
  to.set_contacts(to_string(pack(from.contacts)));
  std::vector<uint8_t> bricks;
  ByteWriter writer(bricks);
  write_coords<BrickTag>(
      writer, std::span(from.searched).first(std::min(from.searched.size(), limits::physics_bricks_max)));
  to.set_searched(to_string(bricks));
}

PhysicsMessage read(const wire::Physics& from, FieldChecker& check) {
  PhysicsMessage message;
  message.tick = from.tick();
  message.bodies = unpack_bodies(from.bodies(), check);
  message.contacts = unpack_contacts(from.contacts(), check);
  message.searched = unpack_bricks(from.searched(), check);
  return message;
}

void write(wire::Contacts& to, const ContactsMessage& from) {
  to.set_tick(from.tick);
  for (const ContactEvent& event :
       std::span(from.contacts).first(std::min(from.contacts.size(), limits::contact_events_max))) {
    wire::Contact& added = *to.add_contacts();
    added.set_body(event.body);
    added.set_other(event.other);
    write(*added.mutable_place(), event.place_m);
    write(*added.mutable_normal(), event.normal);
    added.set_impulse_n_s(event.impulse_n_s);
    added.set_energy_j(event.energy_j);
  }
}

ContactsMessage read(const wire::Contacts& from, FieldChecker& check) {
  ContactsMessage message;
  message.tick = from.tick();
  if (static_cast<size_t>(from.contacts_size()) > limits::contact_events_max)
    check.refuse(fmt::format("more than {} contacts", limits::contact_events_max));
  for (const wire::Contact& one : from.contacts()) {
    if (check.failed()) break;
    message.contacts.push_back({one.body(), one.other(), check.vec3(one.place(), "place of a contact"),
                                check.vec3(one.normal(), "normal of a contact"),
                                check.not_negative(one.impulse_n_s(), "impulse of a contact"),
                                check.not_negative(one.energy_j(), "energy of a contact")});
  }
  return message;
}

}  // namespace scree
