#include "server/replay/verify.h"

#include <fmt/format.h>
#include <xxhash.h>

#include "server/formats/world_codec.h"
#include "server/replay/recorded_world.h"
#include "server/store/event_deriver.h"
#include "server/world/settings.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

/// Where the recording goes on from a state of this tick: compares it with the world's own, and goes on from
/// it. Whether it did.
Result<bool> restart(RecordingReader& recording, std::unique_ptr<World>& world, RecordedTerrain& terrain,
                     VerifyReport& report, const GroundGiver& ground) {
  auto state = recording.state(world->tick());
  TRY(state);
  if (!state->has_value() || !report.difference.empty()) return false;
  // The terrain comes chunk by chunk: the value has its hash.
  WorldMoment moment = world->moment();
  // A newer program may have gone on, and with another file of materials.
  moment.config.rules = (*state)->moment.config.rules;
  moment.config.palette = (*state)->moment.config.palette;
  const std::vector<uint8_t> own = encode(WorldSnapshot{std::move(moment), {}});
  const std::vector<uint8_t> said = encode(**state);
  if (own != said)
    report.difference = hashes_differ("the whole state", XXH3_64bits(own.data(), own.size()),
                                      XXH3_64bits(said.data(), said.size()));
  const Tick tick = world->tick();
  world.reset();  // there is room for one
  auto restored = restored_from(std::move(**state), tick, terrain, ground);
  if (!restored) return fail(fmt::format("{}: {}", recording.path(), restored.error().message));
  world = std::move(*restored);
  ++report.restarts;
  return true;
}

EventDeriver deriver_of(const RecordingReader& recording, const World& world) {
  return {world.config().terrain.voxel_size_m, print(world.config()), recording.header().merge_burst_ticks,
          recording.header().contacts_j};
}

/// Recordings of earlier builds do not say who asked.
bool agree(const std::vector<Event>& recorded, std::vector<Event> simulated) {
  if (recorded.size() != simulated.size()) return false;
  for (size_t i = 0; i < simulated.size(); ++i)
    if (recorded[i].session == 0) simulated[i].session = 0;
  return recorded == simulated;
}

/// The world's events, where the recording has a log of them; not those of the machine.
Result<void> compare_events(RecordingReader& recording, const std::vector<Event>& simulated, Tick tick,
                            VerifyReport& report) {
  const auto from = recording.events_from();
  if (!from || tick < *from || !report.difference.empty()) return {};
  const auto recorded = recording.events(tick);
  TRY(recorded);
  if (!agree(*recorded, simulated))
    report.difference =
        fmt::format("{} events, recorded were {}, or others", simulated.size(), recorded->size());
  report.events += simulated.size();
  return {};
}

Result<VerifyReport> verify_ticks(RecordingReader& recording, const std::function<void(Tick, Tick)>& progress,
                                  const GroundGiver& ground, size_t bricks_max) {
  Stopwatch stopwatch;
  VerifyReport report;
  const Tick start = recording.first_tick() - 1;
  RecordedTerrain terrain(recording, bricks_max);
  auto world = TRY(simulated_to(recording, start, terrain, ground));
  TRY(restart(recording, world, terrain, report, ground));
  EventDeriver deriver = deriver_of(recording, *world);
  for (Tick tick = start + 1; tick <= recording.last_tick() && report.agrees(); ++tick) {
    const auto frame = recording.frame(tick);
    TRY(frame);
    const auto commands = recording.commands(tick);
    TRY(commands);
    const auto delta = world->step(*commands);
    terrain.make_room(*world);
    CHECK_EQ(delta->tick, tick);
    report.ticks = tick - start;
    report.commands += commands->size();
    report.field_hash = delta->field_hash;
    report.state_hash = delta->state_hash;
    report.difference = difference_of(*delta, *frame);
    TRY(compare_events(recording, deriver.events_of(*delta), tick, report));
    const auto restarted = TRY(restart(recording, world, terrain, report, ground));
    if (restarted) deriver = deriver_of(recording, *world);
    if (!report.difference.empty()) report.first_difference = tick;
    if (progress && (tick % progress_ticks == 0 || tick == recording.last_tick()))
      progress(tick, recording.last_tick());
  }
  report.seconds = stopwatch.lap_ms() / 1000.0;
  return report;
}

}  // namespace

Result<VerifyReport> verify(RecordingReader& recording, const std::function<void(Tick, Tick)>& progress,
                            const GroundGiver& ground, size_t bricks_max) {
  return with_terrain([&] { return verify_ticks(recording, progress, ground, bricks_max); });
}

}  // namespace scree
