// slow and top.
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>
#include <unistd.h>

#include "client/admin/programs/interrupt.h"
#include "client/admin/programs/world_commands.h"
#include "proto/limits.h"
#include "shared/base/length_of_time.h"
#include "shared/base/option_check.h"

namespace scree {

namespace {

constexpr double since_max_s = 86'400.0;
constexpr std::chrono::seconds refresh{2};
constexpr std::chrono::milliseconds interrupt_period{50};
/// Clears a terminal and goes to its first line (ECMA-48, ED and CUP).
constexpr const char* clear_screen = "\x1b[H\x1b[2J";

struct FlightWords {
  std::string since;
  uint32_t worst = 0;
  bool once = false;
};

Printed print_slow(const AdminServer& server, const FlightWords& words, bool as_json) {
  ListFlightRequest request;
  if (!words.since.empty()) {
    const auto seconds = seconds_of(words.since, 1.0, since_max_s);
    if (!seconds) return misused({"--since: " + seconds.error().message});
    request.since_s = static_cast<uint32_t>(*seconds);
  }
  if (words.worst != 0) {
    request.list = FlightList::worst;
    request.most = words.worst;
  }
  return print_said(list_flight(server, request), as_json ? slow_ticks_json : slow_ticks_lines);
}

/// Sleeps, but not beyond an interrupt.
void sleep_between_refreshes() {
  for (auto slept = std::chrono::milliseconds(0); slept < refresh && !was_interrupted();
       slept += interrupt_period)
    std::this_thread::sleep_for(interrupt_period);
}

/// On a terminal again and again, until it is interrupted or the server is gone.
Printed print_top(const AdminServer& server, const FlightWords& words, bool as_json) {
  const auto text = as_json ? parties_json : parties_lines;
  const ListFlightRequest request{.list = FlightList::parties};
  while (!words.once && !as_json && ::isatty(STDOUT_FILENO) != 0) {
    const Printed said = print_said(list_flight(server, request), text);
    if (!said) return said;
    std::printf("%s%s", clear_screen, said->c_str());
    std::fflush(stdout);
    sleep_between_refreshes();
    if (was_interrupted()) return "";
  }
  return print_said(list_flight(server, request), text);
}

}  // namespace

void add_flight_commands(CLI::App& app, WorldCommands& table) {
  const auto words = std::make_shared<FlightWords>();
  CLI::App* const slow = app.add_subcommand(
      "slow",
      "says which ticks were slow, and why: who caused it, or that the disk, the network thread or "
      "the machine did");
  slow->add_option("--since", words->since, "only the last 30s, 5m or 1h; default: all that there are");
  bounded(
      slow->add_option("--worst", words->worst, "the so many ticks that made the game latest, slow or not"),
      whole_within(1, static_cast<double>(limits::slow_rows_max)));
  CLI::App* const top = app.add_subcommand(
      "top", "lists parties by work, with their pieces, bytes and refusals; on a terminal again and again");
  top->add_flag("--once", words->once, "prints the list once, on a terminal, too");
  table.push_back({slow, [words](const AdminServer& server, bool as_json) {
                     return print_slow(server, *words, as_json);
                   }});
  table.push_back(
      {top, [words](const AdminServer& server, bool as_json) { return print_top(server, *words, as_json); }});
}

}  // namespace scree
