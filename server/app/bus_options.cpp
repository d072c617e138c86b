#include "server/app/bus_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "crypto/signing_key.h"
#include "server/app/ground_giver.h"
#include "server/app/live_server.h"
#include "shared/base/option_check.h"

namespace scree {

namespace {

constexpr uint32_t stream_mb_least = 16;
constexpr uint32_t stream_mb_most = 1'000'000;

}  // namespace

void BusOptions::declare(CLI::App& app) {
  CLI::Option* nats = app.add_option(
      "--nats", bus.url,
      "address of a NATS server, such as nats://USER:PASSWORD@HOST:4222 or tls://HOST: the world is told "
      "there, under --world-name, to edges");
  app.add_option("--nats-creds", bus.credentials_path, "file with the credentials of NATS's user")
      ->check(CLI::ExistingFile)
      ->needs(nats);
  app.add_option("--nats-ca", bus.ca_path, "PEM file of certificates by which NATS's server is known")
      ->check(CLI::ExistingFile)
      ->needs(nats);
  bounded(app.add_option("--nats-stream-mb", stream_mb,
                         "megabytes that NATS keeps of the world: keyframes, and the ticks behind them"),
          whole_within(stream_mb_least, stream_mb_most))
      ->capture_default_str()
      ->needs(nats);
  app.add_flag("--nats-in-memory", in_memory, "NATS keeps them in its memory, not in files")->needs(nats);
  CLI::Option* as_edge =
      app.add_flag("--edge", edge,
                   "shows the world that the simulating server tells under --world-name, and hands on what "
                   "people ask: scree edge")
          ->needs(nats);
  for (const char* of_the_simulation :
       {"--world", "--record", "--replay", "--events", "--terrain", "--seed", "--voxel-size", "--tick-rate",
        "--govern", "--rules", "--game", "--nats-stream-mb", "--nats-in-memory"})
    as_edge->excludes(app.get_option(of_the_simulation));
  app.get_option("--replay")->excludes(nats);
  app.add_option("--edge-name", edge_name, "this edge's name, which no other has; default: a random one")
      ->needs(as_edge);
}

void BusOptions::complete(const std::string& world) const {
  if (!is_on()) return;
  if (!is_bus_name(world))
    throw CLI::ValidationError("--nats", world.empty()
                                             ? "give the world's name on the bus, too (--world-name)"
                                             : "'" + world +
                                                   "' cannot be a world's name on the bus: write a-z, 0-9, - "
                                                   "and _ (--world-name)");
  if (!edge_name.empty() && !is_bus_name(edge_name))
    throw CLI::ValidationError("--edge-name", "write a-z, 0-9, - and _");
}

Result<void> connect_bus(const BusOptions& options, LiveConfig& live) {
  if (!options.is_on()) return {};
  BusConfig bus = options.bus;
  bus.name = options.edge ? "scree-edge" : "scree-server";
  live.bus = TRY(Bus::connect(bus));
  live.bus_is_encrypted = options.bus.url.starts_with("tls://") || !options.bus.ca_path.empty();
  live.tell.world = live.net.access.world;
  live.tell.stream_mb = options.stream_mb;
  live.tell.in_memory = options.in_memory;
  live.edge_name = options.edge_name.empty() ? fmt::format("{:016x}", random_number()) : options.edge_name;
  return {};
}

Result<void> await_world(LiveConfig& live) {
  live.told = TRY(ToldSource::open(live.bus, live.tell.world, ground_giver(".", live.world),
                                   live.net.ticks_per_transform));
  return {};
}

}  // namespace scree
