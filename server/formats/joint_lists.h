// Joints in recordings and files of worlds: as messages of the wire, limits::joints_a_message in each.
// Internal to this folder.
#pragma once

#include <google/protobuf/repeated_ptr_field.h>
#include <string>

#include "proto/wire_values.h"
#include "server/formats/world_value.h"

namespace scree {

using PackedJoints = google::protobuf::RepeatedPtrField<std::string>;

void write_joints(PackedJoints& to, const JointsMessage& joints);
/// Refuses joints that validate() refuses, and lists that are not in the order of ids.
JointsMessage read_joints(const PackedJoints& from, FieldChecker& check);

/// The same of a world's joints, without their owners.
void write_joints(PackedJoints& to, const std::vector<JointRecord>& joints);
/// `owners`: as many as there are joints.
template <typename Owners>
std::vector<JointRecord> read_joints(const PackedJoints& from, const Owners& owners, FieldChecker& check) {
  JointsMessage joints = read_joints(from, check);
  std::vector<JointRecord> records;
  if (static_cast<size_t>(owners.size()) != joints.here.size() || !joints.gone.empty())
    check.refuse("the joints of a world have no owners, or too many, or are gone");
  for (size_t i = 0; i < joints.here.size() && !check.failed(); ++i)
    records.push_back({joints.here[i].id, owners[static_cast<int>(i)],
                       std::make_shared<const Joint>(joints.here[i].joint)});
  return records;
}

}  // namespace scree
