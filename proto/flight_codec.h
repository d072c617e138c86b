// What a server keeps of its last ticks, between our types and Protobuf's. Internal to proto/.
// proto/access.proto specifies it.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::ListFlight& to, const ListFlightRequest& from);
/// Slow ticks and parties of a list, at most as many as it may have.
void write_flight(wire::AdminList& to, const AdminListMessage& from);

ListFlightRequest read(const wire::ListFlight& from, FieldChecker& check);
void read_flight(const wire::AdminList& from, AdminListMessage& to, FieldChecker& check);

}  // namespace scree
