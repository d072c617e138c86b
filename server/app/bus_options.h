// The options of scree-server's bus (server/bus): a world that is told, and edges that show it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/bus/bus.h"
#include "server/told/told_source.h"
#include "server/told/world_teller.h"

namespace CLI {
class App;
}

namespace scree {

struct LiveConfig;

struct BusOptions {
  BusConfig bus;          ///< without an address: there is none
  bool edge = false;      ///< shows a world that another server tells
  std::string edge_name;  ///< empty: one is drawn
  uint32_t stream_mb = 256;
  bool in_memory = false;

  /// `app` has the other options already.
  void declare(CLI::App& app);
  /// Checks them together; throws CLI::ValidationError. `world`: its name.
  void complete(const std::string& world) const;
  bool is_on() const { return !bus.url.empty(); }
};

/// Connects to the bus, and fills in what a live server needs of it but for an edge's world.
Result<void> connect_bus(const BusOptions& options, LiveConfig& live);
/// An edge's world, once it is told; an error: not yet, or it cannot be shown.
Result<void> await_world(LiveConfig& live);

}  // namespace scree
