#include "server/app/flight_options.h"

#include <CLI/CLI.hpp>

#include "server/app/live_server.h"
#include "shared/base/option_check.h"

namespace scree {

void declare_flight(CLI::App& app, LiveConfig& live) {
  bounded(app.add_option("--slow-ms", live.slow.late_ms,
                         "milliseconds by which a tick makes the game late from which on it counts as slow: "
                         "scree admin slow says why"),
          {limits::slow_ms_min, limits::slow_ms_max})
      ->capture_default_str();
  app.add_option("--slow-log", live.slow_log_path,
                 "appends slow ticks to this file, one a line (JSON Lines), ten a minute at most")
      ->check(check_writable, "FILE");
}

}  // namespace scree
