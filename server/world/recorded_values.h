// Converts the simulation's values to those that files hold (server/formats/recording_codec.h) and back.
#pragma once

#include "server/formats/recording_codec.h"
#include "server/world/world_config.h"

namespace scree {

/// Without a program's name.
RecordedHeader to_recorded(const WorldConfig& config);
/// Refuses settings that this program does not know, and what validate() does. Its ground may not be there
/// yet (check_ground).
Result<WorldConfig> config_of(const RecordedHeader& header);

}  // namespace scree
