// What a recording says, one after the other, for other programs: its events, and its ticks' durations and
// ledger, as CSV or JSON Lines. Nothing is simulated. One thread at a time.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "server/replay/replay_source.h"
#include "server/store/event_lines.h"
#include "server/store/recording_reader.h"

namespace scree {

enum class LineFormat : uint8_t { csv, jsonl };

/// Takes a line without its end.
using LineSink = std::function<void(const std::string& line)>;

/// Takes an event, and what is recorded beside it: its tick's duration, when it was, and who did it.
using EventVisitor = std::function<void(const Event& event, const EventContext& context)>;

/// Every event, ordered by tick. A recording without a log of events is played, and its world's events are
/// derived from that (event_deriver.h).
Result<void> each_event(RecordingReader& recording, const GroundGiver& ground, const EventVisitor& visit);

/// A line for each of these.
Result<void> export_events(const std::string& path, const GroundGiver& ground, LineFormat format,
                           const LineSink& write);

/// Every tick: how long its simulation took, where that is recorded, how many operations it applied, and the
/// ledger after it, in m³.
Result<void> export_ticks(RecordingReader& recording, LineFormat format, const LineSink& write);

}  // namespace scree
