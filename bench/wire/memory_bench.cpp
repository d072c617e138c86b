// What a server's process takes in memory while terrain is edited all over the world.
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/support/benches.h"
#include "bench/support/scratch.h"
#include "bench/support/server_process.h"
#include "bench/wire/askers.h"
#include "server/world/world_config.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr uint32_t memory_max_mb = 512;
constexpr float half_width_m = 2000.0F;
constexpr double seconds_max = 900.0;  ///< for all edits: a server that refuses to go on ends the bench

/// Seconds until nothing lies loose any more: what flies is memory, too.
constexpr double settle_s = 10.0;

}  // namespace

/// The program scree-server, as a user starts it: hills, and a temporary file for what does not fit.
BenchReport run_memory_bench(const BenchOptions& options) {
  BenchReport report;
  const size_t edits = options.quick ? 300 : 5000;
  const ScratchFolder folder("memory");
  ::setenv("XDG_CACHE_HOME", (folder / "").c_str(), 1);
  const std::string told_path = folder / "report.json";
  ServerProcess server(server_program().c_str(), {"--memory-max", std::to_string(memory_max_mb), "--reach",
                                                  "16384", "--report", told_path});
  if (server.port() == 0) {
    report.check("server_starts", false, server_program().string() + " does not start");
    return report;
  }
  auto viewers = Askers::connect({.port = server.port(),
                                  .terrain = WorldConfig().terrain,
                                  .viewers = 10,
                                  .spread_m = half_width_m,
                                  .seconds_per_carve = 0.3,
                                  .radius_m = 8.0F,
                                  .seeds = 8,
                                  .anywhere = true,
                                  .carves_max = edits});
  if (!viewers) {
    report.check("viewers_join", false, viewers.error().message);
    return report;
  }
  (*viewers)->count(true);
  (*viewers)->start();
  Stopwatch stopwatch;
  double busy_s = 0.0;
  while (!(*viewers)->finished() && busy_s < seconds_max) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    busy_s += stopwatch.lap_ms() * 1e-3;
    options.progress(static_cast<double>((*viewers)->answered()) / static_cast<double>(edits));
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(settle_s));
  (*viewers)->stop();
  const double most_mib = server.memory_mib("VmHWM");
  const int status = server.end(SIGTERM);
  const auto told = nlohmann::json::parse(std::ifstream(told_path), nullptr, false);
  report.check("server_ends", status == 0 && told.is_object(), fmt::format("with {}", status));
  if (!told.is_object()) return report;

  const AskedTimes& times = (*viewers)->times();
  const size_t answered = times.reply.size(), accepted = answered - times.refused;
  report.metric("edits", static_cast<double>(times.asked));
  report.metric("accepted", static_cast<double>(accepted));
  report.metric("seconds", busy_s);
  report.metric("resident_most_mib", most_mib);
  report.metric("model_mb", told["work"]["memory_mb"].get<double>());
  for (const char* count : {"in_memory", "out", "read", "waits"})
    report.metric(std::string("chunks_") + count, told["chunks"][count].get<double>());
  report.metric("tick_p99_ms", told["stages_ms"]["whole_tick"]["p99"].get<double>());
  report.check("resident_most_mib", most_mib <= memory_max_mb,
               fmt::format("{:.0f}, at most {}", most_mib, memory_max_mb));
  report.check("accepted", accepted == edits, fmt::format("{} of {}", accepted, edits));
  report.check("ledger", told["ledger"]["error"] == 0, "error of the ledger");
  report.check("viewers_lost", (*viewers)->lost() == 0, fmt::format("{}", (*viewers)->lost()));
  return report;
}

}  // namespace scree
