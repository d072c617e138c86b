// The subcommands of scree-admin that are about a world's bodies, joints and space. A row of a table each:
// its subcommand, and what runs once that was given.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "client/admin/admin.h"

namespace scree {

/// What a subcommand prints, or why it does not.
struct Failed {
  // NOLINTNEXTLINE(google-explicit-constructor): what a server says is this as it is
  Failed(Error error, bool by_words = false) : message(std::move(error.message)), misused(by_words) {}

  std::string message;
  bool misused = false;  ///< by its words; else the server refused, or was not there
};
using Printed = tl::expected<std::string, Failed>;
using Made = tl::expected<Request, Failed>;
inline tl::unexpected<Failed> misused(Error error) {
  return tl::unexpected(Failed(std::move(error), true));
}

/// `as_json`: what is printed is JSON.
using RunOnWorld = std::function<Printed(const AdminServer& server, bool as_json)>;
struct WorldCommand {
  const CLI::App* command = nullptr;
  RunOnWorld run;
};
using WorldCommands = std::vector<WorldCommand>;

/// Each adds its subcommands to the app, and their rows to the table.
void add_prop_commands(CLI::App& app, WorldCommands& table);
void add_joint_commands(CLI::App& app, WorldCommands& table);
void add_list_commands(CLI::App& app, WorldCommands& table);
void add_ask_commands(CLI::App& app, WorldCommands& table);
void add_region_commands(CLI::App& app, WorldCommands& table);
void add_store_commands(CLI::App& app, WorldCommands& table);
void add_rules_commands(CLI::App& app, WorldCommands& table);
void add_history_commands(CLI::App& app, WorldCommands& table);
void add_flight_commands(CLI::App& app, WorldCommands& table);
void add_lines_commands(CLI::App& app, WorldCommands& table);

/// A place, or another vector: "X Y Z" or "X,Y,Z", metres or other units.
using Place = std::array<float, 3>;
CLI::Option* add_place(CLI::App* command, const std::string& name, Place& to, const std::string& what);
glm::vec3 vector_of(const Place& numbers);
/// The id of a body or a joint, a positive number; with `or_terrain` also the word "terrain", which is 0.
CLI::Option* add_id(CLI::App* command, const std::string& name, PieceId& to, const std::string& what,
                    bool or_terrain = false);

/// Sends a request, or says why it is none. Prints "prop 31 is added", or what else the answer says.
Printed run_request(const AdminServer& server, const Made& request, bool as_json);
/// What the server said, in lines or as JSON.
template <typename Said>
Printed print_said(const Result<Said>& said, std::string (*text)(const Said&)) {
  if (!said) return tl::unexpected(Failed(said.error()));
  return text(*said);
}

}  // namespace scree
