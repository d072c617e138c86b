// Converts between ticks and the rows of a recording (server/formats/recording_codec.h).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/command/command.h"
#include "server/formats/recording_codec.h"
#include "server/formats/world_value.h"
#include "server/store/event_deriver.h"
#include "server/world/published_state.h"
#include "server/world/recorded_values.h"
#include "server/world/tick_delta.h"
#include "server/world/world.h"
#include "shared/base/result.h"
#include "shared/field/paging.h"

namespace scree {

struct RecordingHeader {
  std::string program;  ///< name and version of the program that recorded
  WorldConfig world;
  Tick merge_burst_ticks = scree::merge_burst_ticks;  ///< of its events: EventDeriver
  float contacts_j = contact_event_least_j;           ///< likewise; 0: of earlier builds
};

/// A world from which a recording begins, or goes on in another process.
struct RecordingStart {
  WorldMoment moment;
  TickDelta keyframe;                  ///< World::keyframe() or outline() of that world
  ReadChunk read{};                    ///< gives the bricks of chunks of which the keyframe has none
  std::vector<Participant> persons{};  ///< who is there, and joined before
};

RecordedHeader to_recorded(const RecordingHeader& header);
/// Refuses settings that this program does not know.
Result<RecordingHeader> from_recorded(const RecordedHeader& header);

/// The frame of tick `delta`, which follows the state `before`.
RecordedFrame to_recorded(const TickDelta& delta, const PublishedState& before);

/// `keyframe`: from PublishedState::as_delta().
RecordedKeyframe to_recorded_keyframe(const TickDelta& keyframe);

}  // namespace scree
