// Converts cursors and physics between the types of proto/messages.h and Protobuf's. Internal to proto/.
#pragma once

#include "proto/wire_values.h"

namespace scree {

/// Leaves out entries beyond the limits.
void write(wire::Cursors& to, const CursorsMessage& from);
void write(wire::Physics& to, const PhysicsMessage& from);
void write(wire::Contacts& to, const ContactsMessage& from);

CursorsMessage read(const wire::Cursors& from, FieldChecker& check);
PhysicsMessage read(const wire::Physics& from, FieldChecker& check);
ContactsMessage read(const wire::Contacts& from, FieldChecker& check);

}  // namespace scree
