// Converts a frame between the types of proto/messages.h and Protobuf's. Internal to proto/.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::Frame& to, const FrameMessage& from);
FrameMessage read(const wire::Frame& from, FieldChecker& check);

}  // namespace scree
