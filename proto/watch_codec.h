// Cursors and physics, between our types and Protobuf's. Internal to proto/.
#pragma once

#include "proto/wire_values.h"

namespace scree {

/// What is over the limits is left out.
void write(wire::Cursors& to, const CursorsMessage& from);
void write(wire::Physics& to, const PhysicsMessage& from);

CursorsMessage read(const wire::Cursors& from, FieldChecker& check);
PhysicsMessage read(const wire::Physics& from, FieldChecker& check);

}  // namespace scree
