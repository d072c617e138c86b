#include "server/world/state_hash.h"

#define XXH_INLINE_ALL
#include <array>
#include <vector>
#include <xxhash.h>

namespace scree {

uint64_t state_hash(const HashedState& state) {
  const Ledger& ledger = state.ledger;
  const std::array<uint64_t, 9> words = {state.tick,
                                         state.field,
                                         state.bodies,
                                         state.next_piece,
                                         static_cast<uint64_t>(ledger.terrain),
                                         static_cast<uint64_t>(ledger.pieces),
                                         static_cast<uint64_t>(ledger.dust),
                                         static_cast<uint64_t>(ledger.poured),
                                         static_cast<uint64_t>(ledger.moved)};
  uint64_t hash = XXH3_64bits(words.data(), sizeof(words));
  for (const uint64_t sum : {state.props, state.joints, state.kept, state.regions, state.persons,
                             state.stores, state.provenance, state.game})
    if (sum != 0) hash = XXH3_64bits_withSeed(&sum, sizeof sum, hash);
  return hash;
}

namespace {

/// Puts the bytes of values one after the other.
struct Putting {
  std::vector<uint8_t> bytes;

  template <typename T>
  void operator()(const T& value) {
    const auto* const first = reinterpret_cast<const uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
  }
};

}  // namespace

uint64_t hash_of(PieceId id, const Prop& prop, uint64_t owner) {
  Putting put;
  put(id);
  put(owner);
  for (const PropPart& part : prop.parts) {
    put(part.kind);
    for (const glm::vec3& v : {part.place_m, part.half_m}) put(v);
    for (const float number : {part.turn.w, part.turn.x, part.turn.y, part.turn.z}) put(number);
    for (const glm::vec3& corner : part.corners_m) put(corner);
  }
  put(prop.motion);
  for (const float number :
       {prop.mass_kg, prop.friction, prop.restitution, prop.drag, prop.spin_drag, prop.gravity})
    put(number);
  for (const uint32_t bits : {prop.groups, prop.meets}) put(bits);
  put(prop.material);
  put(prop.tag);
  if (prop.model) put(*prop.model);
  put.bytes.insert(put.bytes.end(), prop.data.begin(), prop.data.end());
  return XXH3_64bits(put.bytes.data(), put.bytes.size());
}

uint64_t hash_of(const Region& region) {
  Putting put;
  const auto put_text = [&](const std::string& text) {
    put(text.size());
    put.bytes.insert(put.bytes.end(), text.begin(), text.end());
  };
  put(region.id);
  put_text(region.name);
  put(region.form);
  for (const glm::vec3& v : {region.centre_m, region.half_m}) put(v);
  put(region.forbids);
  put(region.editors);
  put(region.role);
  for (const std::string& person : region.persons) put_text(person);
  put(region.tells);
  put(region.until);
  // What regions could not have before counts where they have it.
  if (region.counts) put(region.counts);
  for (const std::string& team : region.teams) put_text(team);
  return XXH3_64bits(put.bytes.data(), put.bytes.size());
}

uint64_t hash_of_kept(PieceId id) {
  constexpr uint64_t seed = 0x6B657074;  // not that of another list
  return XXH3_64bits_withSeed(&id, sizeof id, seed);
}

uint64_t hash_of(const PersonRecord& person) {
  Putting put;
  put(person.session);
  put(person.body);
  for (const glm::vec3& v : {person.walker.feet_m, person.walker.speed_m_s, person.look}) put(v);
  put(person.walker.time_left_s);
  put(person.walker.stands);
  put(person.walker.still_ticks);
  for (const uint32_t number : {person.taken, person.credit, person.idle_ticks}) put(number);
  put(person.is_held);
  for (const WaitingInput& waiting : person.inputs) {
    put(waiting.number);
    for (const glm::vec3& v : {waiting.input.go, waiting.look}) put(v);
    put(waiting.input.fast);
    put(waiting.input.jump);
  }
  if (person.walker.pace != 1.0F) put(person.walker.pace);
  constexpr uint64_t seed = 0x7065727a;  // not that of another list
  return XXH3_64bits_withSeed(put.bytes.data(), put.bytes.size(), seed);
}

uint64_t hash_of(const StoreRecord& store) {
  Putting put;
  put(store.content.store.kind);
  put(store.content.store.number);
  const std::string& name = store.content.store.name;
  put.bytes.insert(put.bytes.end(), name.begin(), name.end());
  for (const MaterialMass& one : store.content.masses) {
    put(one.material);
    put(one.mass);
  }
  put(store.dug);
  put(store.dug_at);
  return XXH3_64bits(put.bytes.data(), put.bytes.size());
}

namespace {

void put_string(Putting& put, const std::string& text) {
  put(text.size());
  put.bytes.insert(put.bytes.end(), text.begin(), text.end());
}

uint64_t hash_as(const Putting& put, uint64_t list) {
  return XXH3_64bits_withSeed(put.bytes.data(), put.bytes.size(), list);
}

}  // namespace

uint64_t hash_of(const KeptValue& value) {
  Putting put;
  put_string(put, value.key);
  put_string(put, value.value);
  return hash_as(put, 0x6B65792E);
}

uint64_t hash_of(const Sign& sign) {
  Putting put;
  put_string(put, sign.name);
  put(sign.to.kind);
  put(sign.to.session);
  put_string(put, sign.to.team);
  put(sign.kind);
  put_string(put, sign.text);
  put(sign.share);
  put(sign.place_m);
  put(sign.colour);
  put(sign.until);
  put(sign.counts);
  return hash_as(put, 0x7369676E);
}

uint64_t hash_of(const Player& player) {
  Putting put;
  put(player.session);
  put_string(put, player.team);
  put(player.pace);
  return hash_as(put, 0x706C6179);
}

uint64_t hash_of(JointId id, const Joint& joint, uint64_t owner) {
  Putting put;
  put(id);
  put(owner);
  put(joint.kind);
  for (const JointSide* side : {&joint.a, &joint.b}) {
    put(side->body);
    put(side->place_m);
    for (const float number : {side->turn.w, side->turn.x, side->turn.y, side->turn.z}) put(number);
  }
  if (joint.limits)
    for (const float number : {joint.limits->low, joint.limits->high}) put(number);
  for (const float number :
       {joint.motor.speed, joint.motor.greatest, joint.length_m, joint.break_force_n, joint.break_torque_nm})
    put(number);
  put(joint.touches);
  return XXH3_64bits(put.bytes.data(), put.bytes.size());
}

}  // namespace scree
