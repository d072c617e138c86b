// A whole server in this thread and without sockets: a world, its network side, and clients that a target
// moves. Clients that joined keep mirrors of the world.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/mirror/mirror.h"
#include "proto/codec.h"
#include "proto/frame_reader.h"
#include "server/net/net_host.h"
#include "server/world/world.h"
#include "tests/fuzz/support/memory_transport.h"

namespace scree {

/// The other end of a session. Whatever a server sends can be decoded, and applied to the mirror.
class FuzzClient {
 public:
  explicit FuzzClient(const std::string& address) : link(std::make_shared<MemoryTransport>(address)) {}

  void send(const ClientMessage& message) { link->send(encode(message)); }
  /// Applies what arrived.
  void receive();
  bool joined() const { return mirror.has_value(); }

  std::shared_ptr<MemoryTransport> link;
  std::optional<Mirror> mirror;
  std::string ticket;   ///< of the welcome
  uint64_t world = 0;   ///< likewise
  bool offers = false;  ///< it says that it has chunks, whether it has or not: then its mirror may lack some
  bool reads = true;
  bool refused = false;
  std::vector<std::vector<uint8_t>> received;  ///< bodies, if `records`
  bool records = false;

 private:
  void apply(const ServerMessage& message);

  FrameReader reader_;
};

class FuzzServer {
 public:
  static constexpr const char* admin_token = "admin-token";
  static constexpr size_t clients_max = 8;

  explicit FuzzServer(const TerrainSource& terrain);
  ~FuzzServer();
  FuzzServer(const FuzzServer&) = delete;
  FuzzServer& operator=(const FuzzServer&) = delete;

  /// A client more, from one of a few addresses; null when there are clients_max.
  FuzzClient* connect(uint32_t address);
  std::vector<std::unique_ptr<FuzzClient>>& clients() { return clients_; }

  /// Moves bytes, at most as many at once, until none move.
  void pump(size_t bytes = SIZE_MAX);
  /// One tick: commands in, messages out. `more` as of NetHost::publish.
  void tick(bool more = false);
  /// Every client reads, and ticks pass until all have what they want; then their copies are the world's.
  void check_mirrors();

  Tick ticks() const { return world_.tick(); }
  uint64_t work_us() const { return work_us_; }

 private:
  CommandQueue commands_;
  World world_;
  NetHost host_;
  std::vector<std::unique_ptr<FuzzClient>> clients_;
  uint64_t work_us_ = 0;
};

}  // namespace scree
