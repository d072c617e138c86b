// Signs, cues and a game's own bytes, between our types and Protobuf's. Internal to proto/ and to the formats
// of files. proto/game.proto specifies them.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::Audience& to, const Audience& from);
void write(wire::Sign& to, const Sign& from);
void write(wire::Cue& to, const Cue& from);
void write(wire::ChannelData& to, const ChannelData& from);
/// At most limits::signs_max.
void write(wire::Signs& to, const SignsMessage& from);
/// At most limits::notices_a_tick_max.
void write(wire::Cues& to, const CuesMessage& from);
void write(wire::ControlRules& to, const ControlRulesRequest& from);

/// Refuses what validate() refuses.
Audience read(const wire::Audience& from, FieldChecker& check);
Sign read(const wire::Sign& from, FieldChecker& check);
Cue read(const wire::Cue& from, FieldChecker& check);
ChannelMessage read(const wire::ChannelData& from, FieldChecker& check);
/// Likewise, and signs that are not in order.
SignsMessage read(const wire::Signs& from, FieldChecker& check);
/// Cues of unknown kinds are left out.
CuesMessage read(const wire::Cues& from, FieldChecker& check);
ControlRulesRequest read(const wire::ControlRules& from, FieldChecker& check);

}  // namespace scree
