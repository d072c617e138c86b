#include "server/app/server_program.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>

#include "server/agones/agones.h"
#include "server/app/config_command.h"
#include "server/app/config_reload.h"
#include "server/app/prop_models.h"
#include "server/app/resident_memory.h"
#include "server/app/server_options.h"
#include "server/app/service_notice.h"
#include "server/log/log.h"
#include "server/log/log_config.h"
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

void tell_options(LiveServer& server, const OptionChanges& changes) {
  for (const std::string& line : changes.later) log_of(LogPart::app).warn("the file of options: {}", line);
  if (changes.level) set_levels(changes.log);
  if (changes.settings.empty()) return;
  std::string words;
  for (const SettingValue& setting : changes.settings) words += " " + setting.name + "=" + setting.value;
  if (const auto changed = server.change_settings(changes.settings); !changed)
    log_of(LogPart::app).warn("the file of options: nothing is set: {}", changed.error().message);
  else
    log_of(LogPart::app).info("the file of options sets{}", words);
}

void reload(LiveServer& server, ConfigReload& config) {
  notify_reloading();
  const auto changes = config.read();
  const auto reloaded = changes ? server.reload() : tl::unexpected(changes.error());
  if (!reloaded)
    log_of(LogPart::app)
        .error("nothing was read again (SIGHUP), the old values stay in force: {}", reloaded.error().message);
  else
    log_of(LogPart::app)
        .info("{}certificate, keys, revoked tokens, bans and the page were read again (SIGHUP)",
              *changes ? "the file of options, " : "");
  if (reloaded && *changes) tell_options(server, **changes);
  notify_ready();
}

/// Whether a signal ended it.
bool wait_for_end(LiveServer& server, const sigset_t& signals, ConfigReload& config) {
  const timespec period{0, poll_period_ns};
  while (server.running()) {
    const int signal = sigtimedwait(&signals, nullptr, &period);
    if (signal < 0) continue;
    if (signal == SIGHUP) {
      reload(server, config);
      continue;
    }
    log_of(LogPart::app).info("stopping ({})", signal == SIGINT ? "SIGINT" : "SIGTERM");
    return true;
  }
  return false;
}

bool write_report(const LiveServer& server, const std::string& path) {
  if (path.empty()) return true;
  std::ofstream file(path);
  file << to_json(server.report());
  file.close();
  if (file) return true;
  log_of(LogPart::app).error("the report cannot be written to {} (--report)", path);
  return false;
}

/// Loads the rules, if there are any. The simulation has so much less of each tick.
Result<void> load_rules(RulesOptions options, LiveConfig& live, std::unique_ptr<Rules>& rules) {
  if (options.folders.empty()) return {};
  options.tick_rate_hz = live.world.tick_rate_hz;
  options.log = [](const std::string& line, bool is_fault) {
    log_of(LogPart::rules).write(is_fault ? LogLevel::warn : LogLevel::info, line);
  };
  live.world.work_percent = std::max(
      limits::work_percent_min, live.world.work_percent - std::min(live.world.work_percent, options.percent));
  rules = TRY(Rules::load(std::move(options)));
  live.hooks = rules->hooks();
  return {};
}

struct Served {
  int status = failed;
  bool by_signal = false;  ///< it ended
};

/// A server until it ends. A free port that it found stays for the next one of `live`. `agones` may be null.
Served serve(const ServerOptions& options, LiveConfig& live, Agones* agones, const sigset_t& signals,
             ConfigReload& config) {
  auto server = LiveServer::start(live);
  if (!server) {
    log_of(LogPart::app).error("{}", server.error().message);
    return {};
  }
  live.net.port = (*server)->port();
  std::printf("%s\n", listening_line((*server)->port(), options.live.net).c_str());
  std::fflush(stdout);
  notify_ready();
  if (agones != nullptr) agones->ready();
  const bool by_signal = wait_for_end(**server, signals, config);
  if (by_signal || live.told == nullptr) notify_stopping();
  const auto stopped = (*server)->stop();
  const bool reported = write_report(**server, options.report_path);
  const ServerReport report = (*server)->report();
  log_of(LogPart::app)
      .info("{} ticks, {} carves and dents, {} pieces made, {} merged, {} alive, ledger error {}",
            report.ticks, report.operations.of<CarveOperation>(), report.pieces_made, report.pieces_merged,
            report.pieces_alive, report.ledger.error());
  return {stopped && reported ? 0 : failed, by_signal};
}

bool is_told_to_end(const sigset_t& signals) {
  const timespec now{0, 0};
  for (int signal = 0; (signal = sigtimedwait(&signals, nullptr, &now)) > 0;)
    if (signal != SIGHUP) return true;
  return false;
}

/// An edge waits for its world, and begins anew whenever the simulating server does.
int run_edge(const ServerOptions& options, LiveConfig& live, Agones* agones, const sigset_t& signals,
             ConfigReload& config) {
  for (;;) {
    if (const auto told = await_world(live); !told) {
      log_of(LogPart::bus).warn("{}", told.error().message);
      if (is_told_to_end(signals)) return 0;
      continue;
    }
    const Served served = serve(options, live, agones, signals, config);
    const bool begins_anew = live.told->is_over() && !served.by_signal;
    live.told.reset();
    if (!begins_anew) return served.status;
  }
}

int run(const ServerOptions& options, ConfigReload config) {
  const sigset_t signals = block_signals();
  begin_log(options.log, "scree-server");
  LiveConfig live = options.live;
  std::unique_ptr<Rules> rules;  // outlives the server, which calls it
  auto prepared = load_rules(options.rules, live, rules);
  if (prepared) prepared = connect_bus(options.bus, live);
  if (!prepared) {
    log_of(LogPart::app).error("{}", prepared.error().message);
    return failed;
  }
  tell_models(options.models);
  if (!options.token_made.empty())
    log_of(LogPart::app)
        .warn("an admin token was made: it is the line in {}, which only this server's user can read",
              options.token_made);
  const auto agones = options.agones.on ? std::make_unique<Agones>(options.agones) : nullptr;
  live.pulse = [&agones](const LivePulse& pulse) {
    notify_pulse(pulse);
    if (agones) agones->pulse(pulse.sessions, pulse.sessions_max);
  };
  return options.bus.edge ? run_edge(options, live, agones.get(), signals, config)
                          : serve(options, live, agones.get(), signals, config).status;
}

}  // namespace

int server_program(int argc, char** argv) {
  bound_heap_arenas();
  fail_at_file_limit();
  if (is_config_command(argc, argv)) return config_command(argc, argv);
  const auto parsed = parse_server_options(argc, argv);
  if (const int* status = std::get_if<int>(&parsed)) return *status;
  const auto& options = std::get<ServerOptions>(parsed);
  return run(options, ConfigReload(argc, argv, options));
}

}  // namespace scree
