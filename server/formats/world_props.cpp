#include "server/formats/world_props.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "server/formats/joint_lists.h"
#include "server/formats/recording_codec.h"
#include "server/formats/region_list.h"
#include "server/formats/world_game.h"
#include "server/formats/world_provenance.h"
#include "server/formats/world_stores.h"

namespace scree {

namespace {

/// More than a world has: it refuses them itself, by its own limits.
constexpr size_t hung_chunks_most = size_t{1} << 14, released_chunks_most = size_t{1} << 20;

void read_joint_records(const kept::Moment& from, WorldMoment& to, FieldChecker& check) {
  JointsMessage joints = read_joints(from.joints(), check);
  if (static_cast<size_t>(from.joint_owners_size()) != joints.here.size() || !joints.gone.empty())
    check.refuse("the joints of a world have no owners, or too many, or are gone");
  for (size_t i = 0; i < joints.here.size() && !check.failed(); ++i)
    to.joints.push_back({joints.here[i].id, from.joint_owners(static_cast<int>(i)),
                         std::make_shared<const Joint>(joints.here[i].joint)});
}

void write_region_records(kept::Moment& to, const WorldMoment& from) {
  if (!from.regions.empty()) to.set_regions(pack_regions(from.regions));
  for (const HungTerrain& hung : from.hung) {
    kept::HungTerrain& added = *to.add_hung();
    added.set_region(hung.region);
    added.set_chunks(pack_chunks(hung.chunks));
  }
  if (!from.released.empty()) to.set_released(pack_chunks(from.released));
}

std::vector<ChunkCoord> ascending_chunks(const std::string& packed, size_t most, FieldChecker& check) {
  std::vector<ChunkCoord> chunks = check.chunks(packed, most, "chunks of terrain that hangs");
  if (std::ranges::adjacent_find(chunks, std::ranges::greater_equal{}) != chunks.end())
    check.refuse("chunks of terrain that hangs are not in order");
  return chunks;
}

void read_region_records(const kept::Moment& from, WorldMoment& to, FieldChecker& check) {
  if (from.has_regions()) to.regions = unpack_regions(from.regions(), check);
  for (const kept::HungTerrain& hung : from.hung()) {
    if (check.failed()) break;
    to.hung.push_back({hung.region(), ascending_chunks(hung.chunks(), hung_chunks_most, check)});
    if (to.hung.size() > 1 && to.hung[to.hung.size() - 2].region >= hung.region())
      check.refuse("terrain that hangs is not in the order of its regions");
  }
  to.released = ascending_chunks(from.released(), released_chunks_most, check);
}

void write_person(kept::Person& to, const PersonRecord& from) {
  to.set_session(from.session);
  to.set_body(from.body);
  for (const glm::vec3& v : {from.walker.feet_m, from.walker.speed_m_s, from.look})
    for (const float number : {v.x, v.y, v.z}) to.add_walker(number);
  to.add_walker(from.walker.time_left_s);
  to.set_stands(from.walker.stands);
  to.set_still_ticks(static_cast<uint32_t>(from.walker.still_ticks));
  if (from.walker.pace != 1.0F) to.set_pace(from.walker.pace);
  to.set_taken(from.taken);
  to.set_credit(from.credit);
  to.set_idle_ticks(from.idle_ticks);
  to.set_held(from.is_held);
  std::vector<Command> inputs;
  for (const WaitingInput& waiting : from.inputs)
    inputs.push_back({from.session, waiting.number, WalkRequest{waiting.input, waiting.look}});
  const std::vector<uint8_t> packed = encode(inputs);
  if (!inputs.empty()) to.set_inputs(std::string(packed.begin(), packed.end()));
}

PersonRecord read_person(const kept::Person& from, FieldChecker& check) {
  PersonRecord person;
  person.session = from.session();
  person.body = from.body();
  constexpr int numbers = 10;
  if (from.walker_size() != numbers) {
    check.refuse("a person on foot has other numbers than ten");
    return person;
  }
  const auto vector = [&](int first) {
    return glm::vec3(check.finite(from.walker(first), "a person"),
                     check.finite(from.walker(first + 1), "a person"),
                     check.finite(from.walker(first + 2), "a person"));
  };
  person.walker.feet_m = vector(0);
  person.walker.speed_m_s = vector(3);
  person.look = vector(6);
  person.walker.time_left_s = check.finite(from.walker(9), "a person");
  person.walker.stands = from.stands();
  person.walker.still_ticks =
      static_cast<int32_t>(check.within(from.still_ticks(), 0, INT32_MAX, "still_ticks"));
  if (from.has_pace()) person.walker.pace = check.finite(from.pace(), "pace of a person");
  person.taken = from.taken();
  person.credit = from.credit();
  person.idle_ticks = from.idle_ticks();
  person.is_held = from.held();
  for (const Command& command : check.value_or_refuse(decode_recorded_commands(as_span(from.inputs())))) {
    const auto* const walk = std::get_if<WalkRequest>(&command.body);
    if (walk == nullptr || command.session != person.session) {
      check.refuse("an input of a person is none");
      break;
    }
    person.inputs.push_back({command.request, walk->input, walk->look});
  }
  return person;
}

}  // namespace

void write_world_props(kept::Moment& to, const WorldMoment& from) {
  for (const PropRecord& prop : from.props) {
    const std::vector<uint8_t> here = encode_recorded_prop({prop.id, *prop.prop, {}});
    kept::Prop& added = *to.add_props();
    added.set_here(std::string(here.begin(), here.end()));
    added.set_owner(prop.owner);
  }
  JointsMessage joints;
  for (const JointRecord& joint : from.joints) {
    joints.here.push_back({joint.id, *joint.joint});
    to.add_joint_owners(joint.owner);
  }
  write_joints(*to.mutable_joints(), joints);
  write_region_records(to, from);
  for (const PersonRecord& person : from.persons) write_person(*to.add_persons(), person);
  write_world_stores(to, from);
  write_world_game(to, from.game);
  if (!from.provenance.empty()) to.set_provenance(write_provenance(from.provenance));
}

void read_world_props(const kept::Moment& from, WorldMoment& to, FieldChecker& check) {
  for (const kept::Prop& one : from.props()) {
    if (check.failed()) break;
    PropMessage here = check.value_or_refuse(decode_recorded_prop(as_span(one.here())));
    to.props.push_back({here.id, one.owner(), std::make_shared<const Prop>(std::move(here.prop))});
  }
  read_joint_records(from, to, check);
  read_region_records(from, to, check);
  for (const kept::Person& person : from.persons()) {
    if (check.failed()) break;
    to.persons.push_back(read_person(person, check));
  }
  read_world_stores(from, to, check);
  to.game = read_world_game(from, check);
  to.provenance = read_provenance(from.provenance(), check);
}

}  // namespace scree
