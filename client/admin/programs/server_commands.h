// The subcommands about the server itself. A row of a table each: the subcommand, and what runs once that was
// given.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/admin/admin.h"

namespace scree {

/// The program's exit status for a failure or refusal, and for wrong usage.
inline constexpr int exit_failed = 1;
inline constexpr int exit_usage = 2;

/// What the options of these subcommands say.
struct AdminOptions {
  AdminServer server;
  std::vector<std::string> changes;
  std::string whom;  ///< a session's number, an address, or a material
  uint32_t minutes = 0;
  std::string reason;
  std::vector<std::string> place;
  bool json = false;
  bool alive = false, ready = false;
  bool play = false, pause = false;
  double speed = 0.0;
  std::optional<uint64_t> to_tick;
  std::optional<int64_t> steps;
  std::optional<double> time_s;
  bool next_event = false, previous_event = false;
};

using RunAdmin = int (*)(const AdminOptions&);
using AdminCommands = std::vector<std::pair<const CLI::App*, RunAdmin>>;

/// Both arguments outlive the table.
AdminCommands add_server_commands(CLI::App& app, AdminOptions& options);

/// Prints an error of the program's; returns `code`.
int complain(const Error& error, int code);

}  // namespace scree
