#include "server/replay/verify.h"

#include <cstdio>

#include "server/world/world.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

/// Ticks between two reports of progress.
constexpr Tick progress_ticks = 32;

std::string hashes_differ(const char* what, uint64_t simulated, uint64_t recorded) {
  char text[128];
  std::snprintf(text, sizeof text, "%s is %016llx, recorded was %016llx", what,
                static_cast<unsigned long long>(simulated), static_cast<unsigned long long>(recorded));
  return text;
}

std::string difference(const TickDelta& simulated, const RecordedFrame& recorded) {
  if (simulated.field_hash != recorded.field_hash)
    return hashes_differ("field_hash", simulated.field_hash, recorded.field_hash);
  if (simulated.state_hash != recorded.state_hash)
    return hashes_differ("state_hash", simulated.state_hash, recorded.state_hash);
  return {};
}

}  // namespace

Result<VerifyReport> verify(RecordingReader& recording, const std::function<void(Tick, Tick)>& progress) {
  Stopwatch watch;
  VerifyReport report;
  auto world = World::create(recording.header().world);
  if (!world) return fail(recording.path() + ": " + world.error().message);
  for (Tick tick = 1; tick <= recording.last_tick() && report.agrees(); ++tick) {
    const auto frame = recording.frame(tick);
    if (!frame) return tl::unexpected(frame.error());
    const auto commands = recording.commands(tick);
    if (!commands) return tl::unexpected(commands.error());
    const auto delta = (*world)->step(*commands);
    CHECK_EQ(delta->tick, tick);
    report.ticks = tick;
    report.commands += commands->size();
    report.field_hash = delta->field_hash;
    report.state_hash = delta->state_hash;
    report.difference = difference(*delta, *frame);
    if (!report.difference.empty()) report.first_difference = tick;
    if (progress && (tick % progress_ticks == 0 || tick == recording.last_tick()))
      progress(tick, recording.last_tick());
  }
  report.seconds = watch.lap_ms() / 1000.0;
  return report;
}

}  // namespace scree
