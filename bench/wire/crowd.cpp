#include "bench/wire/crowd.h"

#include <chrono>
#include <cmath>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

BotReport play_one(const BotConfig& config, Clock::time_point end) {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);  // it stands for a machine of its own
  Bot bot(config);
  std::string failure;
  if (const Result<void> joined = bot.join(); !joined) failure = joined.error().message;
  while (failure.empty() && Clock::now() < end)
    if (const Result<void> done = bot.step(std::chrono::milliseconds(10)); !done)
      failure = done.error().message;
  BotReport report = bot.report();
  if (report.failure.empty()) report.failure = failure;
  return report;
}

}  // namespace

Result<CrowdOutcome> play(const WorldConfig& world, std::vector<BotConfig> bots, double seconds,
                          const IntruderKind* intruder) {
  LiveConfig config;
  config.governed = true;
  config.world = world;
  if (intruder != nullptr) config.net.service.sessions_max = 256;
  auto started = TRY(LiveServer::start(config));
  LiveServer& server = *started;
  const auto begin = Clock::now();
  const auto end =
      begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  CrowdOutcome outcome;
  outcome.bots.resize(bots.size());
  std::vector<std::thread> threads;
  for (size_t i = 0; i < bots.size(); ++i) {
    BotConfig& bot = bots[i];
    bot.port = server.port();
    bot.carves = static_cast<uint32_t>(seconds * std::max(bot.rate_hz, 1.0)) + 1;
    bot.timeout_s = seconds + 60.0;
    threads.emplace_back([&outcome, &bot, end, i] { outcome.bots[i] = play_one(bot, end); });
  }
  if (intruder != nullptr) {
    threads.emplace_back([&, port = server.port()] {
      setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);
      intruder->intrude(port, end);
    });
    threads.emplace_back([&, port = server.port()] { outcome.falls_s = falls_of_towers(port, end); });
  }
  const uint64_t ticks_before = server.report().ticks;
  const auto from = Clock::now();
  std::this_thread::sleep_until(end);
  outcome.ticks_per_s = static_cast<double>(server.report().ticks - ticks_before) / seconds_since(from);
  for (std::thread& thread : threads) thread.join();
  TRY(server.stop());
  outcome.server = server.report();
  return outcome;
}

std::vector<BotConfig> bots_on_a_grid(size_t count, float spacing_m, const BotConfig& like) {
  const auto side = static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const auto place = [&](size_t i) {
    return (static_cast<float>(i) - 0.5F * static_cast<float>(side - 1)) * spacing_m;
  };
  std::vector<BotConfig> bots(count, like);
  for (size_t i = 0; i < count; ++i) {
    bots[i].random_seed = i + 1;
    bots[i].carver.centre_m = {place(i % side), 0.0F, place(i / side)};
    bots[i].carver.area_m = 8.0F;
  }
  return bots;
}

double accepted_share(const BotReport& report) {
  const uint32_t answered = report.carves_accepted + report.carves_refused;
  return answered == 0 ? 0.0 : static_cast<double>(report.carves_accepted) / static_cast<double>(answered);
}

}  // namespace scree
