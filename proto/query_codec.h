// Questions about space and their answers, between our types and Protobuf's. Internal to proto/.
// proto/query.proto specifies them.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::Query& to, const QueryMessage& from);
/// Leaves out ids beyond limits::query_ids_max, and cuts texts.
void write(wire::Answer& to, const AnswerMessage& from);

/// Refuses more questions, or more ids of a mask, than the limits. A question of an unknown kind is one of
/// UnknownQuestion; whether it can be asked is the server's to check.
QueryMessage read(const wire::Query& from, FieldChecker& check);
AnswerMessage read(const wire::Answer& from, FieldChecker& check);

}  // namespace scree
