// What a recording says, line by line, for other programs: its events, and its ticks' durations and ledger,
// as CSV or JSON Lines. Nothing is simulated. One thread at a time.
#pragma once

#include <functional>
#include <string>

#include "server/replay/replay_source.h"
#include "server/store/recording_reader.h"

namespace scree {

enum class LineFormat : uint8_t { csv, jsonl };

/// Takes a line without its end.
using TakeLine = std::function<void(const std::string& line)>;

/// Every event, ordered by tick: the world's with its tick's duration, where that is recorded. A recording
/// without a log of events is played, and its world's events are derived from that (event_deriver.h).
Result<void> export_events(const std::string& path, const GroundGiver& ground, LineFormat format,
                           const TakeLine& take);

/// Every tick: how long its simulation took, where that is recorded, how many operations it applied, and the
/// ledger after it, in m³.
Result<void> export_ticks(RecordingReader& recording, LineFormat format, const TakeLine& take);

}  // namespace scree
