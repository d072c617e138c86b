// Props beside broken rock: 500 crates, 200 capsules and 300 hulls fall onto a field of craters with 1,000
// pieces. Whether any number of threads, and a restored world, goes the same way; how long ticks take; how
// many bits a body takes on the wire.
#include <algorithm>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "server/publish/publisher.h"
#include "server/world/world_snapshot.h"
#include "shared/base/check.h"
#include "shared/base/random.h"

namespace scree {

namespace {

constexpr uint32_t crates = 500, capsules = 200, hulls = 300, added_a_tick = 50;
constexpr Tick ticks_max = 480;
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
  double bits_a_body = 0.0;
};

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
  uint64_t bodies = 0;
  for (Tick tick = 1; tick <= ticks_max; ++tick) {
    const auto delta = world.step(commands_of(tick, blows));
    played.ticks_ms.push_back(delta->times.total_ms());
    played.hashes.push_back(delta->state_hash);
    played.pieces = std::max(played.pieces, delta->pieces.size());
    played.props = delta->props.size();
    bodies += delta->pieces.size() + delta->props.size();
    if (with_client) publisher.publish(*delta, [](uint64_t) { return Backlog(); });
    progress(static_cast<double>(tick) / static_cast<double>(ticks_max));
  }
  played.bits_a_body =
      8.0 * static_cast<double>(publisher.stats().transform_bytes) / static_cast<double>(bodies);
  return played;
}

/// Whether two worlds of a snapshot in the middle go the same way.
bool restores_alike() {
  World world(config_of_scene());
  BlowGrid blows(world.config().terrain, 5, 5.0F, 2.0F, 40);
  for (Tick tick = 1; tick <= 90; ++tick) world.step(commands_of(tick, blows));
  const WorldSnapshot value = world.snapshot();
  std::vector<uint64_t> ends;
  for (int i = 0; i < 2; ++i) {
    auto restored = World::restore(value);
    CHECK(restored.has_value());
    for (int tick = 0; tick < 60; ++tick) (*restored)->step({});
    ends.push_back((*restored)->moment().state_hash);
  }
  return ends[0] == ends[1];
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
  report.check("restore", restores_alike(), "two worlds of one snapshot go the same way");
  const double p99_ms = quantile(two.ticks_ms, 0.99), one_p99_ms = quantile(one.ticks_ms, 0.99);
  report.metric("tick_p99_ms_one_thread", one_p99_ms);
  report.metric("tick_p99_ms", p99_ms);
  report.metric("tick_median_ms", quantile(two.ticks_ms, 0.5));
  report.check("tick", p99_ms <= tick_p99_max_ms,
               fmt::format("p99 {:.1f} ms on two threads, {:.1f} on one; wanted {}", p99_ms, one_p99_ms,
                           tick_p99_max_ms));
  report.metric("bits_a_body_a_tick", two.bits_a_body);
  report.check("bits", two.bits_a_body <= bits_max,
               fmt::format("{:.2f} bits a body a tick; wanted {}", two.bits_a_body, bits_max));
  options.progress(1.0);
  return report;
}

}  // namespace scree
