// Converts what a server says of a replay between the types of proto/messages.h and Protobuf's. Internal to
// proto/.
#pragma once

#include "proto/wire_values.h"

namespace scree {

void write(wire::Playback& to, const PlaybackMessage& from);
void write(wire::Marks& to, const MarksMessage& from);

PlaybackMessage read(const wire::Playback& from, FieldChecker& check);
MarksMessage read(const wire::Marks& from, FieldChecker& check);
void write(wire::ControlReplay& to, const ControlReplayRequest& from);

}  // namespace scree
