#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "shared/field/piece.h"

namespace scree {

namespace {

constexpr uint32_t rates_hz[] = {10, 30, 60, 120, 240};
constexpr double seconds_max = 60.0;
/// The last piece of one blow to rest is a matter of chance; the mean of so many is not.
constexpr uint32_t blows_max = 16;
constexpr float gravity_m_s2 = 9.81F;

/// What became of a scene at a tick rate.
struct Run {
  double rest_s = seconds_max;   ///< until half of the pieces were terrain again
  double all_s = seconds_max;    ///< until all were
  float above_birth_m = 0.0F;    ///< most that a piece rose above the height that its energy at birth reaches
  float speed_over_fall = 0.0F;  ///< greatest speed over √(2 g h), h the greatest fall of any piece
};

/// Heights and speeds by differences of published poses: nothing of the body simulation is asked.
class MotionPeaks {
 public:
  explicit MotionPeaks(uint32_t rate_hz) : tick_s_(1.0F / static_cast<float>(rate_hz)) {}

  void observe(const TickDelta& delta, float blast_speed_m_s) {
    for (const PieceState& piece : delta.pieces) {
      const glm::vec3 at_m = dequantise(piece.pose).position_m;
      const auto [found, is_new] = tracks_.try_emplace(piece.id, Track{at_m, at_m});
      Track& track = found->second;
      const glm::vec3 moved = at_m - track.last_m;
      track.last_m = at_m;
      if (!is_new) speed_m_s_ = std::max(speed_m_s_, std::sqrt(glm::dot(moved, moved)) / tick_s_);
      highest_m_ = std::max(highest_m_, track.birth_m.y);
      lowest_m_ = std::min(lowest_m_, at_m.y);
      const float reach_m = blast_speed_m_s * blast_speed_m_s / (2.0F * gravity_m_s2);
      above_m_ = std::max(above_m_, at_m.y - highest_m_ - reach_m);
    }
  }
  float above_birth_m() const { return above_m_; }
  float speed_over_fall() const {
    const float fall_m = std::max(highest_m_ - lowest_m_, 0.01F);
    return speed_m_s_ / std::sqrt(2.0F * gravity_m_s2 * fall_m);
  }

 private:
  struct Track {
    glm::vec3 birth_m{0.0F};
    glm::vec3 last_m{0.0F};
  };
  float tick_s_;
  std::map<PieceId, Track> tracks_;
  float speed_m_s_ = 0.0F, above_m_ = 0.0F;
  float highest_m_ = -1e9F, lowest_m_ = 1e9F;
};

WorldConfig config_at(uint32_t rate_hz) {
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 0.25F};
  config.tick_rate_hz = rate_hz;
  return config;
}

/// Plays the commands, one a tick, and then until nothing is alive.
Run play(uint32_t rate_hz, const std::vector<CarveRequest>& carves, float birth_speed_m_s) {
  World world(config_at(rate_hz));
  MotionPeaks peaks(rate_hz);
  Run run;
  size_t made = 0, merged = 0;
  const auto ticks_max = static_cast<Tick>(seconds_max * rate_hz);
  for (Tick tick = 0; tick < ticks_max && run.all_s == seconds_max; ++tick) {
    std::vector<Command> commands;
    if (tick < carves.size()) commands.push_back({0, 0, carves[tick]});
    const auto delta = world.step(commands);
    peaks.observe(*delta, birth_speed_m_s);
    made += delta->spawned.size();
    for (const AppliedOperation& applied : delta->operations) merged += pieces_merged_by(applied.operation);
    const double now_s = static_cast<double>(tick + 1) / rate_hz;
    if (tick + 1 < carves.size()) continue;
    if (2 * merged >= made) run.rest_s = std::min(run.rest_s, now_s);
    if (delta->pieces.empty()) run.all_s = now_s;
  }
  run.above_birth_m = peaks.above_birth_m();
  run.speed_over_fall = peaks.speed_over_fall();
  return run;
}

/// Blows into flat ground that differ by their seeds, each in a world of its own: the mean of their times,
/// the most of the rest.
Run blows(uint32_t rate_hz, uint32_t count) {
  Run mean;
  mean.rest_s = mean.all_s = 0.0;
  for (uint32_t seed = 1; seed <= count; ++seed) {
    const CarveRequest request = blow_at(config_at(rate_hz).terrain, 0.0F, 0.0F, 2.0F, 48, seed);
    // The blast's speed, its part upwards, and the reach of the shape from its middle.
    const Run run = play(rate_hz, {request}, 1.7F * request.blast_speed_m_s);
    mean.rest_s += run.rest_s / count;
    mean.all_s += run.all_s / count;
    mean.above_birth_m = std::max(mean.above_birth_m, run.above_birth_m);
  }
  return mean;
}

/// Two tunnels that cross within rock, cut without any blast: the second's pieces lie over and in the
/// first's.
Run crossing_tunnels(uint32_t rate_hz) {
  CarveRequest request;
  request.seeds = 64;
  request.blast_speed_m_s = 0.0F;
  request.shape = capsule({-5.0F, -6.0F, 0.0F}, {5.0F, -6.0F, 0.0F}, 1.5F);
  request.impact_m = {0.0F, -6.0F, 0.0F};
  std::vector<CarveRequest> carves{request};
  request.shape = capsule({0.0F, -5.5F, -5.0F}, {0.0F, -5.5F, 5.0F}, 1.5F);
  carves.push_back(request);
  return play(rate_hz, carves, 0.0F);
}

/// The times that blocks of different sizes break when they fall 78 m onto rock, and the pieces that they
/// break into; means.
struct Broken {
  double breaks = 0.0;
  double pieces = 0.0;
};

Broken falling_blocks(uint32_t rate_hz, int blocks) {
  Broken sum;
  for (int i = 0; i < blocks; ++i) {
    WorldConfig config;
    config.terrain = {TerrainKind::flat, 1, 0.25F};
    config.tick_rate_hz = rate_hz;
    config.methods.dents = false;
    World world(config);
    const float half_m = 0.75F + 0.09F * static_cast<float>(i);
    const Command hung{
        .body = FillRequest{box({0.13F * static_cast<float>(i), 78.0F + half_m, 0.0F}, glm::vec3(half_m))}};
    auto delta = world.step({&hung, 1});
    for (uint32_t tick = 0; tick < 8 * rate_hz; ++tick) {
      for (const AppliedOperation& applied : delta->operations)
        sum.breaks += std::holds_alternative<ShatterOperation>(applied.operation) ? 1.0 / blocks : 0.0;
      sum.pieces += tick == 0 ? 0.0 : static_cast<double>(delta->spawned.size()) / blocks;
      delta = world.step({});
    }
  }
  return sum;
}

}  // namespace

BenchReport run_rates_bench(const BenchOptions& options) {
  BenchReport report;
  std::map<uint32_t, Run> blasts, tunnels;
  std::map<uint32_t, Broken> falls;
  for (const uint32_t rate_hz : rates_hz) {
    blasts[rate_hz] = blows(rate_hz, options.quick ? 2 : blows_max);
    tunnels[rate_hz] = crossing_tunnels(rate_hz);
    falls[rate_hz] = falling_blocks(rate_hz, options.quick ? 4 : 24);
    options.progress(static_cast<double>(blasts.size()) / static_cast<double>(std::size(rates_hz)));
  }
  for (const auto& [rate_hz, run] : blasts) {
    const std::string name = fmt::format("at_{}_hz", rate_hz);
    const Run& tunnel = tunnels.at(rate_hz);
    const Broken& broken = falls.at(rate_hz);
    report.metric(name + "_falls_breaks", broken.breaks);
    report.metric(name + "_falls_pieces", broken.pieces);
    const double by_rate = broken.pieces / falls.at(60).pieces;
    report.check(name + "_falls", by_rate >= 0.9 && by_rate <= 1.1,
                 fmt::format("{:.2f} of the pieces at 60 Hz, wanted 0.9 to 1.1", by_rate));
    report.metric(name + "_half_merged_s", run.rest_s);
    report.metric(name + "_all_merged_s", run.all_s);
    report.metric(name + "_above_birth_energy_m", run.above_birth_m);
    report.metric(name + "_tunnels_speed_over_fall", tunnel.speed_over_fall);
    report.metric(name + "_tunnels_above_birth_energy_m", tunnel.above_birth_m);
    const double ratio = run.all_s / blasts.at(60).all_s;
    report.check(name + "_rest", ratio >= 0.75 && ratio <= 1.25,
                 fmt::format("{:.2f} of the time at 60 Hz in the mean, wanted 0.75 to 1.25", ratio));
    report.check(name + "_height", run.above_birth_m <= 0.5F && tunnel.above_birth_m <= 0.5F,
                 fmt::format("{:.2f} and {:.2f} m above their energy at birth, wanted at most 0.5",
                             run.above_birth_m, tunnel.above_birth_m));
    report.check(name + "_speed", tunnel.speed_over_fall < 1.0F,
                 fmt::format("{:.2f} of the speed of the fall, wanted below 1", tunnel.speed_over_fall));
  }
  return report;
}

}  // namespace scree
