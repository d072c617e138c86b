// The options of scree-server's Agones (server/agones).
#pragma once

#include "server/agones/agones.h"

namespace CLI {
class App;
}

namespace scree {

void declare_agones(CLI::App& app, AgonesConfig& config);
/// Fills in what other options say. Throws CLI::ValidationError.
void complete_agones(AgonesConfig& config, const std::string& world, bool edge);

}  // namespace scree
