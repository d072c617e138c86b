// Converts lists of persons and lines of chat between the types of proto/messages.h and Protobuf's. Internal
// to proto/.
#pragma once

#include "proto/wire_values.h"

namespace scree {

/// Leaves out persons beyond the limit, and cuts texts.
void write(wire::Persons& to, const PersonsMessage& from);
void write(wire::Said& to, const SaidMessage& from);
void write(wire::Say& to, const SayMessage& from);

PersonsMessage read(const wire::Persons& from, FieldChecker& check);
SaidMessage read(const wire::Said& from, FieldChecker& check);
SayMessage read(const wire::Say& from, FieldChecker& check);

}  // namespace scree
