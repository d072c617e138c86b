// Props beside broken rock: 500 crates, 200 capsules and 300 hulls fall onto a field of craters with 1,000
// pieces. It asks whether any number of threads, and a restored world, goes the same way. It measures ticks,
// bits a body on the wire, what a renewal costs and changes, and Jolt and Rapier with the same bodies.
#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <memory>

#include "bench/peers/body_engines.h"
#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "bench/support/scratch.h"
#include "server/publish/publisher.h"
#include "server/world/world_snapshot.h"
#include "shared/base/check.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr uint32_t crates = 500, capsules = 200, hulls = 300, added_a_tick = 50;
constexpr Tick ticks_max = 480, restored_every = 50;
/// The other engines take up the bodies here: all are there, and the props still fall.
constexpr Tick handed_over_at = 60;
/// A renewal is compared with none from here to the end: most lies still.
constexpr Tick compared_from = 420;
constexpr double tick_p99_max_ms = 16.6, bits_max = 3.0;

Prop prop_number(uint32_t number) {
  Random random(number + 1);
  Prop prop;
  PropPart& part = prop.parts.emplace_back();
  if (number % 10 < 5) {
    part = {.kind = PropPartKind::box, .half_m = glm::vec3(0.3F)};
  } else if (number % 10 < 7) {
    part = {.kind = PropPartKind::capsule, .half_m = {0.2F, 0.3F, 0.0F}};
  } else {
    part.kind = PropPartKind::hull;
    for (int i = 0; i < 16; ++i)
      part.corners_m.push_back(
          {0.8F * random.unit() - 0.4F, 0.8F * random.unit() - 0.4F, 0.8F * random.unit() - 0.4F});
  }
  prop.mass_kg = 80.0F;
  return prop;
}

WorldConfig config_of_scene() {
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 0.25F};
  config.props_max = crates + capsules + hulls;
  config.methods.recombine = Recombination::off;  // 1,000 pieces stay
  return config;
}

/// The commands of a tick: 25 blows of 40 pieces, then props over them.
std::vector<Command> commands_of(Tick tick, BlowGrid& blows) {
  std::vector<Command> commands;
  if (const auto blow = blows.next()) commands.push_back({0, 0, *blow});
  for (uint32_t i = 0; tick > 30 && i < added_a_tick; ++i) {
    const auto number = static_cast<uint32_t>(tick - 31) * added_a_tick + i;
    if (number >= crates + capsules + hulls) break;
    const glm::vec3 place_m{0.9F * static_cast<float>(number % 25) - 11.0F,
                            3.0F + 0.8F * static_cast<float>(number / 625),
                            0.9F * static_cast<float>(number / 25 % 25) - 11.0F};
    commands.push_back({0, 0, AddPropRequest{prop_number(number), place_m}});
  }
  return commands;
}

struct Played {
  std::vector<double> ticks_ms;
  std::vector<uint64_t> hashes;
  size_t pieces = 0, props = 0;
  double bits_a_body = 0.0, bits_a_moving_body = 0.0;
  WorldSnapshot handed_over, compared;  ///< after those ticks
  std::vector<PieceState> ends;         ///< of pieces, then of props
  size_t awake = 0;                     ///< after the last tick
};

std::vector<PieceState> states_of(const TickDelta& delta) {
  std::vector<PieceState> states = delta.pieces;
  states.insert(states.end(), delta.props.begin(), delta.props.end());
  return states;
}

/// How many of the bodies have another pose than before; one that was not there before moves.
size_t moved(const std::vector<PieceState>& before, const std::vector<PieceState>& now) {
  std::map<PieceId, QuantisedPose> poses;
  for (const PieceState& state : before) poses.emplace(state.id, state.pose);
  return static_cast<size_t>(std::ranges::count_if(now, [&](const PieceState& state) {
    const auto found = poses.find(state.id);
    return found == poses.end() || found->second != state.pose;
  }));
}

Played play(size_t threads, bool with_client, const std::function<void(double)>& progress) {
  World world(config_of_scene(), threads);
  BlowGrid blows(world.config().terrain, 5, 5.0F, 2.0F, 40);
  Workers workers(1);
  Publisher publisher({.terrain = world.config().terrain}, workers);
  if (with_client) {
    publisher.begin(world.keyframe());
    publisher.join(1, glm::vec3(0.0F), 64.0F, operation_kinds);
  }
  Played played;
  size_t bodies = 0, moving = 0;
  for (Tick tick = 1; tick <= ticks_max; ++tick) {
    const auto delta = world.step(commands_of(tick, blows));
    played.ticks_ms.push_back(delta->times.total_ms());
    played.hashes.push_back(delta->state_hash);
    played.pieces = std::max(played.pieces, delta->pieces.size());
    played.props = delta->props.size();
    played.awake = delta->work.bodies.awake;
    std::vector<PieceState> states = states_of(*delta);
    bodies += states.size();
    if (with_client) moving += moved(played.ends, states);
    played.ends = std::move(states);
    if (tick == handed_over_at) played.handed_over = world.snapshot();
    if (tick == compared_from) played.compared = world.snapshot();
    if (with_client) publisher.publish(*delta, [](uint64_t) { return Backlog(); });
    progress(static_cast<double>(tick) / static_cast<double>(ticks_max));
  }
  const double bits = 8.0 * static_cast<double>(publisher.stats().transform_bytes);
  played.bits_a_body = bits / static_cast<double>(bodies);
  played.bits_a_moving_body = bits / static_cast<double>(std::max<size_t>(1, moving));
  return played;
}

/// A world that takes up its own value at every 50th tick, and beside it one restored there: whether they go
/// the same way until the next.
void measure_restores(BenchReport& report) {
  World world(config_of_scene());
  BlowGrid blows(world.config().terrain, 5, 5.0F, 2.0F, 40);
  std::unique_ptr<World> restored;
  size_t restores = 0, compared = 0, equal = 0;
  std::vector<double> renewals_ms;
  for (Tick tick = 1; tick <= ticks_max; ++tick) {
    const std::vector<Command> commands = commands_of(tick, blows);
    const auto delta = world.step(commands);
    if (restored) {
      ++compared;
      if (restored->step(commands)->state_hash == delta->state_hash) ++equal;
    }
    if (tick % restored_every != 0) continue;
    auto again = World::restore(world.snapshot());
    CHECK(again.has_value());
    restored = std::move(*again);
    ++restores;
    Stopwatch watch;
    world.renew();
    renewals_ms.push_back(watch.lap_ms());
  }
  report.check("restore", compared > 0 && equal == compared,
               fmt::format("{} of {} ticks have equal hashes after {} restores", equal, compared, restores));
  report.metric("renewal_median_ms", quantile(renewals_ms, 0.5));
  report.metric("renewal_most_ms", quantile(renewals_ms, 1.0));
}

/// What a renewal changes: the rest of the session from a restored world, beside the one that ran on.
void measure_renewal(BenchReport& report, const Played& played) {
  auto world = World::restore(played.compared);
  CHECK(world.has_value());
  std::shared_ptr<const TickDelta> delta;
  size_t awake_at_first = 0;
  for (Tick tick = compared_from + 1; tick <= ticks_max; ++tick) {
    delta = (*world)->step({});
    if (tick == compared_from + 1) awake_at_first = delta->work.bodies.awake;
  }
  std::map<PieceId, glm::vec3> places_m;
  for (const PieceState& state : played.ends) places_m.emplace(state.id, dequantise(state.pose).position_m);
  std::vector<double> apart_mm;
  for (const PieceState& state : states_of(*delta))
    if (const auto found = places_m.find(state.id); found != places_m.end())
      apart_mm.push_back(1000.0 * glm::distance(found->second, dequantise(state.pose).position_m));
  report.metric("renewed_awake_at_first", static_cast<double>(awake_at_first));
  report.metric("renewed_awake_after_60", static_cast<double>(delta->work.bodies.awake));
  report.metric("not_renewed_awake_after_60", static_cast<double>(played.awake));
  report.metric("renewed_apart_median_mm", quantile(apart_mm, 0.5));
  report.metric("renewed_apart_p99_mm", quantile(apart_mm, 0.99));
  report.metric("renewed_apart_most_mm", quantile(apart_mm, 1.0));
}

/// The same bodies from the same tick on, one thread each: Scree, then the others.
void measure_engines(BenchReport& report, const Played& played) {
  auto world = World::restore(played.handed_over);
  CHECK(world.has_value());
  const ScratchFolder scratch("bodies");
  const std::string path = scratch / "bodies.json";
  const auto written = peers::write_bodies(**world, path);
  std::vector<double> ticks_ms;
  size_t awake = 0;
  for (Tick tick = handed_over_at; tick < ticks_max; ++tick) {
    const auto delta = (*world)->step({});
    ticks_ms.push_back(delta->times.total_ms());
    awake = delta->work.bodies.awake;
  }
  const double median_ms = quantile(ticks_ms, 0.5), p99_ms = quantile(ticks_ms, 0.99);
  report.metric("scree_alone_median_ms", median_ms);
  report.metric("scree_alone_p99_ms", p99_ms);
  report.metric("scree_alone_awake", static_cast<double>(awake));
  for (const std::string& engine : {std::string("jolt"), std::string("rapier")}) {
    const auto stepped = written ? peers::step_bodies_with(engine, path, ticks_max - handed_over_at)
                                 : Result<peers::SteppedBodies>(fail(written.error().message));
    if (!stepped) {
      report.condition(engine, stepped.error().message);
      continue;
    }
    report.condition(engine, stepped->version);
    report.metric(engine + "_median_ms", quantile(stepped->ticks_ms, 0.5));
    report.metric(engine + "_p99_ms", quantile(stepped->ticks_ms, 0.99));
    report.metric(engine + "_awake", static_cast<double>(stepped->awake));
    report.metric(engine + "_fell_through", static_cast<double>(stepped->through));
  }
}

}  // namespace

BenchReport run_bodies_bench(const BenchOptions& options) {
  BenchReport report;
  const auto part = [&](double from) {
    return [&, from](double share) { options.progress(from + 0.25 * share); };
  };
  const Played one = play(1, false, part(0.0)), two = play(2, true, part(0.25)),
               four = play(4, false, part(0.5));
  report.metric("pieces", static_cast<double>(one.pieces));
  report.metric("props", static_cast<double>(one.props));
  report.check("threads", one.hashes == two.hashes && one.hashes == four.hashes,
               "the hashes of 1, 2 and 4 threads are equal at every tick");
  const double p99_ms = quantile(two.ticks_ms, 0.99), one_p99_ms = quantile(one.ticks_ms, 0.99);
  report.metric("tick_p99_ms_one_thread", one_p99_ms);
  report.metric("tick_p99_ms", p99_ms);
  report.metric("tick_median_ms", quantile(two.ticks_ms, 0.5));
  report.check("tick", p99_ms <= tick_p99_max_ms,
               fmt::format("p99 {:.1f} ms on two threads, {:.1f} on one; wanted {}", p99_ms, one_p99_ms,
                           tick_p99_max_ms));
  report.metric("bits_a_body_a_tick", two.bits_a_body);
  report.metric("bits_a_moving_body_a_tick", two.bits_a_moving_body);
  report.check("bits", two.bits_a_body <= bits_max,
               fmt::format("{:.2f} bits a body a tick; wanted {}", two.bits_a_body, bits_max));
  measure_restores(report);
  measure_renewal(report, one);
  measure_engines(report, one);
  options.progress(1.0);
  return report;
}

}  // namespace scree
