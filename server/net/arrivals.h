// Who comes in: connections that the entrance, or something else than a socket, lets in become sessions, and
// those whose first bytes are HTTP become HTTP connections. Those of the owner's entrance speak the protocol
// alone, without TLS. Bounds both together (Room). A few of those that
// the door turns away are held until they can be told so in their own language. On the network thread.
#pragma once

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "server/doors/authorizer.h"
#include "server/doors/entrance.h"
#include "server/doors/limits.h"
#include "server/doors/owner_entrance.h"
#include "server/net/client_session.h"
#include "server/net/host_log.h"
#include "server/net/net_server.h"
#include "server/net/room.h"
#include "server/net/session_table.h"
#include "server/net/visitor.h"
#include "server/net/web_connections.h"
#include "shared/base/rate_limit.h"

namespace scree {

class Arrivals final : public EntranceHost {
 public:
  /// What arrivals become, and by which rules; all of it must outlive this object.
  struct Parts {
    const NetConfig& config;
    Door& door;
    const Authorizer& authorizer;
    SessionTable& sessions;
    const Room& room;
    WebConnections& web;
    SessionHost& host;  ///< of the new sessions
    NetStats& counts;   ///< those turned away are counted there
    HostLog& log;
  };

  /// `changed`: is called when counts have changed.
  Arrivals(asio::io_context& context, const Parts& parts, std::function<void()> changed)
      : parts_(parts),
        changed_(std::move(changed)),
        entrance_(context, parts.door, parts.config.proxies, *this),
        owners_(
            context,
            [this](OwnerEntrance::Socket socket, const std::string& address) {
              owner_entered(std::move(socket), address);
            },
            [this](const std::string& why) { owner_refused(why); }),
        next_session_(parts.config.first_session) {}

  Result<void> listen();
  uint16_t port() const { return entrance_.port(); }
  /// Nobody comes in by the entrances any more.
  void close();

  /// As of NetHost.
  bool enter(std::shared_ptr<Transport> transport);
  void enter_apart(std::shared_ptr<Transport> transport);
  /// Begins a session under this number, which no other has; for a connection that has a place at the door.
  /// Bytes that came already may be answered before it returns.
  void begin_session(std::shared_ptr<Transport> transport, const Visitor& from, uint64_t id);

 private:
  void entered(asio::ip::tcp::socket socket, const std::string& address, bool by_proxy) override;
  void turned_away(asio::ip::tcp::socket socket, const std::string& address, const Refused& refused) override;
  void accepting_failed(const std::string& why) override;

  void owner_entered(OwnerEntrance::Socket socket, const std::string& address);
  void owner_refused(const std::string& why);
  void begin(std::shared_ptr<Transport> transport, const Visitor& from, uint64_t id);
  void begin_http(uint64_t id, std::shared_ptr<Transport> stream, std::span<const uint8_t> arrived);
  void named(uint64_t id, const std::string& ip, const std::string& peer);
  void count_turned_away(const std::string& peer, const Refused& refused);
  /// Whether one more that is turned away may be held until it can be told so in its own language.
  bool may_hold(double now_s);
  void close_an_outsider(const std::string& why);

  const Parts parts_;
  const std::function<void()> changed_;
  Entrance entrance_;
  OwnerEntrance owners_;
  uint64_t next_session_;  ///< 0 is the server itself
  RateLimit held_{limits::turned_away_per_second_max, static_cast<double>(limits::turned_away_max)};
};

}  // namespace scree
