// Joints and the requests about them, between our types and Protobuf's. Internal to proto/. proto/joint.proto
// specifies them.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::AddJoint& to, const AddJointMessage& from);
void write(wire::RemoveJoint& to, const RemoveJointMessage& from);
void write(wire::SetMotor& to, const SetMotorMessage& from);
void write(wire::JointHere& to, const KnownJoint& from);
/// Each list has at most limits::joints_a_message.
void write(wire::Joints& to, const JointsMessage& from);

/// A kind that is unknown is noted as such: a request with one is refused.
AddJointMessage read(const wire::AddJoint& from, FieldChecker& check);
RemoveJointMessage read(const wire::RemoveJoint& from, FieldChecker& check);
SetMotorMessage read(const wire::SetMotor& from, FieldChecker& check);
/// Refuses a joint that validate() refuses, as does the next one.
KnownJoint read(const wire::JointHere& from, FieldChecker& check);
JointsMessage read(const wire::Joints& from, FieldChecker& check);

}  // namespace scree
