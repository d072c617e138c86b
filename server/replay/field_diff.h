// In which brick, and at which voxel, the terrain of two recordings differs after a tick. Internal to
// recording_diff.cpp. One thread at a time.
#pragma once

#include <string>

#include "server/replay/recording_diff.h"

namespace scree {

/// In words. Where a recording cannot be played to the tick, since its operations do not give the hash that
/// it says, its next keyframe is looked at.
Result<std::string> field_difference(const DiffSide& a, const DiffSide& b, Tick tick);

}  // namespace scree
