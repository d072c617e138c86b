// The subcommands of scree-admin, in an app of CLI11: that of the program, or that of one line of its
// console.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>

#include "client/admin/programs/server_commands.h"
#include "client/admin/programs/world_commands.h"

namespace scree {

/// What options before the subcommand say of each.
struct AdminSettings {
  double timeout_s = 10.0;
  bool json = false;

  std::chrono::milliseconds within() const {
    return std::chrono::milliseconds(static_cast<int64_t>(timeout_s * 1000.0));
  }
};

class AdminApp {
 public:
  /// Declares all subcommands, --timeout and --json. `app` outlives this object.
  AdminApp(CLI::App& app, const AdminSettings& settings);
  AdminApp(const AdminApp&) = delete;
  AdminApp& operator=(const AdminApp&) = delete;

  /// As they are after the parsing.
  const AdminSettings& settings() const { return settings_; }
  /// Runs the subcommand that was parsed. Returns the exit status of the program.
  int run(const AdminServer& server);

 private:
  AdminSettings settings_;
  AdminOptions options_;
  AdminCommands commands_;
  WorldCommands of_world_;
};

}  // namespace scree
