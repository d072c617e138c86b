// Converts health between the types of proto/health.h and Protobuf's. Internal to proto/.
#pragma once

#include "proto/wire_values.h"

namespace scree {

/// Leaves out faults beyond the limit, and cuts texts.
void write(wire::Health& to, const HealthMessage& from);
HealthMessage read(const wire::Health& from, FieldChecker& check);

}  // namespace scree
