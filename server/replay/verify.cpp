#include "server/replay/verify.h"

#include <cstdio>
#include <xxhash.h>

#include "proto/world_codec.h"
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

Result<std::unique_ptr<World>> world_of(std::span<const uint8_t> state, Tick tick) {
  const auto value = decode_world(state);
  if (!value) return tl::unexpected(value.error());
  if (value->moment.tick != tick)
    return fail("damaged: the state after tick " + std::to_string(tick) + " says that it is of tick " +
                std::to_string(value->moment.tick));
  return World::restore(*value);
}

/// The world that a recording starts from.
Result<std::unique_ptr<World>> world_at(RecordingReader& recording, Tick tick) {
  const auto state = recording.state(tick);
  if (!state) return tl::unexpected(state.error());
  CHECK(state->has_value());
  return world_of(**state, tick);
}

/// Where another process went on with this tick's state: compares it with the world's own, and goes on from
/// it.
Result<void> restart(RecordingReader& recording, std::unique_ptr<World>& world, VerifyReport& report) {
  const auto state = recording.state(world->tick());
  if (!state) return tl::unexpected(state.error());
  if (!state->has_value() || !report.difference.empty()) return {};
  const std::vector<uint8_t> own = encode(world->snapshot());
  if (own != **state)
    report.difference = hashes_differ("the whole state", XXH3_64bits(own.data(), own.size()),
                                      XXH3_64bits((*state)->data(), (*state)->size()));
  auto restored = world_of(**state, world->tick());
  if (!restored) return fail(recording.path() + ": " + restored.error().message);
  world = std::move(*restored);
  ++report.restarts;
  return {};
}

}  // namespace

Result<VerifyReport> verify(RecordingReader& recording, const std::function<void(Tick, Tick)>& progress) {
  Stopwatch watch;
  VerifyReport report;
  const Tick start = recording.first_tick() - 1;
  auto world = start == 0 ? World::create(recording.header().world) : world_at(recording, start);
  if (!world) return fail(recording.path() + ": " + world.error().message);
  if (auto restarted = restart(recording, *world, report); !restarted)
    return tl::unexpected(restarted.error());
  for (Tick tick = start + 1; tick <= recording.last_tick() && report.agrees(); ++tick) {
    const auto frame = recording.frame(tick);
    if (!frame) return tl::unexpected(frame.error());
    const auto commands = recording.commands(tick);
    if (!commands) return tl::unexpected(commands.error());
    const auto delta = (*world)->step(*commands);
    CHECK_EQ(delta->tick, tick);
    report.ticks = tick - start;
    report.commands += commands->size();
    report.field_hash = delta->field_hash;
    report.state_hash = delta->state_hash;
    report.difference = difference(*delta, *frame);
    if (auto restarted = restart(recording, *world, report); !restarted)
      return tl::unexpected(restarted.error());
    if (!report.difference.empty()) report.first_difference = tick;
    if (progress && (tick % progress_ticks == 0 || tick == recording.last_tick()))
      progress(tick, recording.last_tick());
  }
  report.seconds = watch.lap_ms() / 1000.0;
  return report;
}

}  // namespace scree
