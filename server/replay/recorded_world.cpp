#include "server/replay/recorded_world.h"

#include <cstdio>
#include <fmt/format.h>

namespace scree {

std::string hashes_differ(const char* what, uint64_t simulated, uint64_t recorded) {
  char text[128];
  std::snprintf(text, sizeof text, "%s is %016llx, recorded was %016llx", what,
                static_cast<unsigned long long>(simulated), static_cast<unsigned long long>(recorded));
  return text;
}

std::string difference_of(const TickDelta& simulated, const RecordedFrame& recorded) {
  if (simulated.field_hash != recorded.field_hash)
    return hashes_differ("field_hash", simulated.field_hash, recorded.field_hash);
  if (simulated.state_hash != recorded.state_hash)
    return hashes_differ("state_hash", simulated.state_hash, recorded.state_hash);
  return {};
}

Result<std::unique_ptr<World>> restored_from(WorldSnapshot state, Tick tick, RecordedTerrain& terrain,
                                             const GroundGiver& ground) {
  WorldMoment& moment = state.moment;
  if (moment.tick != tick)
    return fail(
        fmt::format("damaged: the state after tick {} says that it is of tick {}", tick, moment.tick));
  TRY(give_ground(moment.config.ground, moment.config.terrain, ground));
  return terrain.restore(state);
}

Result<std::unique_ptr<World>> world_at(RecordingReader& recording, Tick tick, RecordedTerrain& terrain,
                                        const GroundGiver& ground) {
  auto state = recording.state(tick);
  TRY(state);
  if (state->has_value()) return restored_from(std::move(**state), tick, terrain, ground);
  if (tick != 0) return fail(fmt::format("tick {} has no state", tick));
  WorldConfig config = recording.header().world;
  TRY(give_ground(config.ground, config.terrain, ground));
  auto world = World::create(config);
  if (world) terrain.adopt(**world);
  return world;
}

namespace {

Result<std::unique_ptr<World>> simulate(RecordingReader& recording, Tick tick, RecordedTerrain& terrain,
                                        const GroundGiver& ground,
                                        const std::function<void(Tick, Tick)>& progress,
                                        const TickObserver& observe) {
  const Tick first = recording.first_tick() - 1, last = recording.last_tick();
  if (tick < first || tick > last)
    return fail(fmt::format("{} has the ticks {} to {}, not {} (--to)", recording.path(), first, last, tick));
  const auto start = recording.state_before(tick);
  TRY(start);
  auto world = world_at(recording, *start, terrain, ground);
  if (!world) return fail(fmt::format("{}: {}", recording.path(), world.error().message));
  while ((*world)->tick() < tick) {
    const Tick next = (*world)->tick() + 1;
    const auto commands = recording.commands(next);
    TRY(commands);
    const auto delta = (*world)->step(*commands);
    terrain.make_room(**world);
    if (next > first) {
      const auto frame = recording.frame(next);
      TRY(frame);
      if (const std::string differs = difference_of(*delta, *frame); !differs.empty())
        return fail(fmt::format("{}: at tick {}, {}", recording.path(), next, differs));
    }
    if (observe) observe(**world, *delta);
    if (progress && (next % progress_ticks == 0 || next == tick)) progress(next - *start, tick - *start);
  }
  return world;
}

}  // namespace

Result<std::unique_ptr<World>> simulated_to(RecordingReader& recording, Tick tick, RecordedTerrain& terrain,
                                            const GroundGiver& ground,
                                            const std::function<void(Tick, Tick)>& progress,
                                            const TickObserver& observe) {
  return with_terrain([&] { return simulate(recording, tick, terrain, ground, progress, observe); });
}

}  // namespace scree
