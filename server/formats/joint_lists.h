// Joints in recordings and files of worlds: as messages of the wire, limits::joints_a_message in each.
// Internal to this folder.
#pragma once

#include <google/protobuf/repeated_ptr_field.h>
#include <string>

#include "proto/messages.h"
#include "proto/wire_values.h"

namespace scree {

using PackedJoints = google::protobuf::RepeatedPtrField<std::string>;

void write_joints(PackedJoints& to, const JointsMessage& joints);
/// Refuses joints that validate() refuses, and lists that are not in the order of ids.
JointsMessage read_joints(const PackedJoints& from, FieldChecker& check);

}  // namespace scree
