#include "studies/scale/simulated_bots.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/support/scenes.h"
#include "server/world/world.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "studies/scale/loaded_server.h"
#include "studies/scale/most_held.h"

namespace scree {

namespace {

constexpr float bot_area_m = 6.0F;  ///< around its place
constexpr double turn_s = 1.0;      ///< from turn to turn, on average

struct Bot {
  double next_s = 0.0;
  uint32_t request = 0;
  Tick asked = 0;
  bool waits = false;
  bool counted = false;
};

class BotsAndWorld {
 public:
  explicit BotsAndWorld(const BotsToSimulate& what) : what_(what), random_(what.random_seed) {
    config_.terrain.kind = TerrainKind::noise;
    world_ = std::make_unique<World>(config_);
    side_ = static_cast<unsigned>(std::ceil(std::sqrt(static_cast<double>(what.bots))));
    bots_.resize(what.bots);
    for (Bot& bot : bots_) bot.next_s = turn_s * static_cast<double>(random_.unit());
  }

  SimulatedBots run() {
    const Tick warm = ticks_in(what_.warm_s), end = warm + ticks_in(what_.seconds);
    for (Tick tick = 0; tick < end; ++tick) step(tick, tick >= warm);
    // The requests that count are answered under the same load.
    const Tick late = end + ticks_in(1.1e-3 * reply_max_ms);
    for (Tick tick = end; tick < late && open_ > 0; ++tick) step(tick, false);
    return result();
  }

 private:
  Tick ticks_in(double seconds) const { return static_cast<Tick>(seconds * config_.tick_rate_hz); }
  float along(unsigned place) {
    return (static_cast<float>(place) - 0.5F * static_cast<float>(side_ - 1)) * bots_apart_m +
           (2.0F * random_.unit() - 1.0F) * bot_area_m;
  }

  std::vector<Command> turns(Tick tick, bool counted) {
    std::vector<Command> commands;
    const double now_s = static_cast<double>(tick) / config_.tick_rate_hz;
    for (unsigned number = 0; number < bots_.size(); ++number) {
      Bot& bot = bots_[number];
      if (now_s < bot.next_s) continue;
      bot.next_s += turn_s * (0.5 + static_cast<double>(random_.unit()));
      turns_ += counted ? 1 : 0;
      if (bot.waits) continue;
      bot = {bot.next_s, bot.request + 1, tick, true, counted};
      open_ += counted ? 1 : 0;
      commands.push_back({number + 1, bot.request,
                          blow_at(config_.terrain, along(number % side_), along(number / side_), bot_radius_m,
                                  bot_seeds, random_.next())});
    }
    return commands;
  }

  void receive(const Reply& reply, Tick tick) {
    Bot& bot = bots_.at(reply.session - 1);
    bot.waits = false;
    if (!bot.counted) return;
    --open_;
    reply_ms_.push_back(1e3 * static_cast<double>(tick + 1 - bot.asked) / config_.tick_rate_hz);
    refused_ += reply.refusal.empty() ? 0 : 1;
  }

  void step(Tick tick, bool counted) {
    const std::vector<Command> commands = turns(tick, counted);
    const double before_s = thread_cpu_s();
    const auto delta = world_->step(commands);
    const double taken_ms = (thread_cpu_s() - before_s) * 1e3;
    for (const Reply& reply : delta->replies) receive(reply, tick);
    if (!counted) return;
    cpu_ms_ += taken_ms;
    clock_ms_ += delta->times.total_ms();
    bodies_ms_ += delta->times[TickStage::bodies];
    alive_ += static_cast<double>(delta->pieces.size());
  }

  SimulatedBots result() const {
    SimulatedBots found;
    const double seconds = what_.seconds;
    const auto answered = static_cast<double>(reply_ms_.size());
    found.served.turns_per_s = static_cast<double>(turns_) / seconds;
    found.served.carves_per_s = (answered - static_cast<double>(refused_)) / seconds;
    found.served.refused = static_cast<double>(refused_) / std::max(1.0, answered);
    found.served.reply_p99_ms = reply_p99_of(reply_ms_, open_);
    found.served.ticks_per_s = config_.tick_rate_hz;
    const double shared_ms_s = clock_ms_ > 0.0 ? cpu_ms_ * bodies_ms_ / clock_ms_ / seconds : 0.0;
    found.load = {.bots = static_cast<double>(what_.bots),
                  .serial_ms_s = cpu_ms_ / seconds - shared_ms_s,
                  .shared_ms_s = shared_ms_s,
                  .pieces_alive = alive_ / static_cast<double>(ticks_in(seconds))};
    return found;
  }

  BotsToSimulate what_;
  Random random_;
  WorldConfig config_;
  std::unique_ptr<World> world_;
  unsigned side_ = 1;
  std::vector<Bot> bots_;
  std::vector<double> reply_ms_;  ///< of counted requests
  size_t turns_ = 0, refused_ = 0, open_ = 0;
  double cpu_ms_ = 0.0, clock_ms_ = 0.0, bodies_ms_ = 0.0, alive_ = 0.0;
};

constexpr size_t search_from = 28;            ///< bots
constexpr size_t light_loads[] = {2, 6, 12};  ///< of the curve's steep part, below the search

}  // namespace

SimulatedBots simulate_bots(const BotsToSimulate& what) {
  return BotsAndWorld(what).run();
}

Result<SimulationCosts> measure_simulation(bool quick) {
  const double seconds = quick ? 1.0 : 8.0;
  std::map<size_t, SimulatedBots> found;
  const auto simulate = [&](size_t bots) -> const SimulatedBots& {
    const auto [at, is_new] = found.try_emplace(bots);
    if (is_new)
      at->second = simulate_bots(
          {.bots = static_cast<unsigned>(bots), .warm_s = quick ? 1.0 : 2.5, .seconds = seconds});
    return at->second;
  };
  for (const size_t bots : light_loads) simulate(bots);
  const auto most =
      most_held({.start = search_from, .growth = quick ? 2.0 : 1.4, .within = quick ? 0.5 : 0.06},
                [&](size_t bots) { return Result<bool>(simulate(bots).served.holds()); });
  TRY(most);
  SimulationCosts costs;
  costs.bots_most = static_cast<double>(most->holds);
  for (const auto& [bots, simulated] : found)
    if (bots <= std::max(most->holds, *std::ranges::max_element(light_loads)))
      costs.loads.push_back(simulated.load);
  return costs;
}

}  // namespace scree
