#include "server/store/resumed_recording.h"

#include <fmt/format.h>

#include "server/store/recording_reader.h"

namespace scree {

namespace {

bool alike(const WorldConfig& a, const WorldConfig& b) {
  return is_same_terrain(a, b) && a.tick_rate_hz == b.tick_rate_hz &&
         a.merges_per_tick_max == b.merges_per_tick_max;
}

/// The hash of the recorded world after the tick, which is the one before the first at least; nothing when it
/// was not recorded.
Result<std::optional<uint64_t>> hash_after(RecordingReader& recorded, Tick tick) {
  if (tick >= recorded.first_tick()) {
    const auto frame = recorded.frame(tick);
    TRY(frame);
    return std::optional(frame->state_hash);
  }
  const auto keyframe = TRY(recorded.keyframe_before(tick));
  if (!keyframe.has_value() || keyframe->tick != tick) return std::optional<uint64_t>();
  return std::optional(keyframe->state_hash);
}

}  // namespace

Result<RecordingHeader> header_to_resume(const std::string& path, const RecordingHeader& header,
                                         const TickDelta& start) {
  const Tick tick = start.tick;
  const auto recorded = TRY(RecordingReader::open(path));
  const auto another = fail(path + " is the recording of another world");
  if (!alike(recorded->header().world, header.world)) return another;
  if (recorded->last_tick() < tick || recorded->first_tick() > tick + 1)
    return fail(fmt::format("{} holds the ticks {} to {}, and the world stands at {}", path,
                            recorded->first_tick(), recorded->last_tick(), tick));
  const auto hash = TRY(hash_after(*recorded, tick));
  // Before its first tick a world is what its configuration says.
  const bool same = hash ? *hash == start.state_hash : tick == 0;
  if (!same) return another;
  return recorded->header();
}

}  // namespace scree
