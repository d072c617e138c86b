// Props and the requests about them in words, as message_words.h.
#pragma once

#include "tests/proto/message_words.h"
#include "tests/proto/store_words.h"

namespace scree {

inline std::string words(const glm::quat& turn) {
  return fmt::format("({}, {}, {}, {})", turn.x, turn.y, turn.z, turn.w);
}

inline Lines words(const Prop& prop) {
  Lines lines;
  for (const PropPart& part : prop.parts)
    lines.push_back(fmt::format("part: {}, place {}, turn {}, half {}, {} corners", name_of(part.kind),
                                words(part.place_m), words(part.turn), words(part.half_m),
                                part.corners_m.size()));
  lines.push_back(fmt::format("{}, mass {} kg, friction {}, restitution {}, drag {}, of spin {}, gravity {}",
                              name_of(prop.motion), prop.mass_kg, prop.friction, prop.restitution, prop.drag,
                              prop.spin_drag, prop.gravity));
  lines.push_back(fmt::format("groups 0x{:08x}, meets 0x{:08x}, material {}, tag {}, {} bytes of data",
                              prop.groups, prop.meets, row_number(prop.material), prop.tag,
                              prop.data.size()));
  return lines;
}

inline Lines describe(const AddPropMessage& m) {
  Lines lines{
      fmt::format("add prop: request {}, place {}, turn {}", m.request, words(m.place_m), words(m.turn)),
      fmt::format("velocity {}, spin {}", words(m.velocity_m_s), words(m.spin_rad_s))};
  append(lines, words(m.prop));
  return lines;
}
inline Lines describe(const RemovePropMessage& m) {
  return {fmt::format("remove prop: request {}, prop {}", m.request, m.prop)};
}
inline Lines describe(const MovePropMessage& m) {
  Lines lines{fmt::format("move prop: request {}, prop {}", m.request, m.prop)};
  if (m.place_m) lines.push_back("place " + words(*m.place_m));
  if (m.turn) lines.push_back("turn " + words(*m.turn));
  if (m.velocity_m_s) lines.push_back("velocity " + words(*m.velocity_m_s));
  if (m.spin_rad_s) lines.push_back("spin " + words(*m.spin_rad_s));
  return lines;
}
inline Lines describe(const PushMessage& m) {
  return {fmt::format("push: request {}, body {}, {} N s at {}", m.request, m.body, words(m.impulse_n_s),
                      words(m.at_m))};
}
inline Lines describe(const BreakMessage& m) {
  return {fmt::format("break: request {}, piece {} at {}, {} seeds, random seed 0x{:08x}", m.request, m.piece,
                      words(m.at_m), m.seeds, m.random_seed)};
}
inline Lines describe(const BlastMessage& m) {
  return {fmt::format("blast: request {}, {} J at {}, random seed 0x{:08x}", m.request, m.energy_j,
                      words(m.centre_m), m.random_seed)};
}
inline Lines describe(const CutOutMessage& m) {
  return {fmt::format("cut out: request {}, {}", m.request, words(m.shape))};
}
inline Lines describe(const ReleaseMessage& m) {
  return {fmt::format("release: request {}, piece {}", m.request, m.piece)};
}
inline Lines describe(const AddPieceMessage& m) {
  const auto& volume = m.volume;
  Lines lines{fmt::format("add piece: request {}, place {}, turn {}, {}", m.request, words(m.place_m),
                          words(m.turn), m.kept ? "kept" : "merges"),
              fmt::format("velocity {}, spin {}", words(m.velocity_m_s), words(m.spin_rad_s))};
  if (!volume) return lines;
  const VoxelCoord lo = volume->window.box.lo, size = volume->window.box.size();
  const auto is_solid = [](Code code) { return code < 0; };
  lines.push_back(fmt::format("volume: {} x {} x {} voxels from ({}, {}, {}), {} of them solid", size.x,
                              size.y, size.z, lo.x, lo.y, lo.z,
                              std::ranges::count_if(volume->window.codes, is_solid)));
  return lines;
}
inline Lines describe(const ContactsMessage& m) {
  Lines lines{fmt::format("contacts: tick {}", m.tick)};
  for (const ContactEvent& one : m.contacts)
    lines.push_back(fmt::format("body {}, other {}, at {}, normal {}, {} N s, {} J", one.body, one.other,
                                words(one.place_m), words(one.normal), one.impulse_n_s, one.energy_j));
  return lines;
}
inline Lines describe(const PropMessage& m) {
  Lines lines{fmt::format("prop: {} {}", m.id, words(m.pose))};
  append(lines, words(m.prop));
  return lines;
}

inline std::string words(const JointSide& side) {
  return fmt::format("body {}, place {}, turn {}", side.body, words(side.place_m), words(side.turn));
}
inline Lines words(const Joint& joint) {
  Lines lines{"a: " + words(joint.a), "b: " + words(joint.b)};
  if (joint.limits) lines.push_back(fmt::format("from {} to {}", joint.limits->low, joint.limits->high));
  lines.push_back(fmt::format("motor {} by {} at most, length {} m", joint.motor.speed, joint.motor.greatest,
                              joint.length_m));
  lines.push_back(fmt::format("breaks at {} N, {} N m; {}", joint.break_force_n, joint.break_torque_nm,
                              joint.touches ? "its bodies touch" : "its bodies do not touch"));
  return lines;
}
inline Lines describe(const AddJointMessage& m) {
  Lines lines{fmt::format("add joint: request {}, {}", m.request, name_of(m.joint.kind))};
  append(lines, words(m.joint));
  return lines;
}
inline Lines describe(const RemoveJointMessage& m) {
  return {fmt::format("remove joint: request {}, joint {}", m.request, m.joint)};
}
inline Lines describe(const SetMotorMessage& m) {
  return {fmt::format("set motor: request {}, joint {}, {} by {} at most", m.request, m.joint, m.motor.speed,
                      m.motor.greatest)};
}
inline Lines words(const KnownJoint& one) {
  Lines lines{fmt::format("joint {}: {}", one.id, name_of(one.joint.kind))};
  append(lines, words(one.joint));
  return lines;
}
inline Lines describe(const JointsMessage& m) {
  Lines lines;
  for (const KnownJoint& one : m.here) append(lines, words(one));
  for (const EndedJoint& one : m.gone)
    lines.push_back(fmt::format("joint {} is gone: {}", one.id, name_of(one.why)));
  return lines;
}

inline Lines describe(const StoneMessage& m) {
  Lines lines{fmt::format("stone: {} {}, lies 0x{:08x}", m.id, words(m.pose), m.lies)};
  append(lines, words(m.volume));
  return lines;
}
inline Lines describe(const KeptPiecesMessage& m) {
  return {fmt::format("kept pieces: {}", fmt::join(m.kept, " ")),
          fmt::format("released: {}", fmt::join(m.released, " "))};
}
inline Lines describe(const StandMessage& m) {
  return {fmt::format("stand: request {}{}{}", m.request, m.place_m ? " at " + words(*m.place_m) : "",
                      m.away ? ", away" : "")};
}
inline Lines describe(const WalkMessage& m) {
  return {fmt::format("walk: number {}, go {}{}{}, look {}", m.request, words(m.input.go),
                      m.input.fast ? ", fast" : "", m.input.jump ? ", jump" : "", words(m.look))};
}
inline Lines describe(const PersonPlacesMessage& m) {
  Lines lines{fmt::format("person places: tick {}", m.tick)};
  if (m.persons)
    for (const PersonBody& person : *m.persons)
      lines.push_back(fmt::format("session {}: body {}", person.session, person.body));
  if (m.own)
    lines.push_back(fmt::format("own: input {} taken, feet {}, speed {}, {} s left, {}", m.own->taken,
                                words(m.own->walker.feet_m), words(m.own->walker.speed_m_s),
                                m.own->walker.time_left_s, m.own->walker.stands ? "stands" : "falls"));
  return lines;
}
inline Lines describe(const AdminListMessage& m) {
  Lines lines{fmt::format("admin list: request {}", m.request)};
  for (const SessionRow& row : m.sessions) {
    lines.push_back(fmt::format("session: {}, name '{}', program '{}', address '{}', role {}", row.session,
                                row.name, row.program, row.address, name_of(row.role)));
    lines.push_back(fmt::format("token 0x{:016x}, joined {} s ago, sent {} bytes, encrypted: {}",
                                row.token_id, row.joined_s, row.sent_bytes, row.encrypted));
  }
  for (const BanRow& row : m.bans)
    lines.push_back(fmt::format("ban: '{}', {} s left, reason '{}'", row.address, row.left_s, row.reason));
  for (const BodyRow& row : m.bodies) {
    lines.push_back(fmt::format("body {}: {}{}, ({}, {}, {}), rotation 0x{:08x}", row.id,
                                row.kept ? "kept " : "",
                                row.is_prop ? std::string(name_of(row.motion)) + " prop" : "piece",
                                row.pose.x, row.pose.y, row.pose.z, row.pose.rotation));
    lines.push_back(fmt::format("velocity {}, {} kg, tag {}", words(row.velocity_m_s), row.mass_kg, row.tag));
  }
  for (const KnownJoint& one : m.joints) append(lines, words(one));
  append(lines, words(m.stores));
  for (const RegionMass& mass : m.region_masses)
    lines.push_back(fmt::format(
        "region {}, party {}: {} of material {}: pieces {}, dust {}, carried {}, back {}, away {}",
        mass.origin.region, mass.origin.party, mass.cut, row_number(mass.material), mass.pieces, mass.dust,
        mass.carried, mass.back, mass.away));
  for (const SlowTickRow& row : m.slow_ticks) append(lines, words(row));
  for (const PartyRow& row : m.parties) lines.push_back(words(row));
  if (m.left_out > 0) lines.push_back(fmt::format("{} more are left out", m.left_out));
  if (!m.text.empty()) lines.push_back(fmt::format("text: {}", m.text));
  return lines;
}

}  // namespace scree
