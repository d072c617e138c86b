#include "server/app/server_program.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "server/app/prop_models.h"
#include "server/app/resident_memory.h"
#include "server/app/server_options.h"
#include "server/work/limits.h"
#include "shared/base/program_output.h"

namespace scree {
namespace {

constexpr int failed = 1;
/// How often the end of the session is looked for, ns.
constexpr long poll_period_ns = 20'000'000;

/// Blocked before any thread starts, so that only wait_for_end() sees them.
sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

void reload(LiveServer& server) {
  if (const auto reloaded = server.reload(); reloaded)
    spdlog::info("certificate, keys, revoked tokens, bans and the page were read again (SIGHUP)");
  else
    spdlog::error("nothing was read again (SIGHUP), the old values stay in force: {}",
                  reloaded.error().message);
}

void wait_for_end(LiveServer& server, const sigset_t& signals) {
  const timespec period{0, poll_period_ns};
  while (server.running()) {
    const int signal = sigtimedwait(&signals, nullptr, &period);
    if (signal < 0) continue;
    if (signal == SIGHUP) {
      reload(server);
      continue;
    }
    spdlog::info("stopping ({})", signal == SIGINT ? "SIGINT" : "SIGTERM");
    return;
  }
}

bool write_report(const LiveServer& server, const std::string& path) {
  if (path.empty()) return true;
  std::ofstream file(path);
  file << to_json(server.report());
  file.close();
  if (file) return true;
  spdlog::error("the report cannot be written to {} (--report)", path);
  return false;
}

/// Loads the rules, if there are any. The simulation has so much less of each tick.
Result<void> load_rules(RulesOptions options, LiveConfig& live, std::unique_ptr<Rules>& rules) {
  if (options.folders.empty()) return {};
  options.tick_rate_hz = live.world.tick_rate_hz;
  options.log = [](const std::string& line, bool is_fault) {
    spdlog::log(is_fault ? spdlog::level::warn : spdlog::level::info, "{}", line);
  };
  live.world.work_percent = std::max(
      limits::work_percent_min, live.world.work_percent - std::min(live.world.work_percent, options.percent));
  rules = TRY(Rules::load(std::move(options)));
  live.hooks = rules->hooks();
  return {};
}

int run(const ServerOptions& options) {
  const sigset_t signals = block_signals();
  spdlog::set_default_logger(spdlog::stderr_color_mt("scree-server"));
  spdlog::set_level(spdlog::level::from_str(options.log_level));
  spdlog::set_pattern("[%Y-%m-%dT%H:%M:%S.%e%z] [%n] [%^%l%$] %v");  // ISO 8601, with the zone
  LiveConfig live = options.live;
  std::unique_ptr<Rules> rules;  // outlives the server, which calls it
  if (const auto loaded = load_rules(options.rules, live, rules); !loaded) {
    spdlog::error("{}", loaded.error().message);
    return failed;
  }
  auto server = LiveServer::start(live);
  if (!server) {
    spdlog::error("{}", server.error().message);
    return failed;
  }
  tell_models(options.models);
  if (!options.token_made.empty())
    spdlog::warn("an admin token was made: it is the line in {}, which only this server's user can read",
                 options.token_made);
  std::printf("%s\n", listening_line((*server)->port(), options.live.net).c_str());
  std::fflush(stdout);
  wait_for_end(**server, signals);
  const auto stopped = (*server)->stop();
  const bool reported = write_report(**server, options.report_path);
  const ServerReport report = (*server)->report();
  spdlog::info("{} ticks, {} carves and dents, {} pieces made, {} merged, {} alive, ledger error {}",
               report.ticks, report.operations.of<CarveOperation>(), report.pieces_made, report.pieces_merged,
               report.pieces_alive, report.ledger.error());
  return stopped && reported ? 0 : failed;
}

}  // namespace

int server_program(int argc, char** argv) {
  bound_heap_arenas();
  fail_at_file_limit();
  const auto options = parse_server_options(argc, argv);
  if (const int* status = std::get_if<int>(&options)) return *status;
  return run(std::get<ServerOptions>(options));
}

}  // namespace scree
