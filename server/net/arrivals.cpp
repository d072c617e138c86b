#include "server/net/arrivals.h"

#include <fmt/format.h>
#include <optional>

#include "server/log/log.h"
#include "server/net/limits.h"
#include "shared/base/check.h"
#include "shared/base/text.h"
#include "shared/base/timing.h"
#include "transport/proxied_transport.h"
#include "transport/sniffing_transport.h"
#include "transport/tcp_transport.h"
#include "transport/unix_transport.h"

namespace scree {

Result<void> Arrivals::listen() {
  TRY(entrance_.listen(parts_.config.bind, parts_.config.port));
  if (parts_.config.admin_socket.empty()) return {};
  TRY(owners_.listen(parts_.config.admin_socket));
  log_of(LogPart::admin).info("this server's user and root administer it by {}", parts_.config.admin_socket);
  return {};
}

void Arrivals::close() {
  entrance_.close();
  owners_.close();
}

/// A script that hangs does not keep out its owner.
void Arrivals::owner_entered(OwnerEntrance::Socket socket, const std::string& address) {
  const SessionTable::OwnersSessions before = parts_.sessions.of_owner(steady_now_s());
  if (before.refused >= limits::owner_connections_max)
    return owner_refused("too many connections by the admin socket (limits.owner_connections_max)");
  if (before.open.size() >= limits::owner_connections_max)
    before.open.front()->refuse({Refusal::idle_made_room,
                                 "another connection came by the admin socket "
                                 "(limits.owner_connections_max)"});
  begin_session(std::make_shared<UnixTransport>(std::move(socket), address),
                {.address = address, .at_door = false, .is_owner = true}, next_session_++);
}

void Arrivals::owner_refused(const std::string& why) {
  ++parts_.counts.turned_away;
  parts_.log.say(log_of(LogPart::net), LogLevel::warn, "admin_socket", why);
  changed_();
}

void Arrivals::entered(asio::ip::tcp::socket socket, const std::string& address, bool by_proxy) {
  std::shared_ptr<Transport> transport = std::make_shared<TcpTransport>(std::move(socket));
  const uint64_t id = next_session_++;
  if (by_proxy)
    transport =
        std::make_shared<ProxiedTransport>(std::move(transport), [this, id](const ProxiedTransport& stream) {
          named(id, stream.address(), endpoint_text(stream.address(), stream.port()));
        });
  begin(std::move(transport), {address, by_proxy}, id);
}

bool Arrivals::enter(std::shared_ptr<Transport> transport) {
  const std::string address = door_address(transport->address());
  if (const auto no = parts_.door.enter(address, steady_now_s())) {
    count_turned_away(address, {*no, "too many connections"});
    return false;
  }
  begin(std::move(transport), {address}, next_session_++);
  return true;
}

void Arrivals::enter_apart(std::shared_ptr<Transport> transport) {
  const std::string address = transport->address();
  begin_session(std::move(transport), {.address = address, .relayed = true, .at_door = false},
                next_session_++);
}

void Arrivals::turned_away(asio::ip::tcp::socket socket, const std::string& address, const Refused& refused) {
  count_turned_away(address, refused);
  if (!may_hold(steady_now_s())) return tell_and_close(std::move(socket), refused);
  begin(std::make_shared<TcpTransport>(std::move(socket)), {address, false, false, refused}, next_session_++);
}

void Arrivals::count_turned_away(const std::string& peer, const Refused& refused) {
  ++parts_.counts.turned_away;
  parts_.counts.refusals.add(refused.reason);
  parts_.log.say(log_of(LogPart::net), LogLevel::warn, name_of(refused.reason),
                 fmt::format("{} turned away ({}): {}", peer, name_of(refused.reason), refused.message));
  changed_();
}

bool Arrivals::may_hold(double now_s) {
  return parts_.sessions.turned_away() + parts_.web.turned_away() < limits::turned_away_max &&
         held_.try_spend(now_s);
}

/// The place at the door becomes the client's, if the door has one for it. It may be another trusted proxy,
/// which speaks for many as the first does.
void Arrivals::named(uint64_t id, const std::string& ip, const std::string& peer) {
  SessionEntry* const entry = parts_.sessions.find(id);
  CHECK(entry != nullptr);  // as in begin_http()
  const double now_s = steady_now_s();
  const std::string address = relayed_address(ip);
  const bool is_proxy = parts_.config.proxies.contains(ip);
  if (is_proxy) {
    parts_.door.enter_unbounded(address, now_s);
  } else if (const auto no = parts_.door.enter(address, now_s)) {
    const Refused refused = door_refusal(*no);
    count_turned_away(address, refused);
    const bool held = may_hold(now_s);
    entry->session->turn_away(refused);
    if (!held) entry->session->refuse(refused);
    return;
  }
  parts_.door.leave(entry->session->address(), now_s);
  entry->session->come_from(address, peer);
  entry->relayed = entry->is_many = is_proxy;
}

void Arrivals::accepting_failed(const std::string& why) {
  parts_.log.say(log_of(LogPart::net), LogLevel::warn, "accept", "cannot accept connections: " + why);
  close_an_outsider("the server lacks descriptors: " + why);
}

void Arrivals::begin(std::shared_ptr<Transport> transport, const Visitor& from, uint64_t id) {
  SniffingTransport::HttpHandoff http;
  if (parts_.web.speaks_http())
    http = [this, id](std::shared_ptr<Transport> stream, std::span<const uint8_t> arrived) {
      begin_http(id, std::move(stream), arrived);
    };
  const auto& tls = parts_.authorizer.access().tls();
  if (tls || http)
    transport = std::make_shared<SniffingTransport>(std::move(transport), tls, std::move(http));
  begin_session(std::move(transport), from, id);
}

void Arrivals::begin_session(std::shared_ptr<Transport> transport, const Visitor& from, uint64_t id) {
  const SessionTimes times{parts_.config.hello_seconds, parts_.config.stall_seconds,
                           limits::linger_seconds_max};
  const auto session = std::make_shared<ClientSession>(std::move(transport), from.address, id, parts_.host,
                                                       times, steady_now_s());
  if (from.turned_away) session->turn_away(*from.turned_away);
  SessionEntry& entry = parts_.sessions.add(session, from.relayed);
  entry.at_door = from.at_door;
  entry.is_owner = from.is_owner;
  // A client may say itself that it was relayed, which is no way around its address's budget.
  entry.is_many = from.relayed && parts_.config.proxies.contains(session->ip());
  log_of(LogPart::net, id).debug("session {}: {} connected", id, session->peer());
  if (parts_.sessions.outsiders() + parts_.web.size() > parts_.room.outsiders_max())
    close_an_outsider("too many connections that have not said hello (limits.outsiders_max)");
  session->start();
}

/// The connection began as a session that has said nothing.
void Arrivals::begin_http(uint64_t id, std::shared_ptr<Transport> stream, std::span<const uint8_t> arrived) {
  const SessionEntry* const entry = parts_.sessions.find(id);
  CHECK(entry != nullptr);  // a stream that was closed tells of no bytes (Transport::close)
  const auto session = entry->session;
  const Visitor from{session->address(), entry->relayed, entry->at_door, session->turned_away()};
  session->give_up_connection();
  parts_.sessions.erase(id);
  parts_.web.begin(id, from, std::move(stream), arrived);
}

void Arrivals::close_an_outsider(const std::string& why) {
  std::vector<Outsider> outsiders;
  parts_.sessions.list_outsiders(outsiders);
  parts_.web.list_outsiders(outsiders);
  if (outsiders.empty()) return;
  const uint64_t leaver = who_leaves(outsiders).id;
  if (parts_.web.make_room(leaver)) return;
  const auto session = parts_.sessions.at(leaver).session;
  if (session->phase() == ClientSession::Phase::refused) return session->close("refused before");
  session->disconnect(Refusal::outsiders_max, why);
}

}  // namespace scree
