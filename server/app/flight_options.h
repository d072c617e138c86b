// The options of scree-server's flight recorder (server/flight).
#pragma once

namespace CLI {
class App;
}

namespace scree {

struct LiveConfig;

/// `live` outlives the parsing.
void declare_flight(CLI::App& app, LiveConfig& live);

}  // namespace scree
