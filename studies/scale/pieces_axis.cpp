// 10 to 5,000 pieces alive and awake: a tick on one thread and on all cores, and what a viewer gets of them.
#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "bench/support/heap.h"
#include "bench/support/scenes.h"
#include "server/formats/world_value.h"
#include "server/publish/publisher.h"
#include "server/world/world.h"
#include "server/world/world_snapshot.h"
#include "shared/base/quantile.h"
#include "shared/base/timing.h"
#include "studies/scale/axes.h"

namespace scree {

namespace {

constexpr float heaps_apart_m = 6.0F;
constexpr uint32_t built_at_hz = 10;  ///< a tick six times as long has room for six times the work
constexpr uint32_t measured_at_hz = 60;
constexpr uint32_t blows_at_once = 4;
constexpr Tick build_ticks_max = 600;
constexpr Tick warm_ticks = 10;
constexpr Tick measured_ticks = 60;  ///< bodies fall asleep two seconds after their last movement, no sooner
constexpr float onlooker_interest_m = 64.0F;
constexpr uint64_t onlooker = 1;       ///< its session
constexpr Tick join_ticks_max = 7200;  ///< 40 MB of pieces

struct Heaps {
  uint32_t blows_a_side;
  uint32_t seeds;
};

WorldConfig heaps_config() {
  WorldConfig config;
  config.terrain = {TerrainKind::noise, 5, 0.25F};
  config.tick_rate_hz = built_at_hz;
  config.pieces_max = 20000;
  config.merges_per_tick_max = 0;
  config.methods.impacts = false;
  config.methods.dents = false;
  return config;
}

/// A moment after the last of the blows, whose pieces lie in and around their craters.
WorldSnapshot build_heaps(const Heaps& heaps) {
  World world(heaps_config());
  BlowGrid blows(world.config().terrain, heaps.blows_a_side, heaps_apart_m, 2.0F, heaps.seeds);
  uint32_t waiting = 0, struck = 0;
  bool all_struck = false;
  for (Tick tick = 0; tick < build_ticks_max && !(all_struck && waiting == 0); ++tick) {
    std::vector<Command> commands;
    while (commands.size() + waiting < blows_at_once && !all_struck) {
      const auto blow = blows.next();
      all_struck = !blow;
      if (blow) commands.push_back({0, ++struck, *blow});
    }
    waiting = world.step(commands)->work.requests_waiting;
  }
  for (uint32_t tick = 0; tick < built_at_hz / 2; ++tick) world.step({});
  WorldSnapshot value = world.snapshot();
  value.moment.config.tick_rate_hz = measured_at_hz;
  return value;
}

/// Ticks of a world of the value.
struct HeapTicks {
  double cpu_ms = 0.0;     ///< median, of the simulation's thread
  double clock_ms = 0.0;   ///< median
  double bodies_ms = 0.0;  ///< median, by the clock
  uint64_t state_hash = 0;
};

Result<HeapTicks> step_heaps(const WorldSnapshot& value, size_t threads) {
  auto world = TRY(World::restore(value, threads));
  std::vector<double> cpu_ms, clock_ms, bodies_ms;
  HeapTicks ticks;
  for (Tick tick = 0; tick < warm_ticks + measured_ticks; ++tick) {
    const double before_s = thread_cpu_s();
    const auto delta = world->step({});
    ticks.state_hash = delta->state_hash;
    if (tick < warm_ticks) continue;
    cpu_ms.push_back((thread_cpu_s() - before_s) * 1e3);
    clock_ms.push_back(delta->times.total_ms());
    bodies_ms.push_back(delta->times[TickStage::bodies]);
  }
  ticks.cpu_ms = quantile(cpu_ms, 0.5);
  ticks.clock_ms = quantile(clock_ms, 0.5);
  ticks.bodies_ms = quantile(bodies_ms, 0.5);
  return ticks;
}

/// A viewer of all pieces, without sockets and clocks: the server's publisher, and a link that takes all it
/// is offered.
class Onlooker {
 public:
  explicit Onlooker(const WorldConfig& config)
      : publisher_({.terrain = config.terrain, .tick_rate_hz = config.tick_rate_hz}, workers_),
        eye_m_(0.0F, ground_height_m(config.terrain, 0.0F, 0.0F), 0.0F) {}

  /// Shows a tick, as the one that follows the last shown.
  void show(TickDelta delta) {
    delta.tick = next_++;
    publisher_.publish(delta, [](uint64_t) { return Backlog(); });
  }
  /// Streams the edits and the pieces of a world that stands still, as a keyframe has it. False when that
  /// does not end.
  bool join(const TickDelta& keyframe) {
    show(keyframe);
    publisher_.join(onlooker, eye_m_, onlooker_interest_m, operation_kinds);
    TickDelta still;
    still.pieces = keyframe.pieces;
    still.ledger = keyframe.ledger;
    still.field_hash = keyframe.field_hash;
    const ClientView& view = *publisher_.view(onlooker);
    const auto has_all = [&] {
      return view.chunks_waiting() == 0 && view.known_pieces() == keyframe.pieces.size();
    };
    while (ticks() < join_ticks_max && !has_all()) show(still);
    return has_all();
  }

  const PublisherStats& stats() const { return publisher_.stats(); }
  Tick ticks() const { return next_ - 1; }  ///< shown

 private:
  Workers workers_{1};
  Publisher publisher_;
  glm::vec3 eye_m_;
  Tick next_ = 1;
};

/// What a viewer of all pieces is sent.
struct Shown {
  double kbit_s = 0.0;        ///< in the timed ticks, to a viewer that has all edits and pieces
  double join_mib = 0.0;      ///< until it has them
  double join_s = 0.0;        ///< until then
  uint64_t volume_bytes = 0;  ///< of edits and pieces, in the timed ticks
};

Result<Shown> show_heaps(const WorldSnapshot& value) {
  auto world = TRY(World::restore(value));
  Onlooker viewer(world->config());
  if (!viewer.join(world->keyframe())) return fail("a viewer does not get all pieces");
  const auto volume_bytes = [&] { return viewer.stats().chunk_bytes + viewer.stats().piece_bytes; };
  Shown shown;
  shown.join_mib = static_cast<double>(viewer.stats().sent_bytes) / 1048576.0;
  shown.join_s = static_cast<double>(viewer.ticks()) / measured_at_hz;
  for (Tick tick = 0; tick < warm_ticks; ++tick) viewer.show(*world->step({}));
  const uint64_t sent_before = viewer.stats().sent_bytes, volumes_before = volume_bytes();
  for (Tick tick = 0; tick < measured_ticks; ++tick) viewer.show(*world->step({}));
  const double seconds = static_cast<double>(measured_ticks) / measured_at_hz;
  shown.kbit_s = static_cast<double>(viewer.stats().sent_bytes - sent_before) * 8e-3 / seconds;
  shown.volume_bytes = volume_bytes() - volumes_before;
  return shown;
}

struct Built {
  WorldSnapshot value;
  double pieces = 0.0;
  bool same_hashes = true;
};

Result<void> step_all(Axis& axis, const ScaleRun& run, std::vector<Built>& sizes) {
  const int rounds = run.quick ? 1 : 3;
  for (int round = 0; round < rounds; ++round)
    for (Built& built : sizes) {
      const auto alone = step_heaps(built.value, 1), shared = step_heaps(built.value, 0);
      if (!alone || !shared) return tl::unexpected((alone ? shared : alone).error());
      axis.curve("tick on one core", measure::time_ms).add(built.pieces, alone->cpu_ms);
      axis.curve("bodies on one core", measure::time_ms).add(built.pieces, alone->bodies_ms);
      axis.curve("tick on all cores", measure::time_ms).add(built.pieces, shared->clock_ms);
      axis.curve("speed-up by all cores", "times").add(built.pieces, alone->clock_ms / shared->clock_ms);
      built.same_hashes = built.same_hashes && alone->state_hash == shared->state_hash;
      run.progress(0.3 + 0.6 * (round + built.pieces / sizes.back().pieces) / rounds);
    }
  return {};
}

Result<void> show_all(Axis& axis, const std::vector<Built>& sizes) {
  uint64_t volume_bytes = 0;
  for (const Built& built : sizes) {
    const auto shown = TRY(show_heaps(built.value));
    axis.curve("sent to a viewer", "kbit/s").add(built.pieces, shown.kbit_s);
    axis.curve("bytes of a join", measure::size_mib).add(built.pieces, shown.join_mib);
    axis.curve("join", "time of a join, s").add(built.pieces, shown.join_s);
    volume_bytes += shown.volume_bytes;
  }
  axis.checks.push_back(
      {"pieces_sent_by_motions_alone", volume_bytes == 0,
       fmt::format("{} bytes of volumes within the stream of one who has them all", volume_bytes)});
  return {};
}

}  // namespace

Result<Axis> measure_pieces_axis(const ScaleRun& run) {
  Axis axis{"pieces", "Pieces", "pieces alive and awake", "pieces"};
  const std::vector<Heaps> plan =
      run.quick ? std::vector<Heaps>{{1, 10}, {1, 64}, {3, 34}}
                : std::vector<Heaps>{{1, 10}, {1, 30}, {2, 25}, {3, 34}, {4, 64}, {6, 64}, {9, 64}};
  std::vector<Built> sizes;
  for (const Heaps& heaps : plan) {
    const size_t before = heap_bytes();
    WorldSnapshot value = build_heaps(heaps);
    const auto pieces = static_cast<double>(value.moment.pieces.size());
    axis.curve("a world's value", measure::size_mib)
        .add(pieces, static_cast<double>(heap_bytes() - before) / 1048576.0);
    sizes.push_back({std::move(value), pieces});
    run.progress(0.3 * static_cast<double>(sizes.size()) / static_cast<double>(plan.size()));
  }
  TRY(step_all(axis, run, sizes));
  TRY(show_all(axis, sizes));
  axis.checks.push_back({"pieces_same_on_all_cores", std::ranges::all_of(sizes, &Built::same_hashes),
                         "hashes after the last tick on one thread and on all"});
  axis.curve("tick on one core", measure::time_ms).limit(1000.0 / 60.0, "a tick of 16.6 ms");
  axis.curve("tick on all cores", measure::time_ms).limit(1000.0 / 60.0, "a tick of 16.6 ms");
  axis.curve("sent to a viewer", "kbit/s").limit(20000.0, "a link of 20 Mbit/s");
  axis.text.push_back(fmt::format(
      "Pieces of blows {:.0f} m apart, of up to 64 each, that lie, roll and fall in their craters; nothing "
      "merges, and none of them sleeps yet. A tick on one core is its processor time; one on all cores is "
      "by the clock. Both are medians of {} ticks, and of rounds over all sizes.",
      heaps_apart_m, measured_ticks));
  axis.text.push_back(fmt::format(
      "The stream to a viewer is that of the same ticks, to one who has all the pieces, within {:.0f} m, "
      "when they begin: motions and a status. Before, a viewer that joins is sent the edits and the volumes "
      "of the pieces, at most {} KiB of volumes after each of {} frames with poses a second; the world "
      "stands still while these join. Many blows take longer than few: most of their pieces lie still by "
      "the end, though none sleeps, and take fewer bits each.",
      onlooker_interest_m, limits::outbox_soft_bytes / 1024,
      measured_at_hz / PublisherConfig().ticks_per_transform));
  return axis;
}

}  // namespace scree
