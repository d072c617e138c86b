// The subcommands of scree-admin that are about bodies: add-prop, move-prop, remove-prop, push, blast,
// cut-out, carve-piece and release.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/admin/admin.h"

namespace scree {

/// What these were told. Metres, kilograms, seconds.
struct PropWords {
  std::string shape;
  std::vector<float> size_m;
  std::array<float, 3> at_m{}, velocity_m_s{}, spin_rad_s{}, impulse_n_s{};
  float mass_kg = 0.0F, energy_j = 4.2e6F;
  std::string motion = "dynamic", material;
  std::string model;  ///< a file, or its SHA-256; empty: none
  uint64_t tag = 0;
  uint32_t id = 0;
  std::vector<float> half_m;  ///< of a box; else a ball of this radius
  float radius_m = 1.0F;
  uint32_t seeds = 8;
};

struct PropCommands {
  CLI::App *add = nullptr, *move = nullptr, *push = nullptr, *remove = nullptr, *blast = nullptr;
  CLI::App *cut_out = nullptr, *carve_piece = nullptr, *release = nullptr;
};

/// Adds the subcommands; `words` outlives the app.
PropCommands add_prop_commands(CLI::App& app, PropWords& words);

/// The request of a subcommand that was given. Asks the server for its materials where one was named.
Result<Request> request_of(const PropCommands& commands, const PropWords& words, const AdminServer& server);

/// "prop 31 is added", or what else the answer says; or as JSON.
std::string answer_text(const ReplyMessage& reply, bool as_json);

}  // namespace scree
