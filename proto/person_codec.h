// Persons on foot, between our types and Protobuf's. Internal to proto/. proto/person.proto specifies them.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::Stand& to, const StandMessage& from);
void write(wire::Walk& to, const WalkMessage& from);
void write(wire::PersonPlaces& to, const PersonPlacesMessage& from);

StandMessage read(const wire::Stand& from, FieldChecker& check);
WalkMessage read(const wire::Walk& from, FieldChecker& check);
/// Refuses a state that no walker has.
PersonPlacesMessage read(const wire::PersonPlaces& from, FieldChecker& check);

}  // namespace scree
