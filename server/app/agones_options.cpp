#include "server/app/agones_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <string_view>

#include "shared/base/option_check.h"

namespace scree {
namespace {

constexpr const char* port_variable = "AGONES_SDK_HTTP_PORT";
constexpr uint32_t kept_s_most = 86'400;

}  // namespace

void declare_agones(CLI::App& app, AgonesConfig& config) {
  CLI::Option* const on =
      app.add_flag("--agones", config.on,
                   "this server is one of a fleet of Agones: its side-car on this machine is told "
                   "that the server is ready and lives, who is in, and that it ends");
  bounded(app.add_option("--agones-kept", config.kept_s,
                         "seconds that Agones keeps the server for, after the last person has left"),
          whole_within(0, kept_s_most))
      ->capture_default_str()
      ->needs(on);
}

void complete_agones(AgonesConfig& config, const std::string& world, bool edge) {
  config.world = world;
  config.edge = edge;
  const char* const given = std::getenv(port_variable);
  if (!config.on || given == nullptr) return;
  const std::string_view text = given;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), config.port);
  if (fault != std::errc() || end != text.data() + text.size() || config.port == 0)
    throw CLI::ValidationError("--agones", fmt::format("{} is no port: '{}'", port_variable, text));
}

}  // namespace scree
