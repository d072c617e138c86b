#include "studies/scale/ground_probe.h"

#include <algorithm>
#include <fmt/format.h>
#include <variant>

#include "bench/support/scenes.h"
#include "shared/base/quantile.h"

namespace scree {

namespace {

constexpr float blow_radius_m = 2.0F;
constexpr uint32_t blow_seeds = 64;
constexpr float apart_m = 6.0F;       ///< places of blows and of posts, in squares of four by four
constexpr float posts_off_m = 22.0F;  ///< from the middle of the blows
constexpr Tick settle_ticks_max = 600;
constexpr Tick search_ticks = 5;  ///< within which the post's search for support ends
constexpr int idle_ticks = 40;

/// A place of a square of four by four, which is gone through again and again.
glm::vec2 place(uint32_t number) {
  const auto along = [](uint32_t step) { return (static_cast<float>(step) - 1.5F) * apart_m; };
  return {along(number % 4), along(number / 4 % 4)};
}

}  // namespace

bool alike(const ProbeCounts& a, const ProbeCounts& b) {
  const auto near = [](size_t x, size_t y) {
    return 20 * (std::max(x, y) - std::min(x, y)) <= std::max(x, y);
  };
  return near(a.pieces, b.pieces) && near(a.merged, b.merged) && near(a.fell, b.fell);
}

std::string text_of(const ProbeCounts& counts) {
  return fmt::format("{} pieces, {} merged, {} islands", counts.pieces, counts.merged, counts.fell);
}

void add(Axis& axis, double size, const ProbeTimes& times) {
  axis.curve("carve", measure::time_ms).add(size, times.carve);
  axis.curve("merge", measure::time_ms).add(size, times.merge);
  axis.curve("islands", measure::time_ms).add(size, times.islands);
  axis.curve("tick with pieces", measure::time_ms).add(size, times.tick);
  axis.curve("idle tick", measure::time_ms).add(size, times.idle);
}

void check_alike(Axis& axis, std::span<const GroundProbe> probes) {
  const GroundProbe& first = probes.front();
  bool passed = first.counts().fell >= first.rounds();
  std::string others;
  for (const GroundProbe& probe : probes) {
    passed = passed && alike(probe.counts(), first.counts());
    if (probe.counts() != first.counts()) others += "; elsewhere " + text_of(probe.counts());
  }
  axis.checks.push_back({axis.name + "_same_work", passed,
                         text_of(first.counts()) + (others.empty() ? " in all worlds" : others)});
}

GroundProbe::GroundProbe(World& world, float x_m, float z_m) : world_(world), x_m_(x_m), z_m_(z_m) {
  const TerrainSource& terrain = world.config().terrain;
  const float ground_m = ground_height_m(terrain, x_m, z_m);
  const Shape all = box({x_m, ground_m, z_m + 0.5F * posts_off_m}, {20.0F, 12.0F, 32.0F});
  for_each_chunk(band_box(in_voxels(all, terrain.voxel_size_m)),
                 [&](ChunkCoord chunk) { world.field().chunk_bricks(chunk); });
}

void GroundProbe::count(const TickDelta& delta) {
  counts_.pieces += delta.spawned.size();
  for (const AppliedOperation& applied : delta.operations) {
    counts_.merged += pieces_merged_by(applied.operation);
    counts_.fell += std::holds_alternative<IslandOperation>(applied.operation) ? 1 : 0;
  }
}

void GroundProbe::settle(ProbeTimes& times) {
  double sum_ms = 0.0;
  Tick ticks = 0;
  for (; ticks < settle_ticks_max; ++ticks) {
    const auto delta = world_.step({});
    count(*delta);
    times.merge += delta->times[TickStage::recombine];
    if (delta->pieces.empty()) break;
    sum_ms += delta->times.total_ms();
  }
  times.tick = sum_ms / static_cast<double>(std::max<Tick>(1, ticks));
}

void GroundProbe::blow(ProbeTimes& times) {
  const glm::vec2 at = place(rounds_);
  const CarveRequest request =
      blow_at(world_.config().terrain, x_m_ + at.x, z_m_ + at.y, blow_radius_m, blow_seeds, rounds_ + 1);
  const Command command{0, ++requests_, request};
  const auto delta = world_.step({&command, 1});
  count(*delta);
  for (const TickStage stage : {TickStage::requests, TickStage::refracture, TickStage::spawn})
    times.carve += delta->times[stage];
  settle(times);
}

void GroundProbe::fall(ProbeTimes& times) {
  const glm::vec2 at = place(rounds_);
  const float x_m = x_m_ + at.x, z_m = z_m_ + posts_off_m + at.y;
  const glm::vec3 ground(x_m, ground_height_m(world_.config().terrain, x_m, z_m), z_m);
  const Command post{0, ++requests_,
                     FillRequest{box(ground + glm::vec3(0.0F, 3.5F, 0.0F), {1.0F, 4.5F, 1.0F})}};
  count(*world_.step({&post, 1}));
  CarveRequest fell;
  fell.shape = box(ground + glm::vec3(0.0F, 2.5F, 0.0F), {1.6F, 0.75F, 1.6F});
  fell.seeds = 8;
  fell.random_seed = rounds_ + 1;
  fell.impact_m = fell.shape.a;
  const Command foot{0, ++requests_, fell};
  for (Tick tick = 0; tick < search_ticks; ++tick) {
    const auto delta = tick == 0 ? world_.step({&foot, 1}) : world_.step({});
    count(*delta);
    times.islands += delta->times[TickStage::islands];
  }
  ProbeTimes of_the_fall;
  settle(of_the_fall);
}

ProbeTimes GroundProbe::round() {
  ProbeTimes times;
  blow(times);
  fall(times);
  std::vector<double> ticks_ms;
  for (int i = 0; i < idle_ticks; ++i) ticks_ms.push_back(world_.step({})->times.total_ms());
  times.idle = quantile(ticks_ms, 0.5);
  ++rounds_;
  return times;
}

}  // namespace scree
