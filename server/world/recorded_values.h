// Converts the simulation's values to those that files hold (proto/recording_codec.h) and back.
#pragma once

#include "proto/recording_codec.h"
#include "server/world/tick_delta.h"
#include "server/world/world_config.h"

namespace scree {

RecordedLedger to_recorded(const Ledger& ledger);
Ledger from_recorded(const RecordedLedger& ledger);

/// Without a program's name.
RecordedHeader to_recorded(const WorldConfig& config);
/// Refuses settings that this program does not know, and what validate() does. Its ground may not be there
/// yet (check_ground).
Result<WorldConfig> config_of(const RecordedHeader& header);

}  // namespace scree
