#include "server/formats/world_props.h"

#include <utility>

#include "server/formats/joint_lists.h"
#include "server/formats/recording_codec.h"

namespace scree {

namespace {

void read_joint_records(const kept::Moment& from, WorldMoment& to, FieldChecker& check) {
  JointsMessage joints = read_joints(from.joints(), check);
  if (static_cast<size_t>(from.joint_owners_size()) != joints.here.size() || !joints.gone.empty())
    check.refuse("the joints of a world have no owners, or too many, or are gone");
  for (size_t i = 0; i < joints.here.size() && !check.failed(); ++i)
    to.joints.push_back({joints.here[i].id, from.joint_owners(static_cast<int>(i)),
                         std::make_shared<const Joint>(joints.here[i].joint)});
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
}

void read_world_props(const kept::Moment& from, WorldMoment& to, FieldChecker& check) {
  for (const kept::Prop& one : from.props()) {
    if (check.failed()) break;
    PropMessage here = check.value_or_refuse(decode_recorded_prop(as_span(one.here())));
    to.props.push_back({here.id, one.owner(), std::make_shared<const Prop>(std::move(here.prop))});
  }
  read_joint_records(from, to, check);
}

}  // namespace scree
