// The options of scree-bot, from its command line and its environment.
#pragma once

#include <string>
#include <variant>

#include "client/bot/bot.h"

namespace scree {

struct BotOptions {
  BotConfig bot;
  std::string report;  ///< file for the report; empty: none; "-": the standard output
  bool quiet = false;
  std::string warning;  ///< for the log, if not empty: the cache's folder cannot be used
};

/// The options, or the exit status where the program is to end at once: 0 after --help and --version, 2 after
/// wrong usage, which has been said on the standard error.
std::variant<BotOptions, int> parse_bot_options(int argc, char** argv);

}  // namespace scree
