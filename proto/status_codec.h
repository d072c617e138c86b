// The server's status, between our types and Protobuf's. Internal to proto/. proto/status.proto specifies it.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::Status& to, const StatusMessage& from);
StatusMessage read(const wire::Status& from, FieldChecker& check);

/// Refuses more than limits::latency_max_us.
uint32_t read_latency(uint32_t us, FieldChecker& check);

}  // namespace scree
