// A server in real time and bots on loopback, all in this process: what the bots see, and how the ticks hold.
#pragma once

#include <vector>

#include "bench/wire/intruders.h"
#include "client/bot/bot.h"
#include "server/app/live_server.h"

namespace scree {

struct CrowdOutcome {
  std::vector<BotReport> bots;  ///< in their configurations' order
  ServerReport server;          ///< at the end
  double ticks_per_s = 0.0;     ///< while all bots played
  std::vector<double> falls_s;  ///< beside an intruder: of an honest client's towers
};

/// Lets each bot play on a thread of its own for that many seconds. Port and time-outs are filled in. A
/// server that does not start is an error. `intruder`: plays beside them, with a client whose towers are to
/// fall; null: neither does.
Result<CrowdOutcome> play(const WorldConfig& world, std::vector<BotConfig> bots, double seconds,
                          const IntruderKind* intruder = nullptr);

/// Bots on a square grid about the origin, `spacing_m` apart; each carves within 8 m of its place.
std::vector<BotConfig> bots_on_a_grid(size_t count, float spacing_m, const BotConfig& like);

/// Share of the carves that were asked for, and answered, which were accepted.
double accepted_share(const BotReport& report);

}  // namespace scree
