#include "server/net/web_connections.h"

#include <algorithm>
#include <fmt/format.h>

#include "auth/access_token.h"
#include "proto/codec.h"
#include "server/doors/entrance.h"
#include "server/doors/unix_time.h"
#include "server/log/log.h"
#include "server/metrics/figure_page.h"
#include "server/net/limits.h"
#include "server/net/server_health.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "transport/proxied_transport.h"
#include "transport/websocket_transport.h"

namespace scree {

namespace {

/// A client's message may be in one frame.
constexpr uint64_t frame_bytes_max = limits::client_message_bytes_max + length_prefix_bytes;

/// The token of an Authorization field; nothing when it has none.
std::optional<std::string> bearer_token(const std::string& authorization) {
  constexpr std::string_view scheme = "Bearer ";
  if (!authorization.starts_with(scheme)) return std::nullopt;
  return authorization.substr(scheme.size());
}

int status_of(Refusal reason) {
  if (reason == Refusal::token_missing) return 401;
  return reason == Refusal::token_guesses ? 429 : 403;
}

/// The refusal of somebody who is no administrator.
HttpResponse for_administrators(Refusal reason) {
  HttpResponse no = words(status_of(reason), std::string(name_of(reason)));
  if (no.status == 401) no.fields.emplace_back("WWW-Authenticate", "Bearer");
  no.refused = reason;
  return no;
}

/// An answer that nobody keeps; without a text the server is not open yet.
HttpResponse fresh_answer(const char* type, std::string text) {
  if (text.empty()) return words(503, "the server is starting");
  return {.fields = {{"Content-Type", type}, {"Cache-Control", "no-store"}},
          .body = std::make_shared<const std::string>(std::move(text))};
}

}  // namespace

Result<void> WebConnections::open() {
  if (!config_.web.on) return {};
  site_ = std::make_unique<Site>(TRY(web_files(config_.web)), WebNames(config_.web));
  return {};
}

void WebConnections::set_files(std::shared_ptr<const WebFiles> files) {
  if (site_) site_->set_files(std::move(files));
}

void WebConnections::begin(uint64_t id, const Visitor& from, std::shared_ptr<Transport> stream,
                           std::span<const uint8_t> arrived) {
  const HttpTimes times{config_.web.head_seconds, config_.web.idle_seconds, config_.stall_seconds,
                        limits::linger_seconds_max};
  const auto connection =
      std::make_shared<HttpConnection>(std::move(stream), id, *this, times, steady_now_s());
  connections_.emplace(id, Entry{connection, from});
  host_.web_changed();
  connection->start(arrived);
}

void WebConnections::check_time(double now_s) {
  const Connections connections = connections_;  // a connection that is closed is erased
  for (const auto& [id, entry] : connections) entry.connection->check_time(now_s);
}

void WebConnections::stop() {
  stopping_ = true;
  const Connections connections = connections_;  // likewise
  for (const auto& [id, entry] : connections) entry.connection->close();
}

size_t WebConnections::turned_away() const {
  return static_cast<size_t>(std::ranges::count_if(
      connections_, [](const auto& one) { return one.second.from.turned_away.has_value(); }));
}

void WebConnections::list_outsiders(std::vector<Outsider>& outsiders) const {
  for (const auto& [id, entry] : connections_)
    outsiders.push_back({id, Origin(entry.from.address), entry.connection->is_idle(), false});
}

bool WebConnections::make_room(uint64_t id) {
  const auto found = connections_.find(id);
  if (found == connections_.end()) return false;
  const auto connection = found->second.connection;
  if (!connection->is_idle()) disconnect(*connection, Refusal::outsiders_max);
  connection->close();
  return true;
}

WebConnections::Asker WebConnections::asker_of(const HttpConnection& from, const HttpRequest& request) const {
  const Visitor& visitor = connections_.at(from.id()).from;
  const WebPeer here{is_loopback_address(from.ip()) && !request.relayed, door_address(from.ip())};
  if (!config_.proxies.contains(from.ip())) return {from.ip(), visitor.address, here};
  std::string ip = config_.proxies.client_of(request.forwarded_for, from.ip());
  const bool vouched = ip != from.ip() || !request.forwarded_host.empty();
  if (ip == from.ip()) return {std::move(ip), visitor.address, {here.from_here, here.address, vouched}, true};
  const std::string address = relayed_address(ip);
  return {std::move(ip), address, {false, address, vouched}};
}

/// This machine's own programs ask by its own names. For others a proxy here asks that nobody has named, or a
/// page: they share the limits of one address, as behind any proxy that is not trusted.
std::optional<HttpResponse> WebConnections::treat_as_stranger(Entry& entry, const HttpRequest& request) {
  const bool may_be_own = door_.is_free(entry.from.address) ||
                          (has_proxy_here_ && entry.from.address == door_address(entry.connection->ip()));
  if (!may_be_own || !shows_strangers(request)) return std::nullopt;
  const std::string address = relayed_address(entry.connection->ip());
  if (const auto no = door_.move(entry.from.address, address, steady_now_s())) {
    const Refused refused = door_refusal(*no);
    site_->note_refused(request, refused.message);
    return refusal(429, refused.reason, refused.message);
  }
  entry.from.address = address;
  entry.from.relayed = true;
  return std::nullopt;
}

/// A page of this site has come by it: pages of others come no further (SocketDoor), so they cannot take this
/// machine's rights away. A proxy passes on what it likes, so the next stranger may show nothing.
void WebConnections::note_proxy_here() {
  if (has_proxy_here_) return;
  has_proxy_here_ = true;
  door_.share_loopback();
  log_of(LogPart::web)
      .warn(
          "a proxy on this machine brings others here: from now on its own programs have no more rights than "
          "they. Name the proxy by --proxy 127.0.0.1, so that each person behind it has limits of their own");
}

HttpResponse WebConnections::answer(const HttpConnection& from, const HttpRequest& request) {
  ++counts_.web.requests;
  Entry& entry = connections_.at(from.id());
  if (const auto& refused = entry.from.turned_away) {
    HttpResponse no = refusal(429, refused->reason, refused->message);
    no.refused.reset();  // it is counted already
    return no;
  }
  if (auto no = treat_as_stranger(entry, request)) return std::move(*no);
  const Asker asker = asker_of(from, request);
  charge_to(entry, asker);
  if (!asker.is_many && !door_.may_request(asker.address, steady_now_s()))
    return refusal(429, Refusal::http_requests_per_second,
                   "too many requests a second from your address (limits.http_requests_per_second_max)");
  if (stopping_) return refusal(503, Refusal::server_stops, "the server stops");
  const bool asks_health =
      request.path == "/healthz" || request.path == "/livez" || request.path == "/readyz";
  if (asks_health && request.method != HttpMethod::other) return answer_health(request);
  // Programs name the server as they reach it, in a container by a name that it does not know.
  const bool asks_metrics = request.path == "/metrics" && request.method != HttpMethod::other;
  if (!asks_metrics)
    if (auto no = site_->refuse_host(request, asker.peer)) return std::move(*no);
  if (config_.access.tls_required && !from.encrypted()) {
    HttpResponse elsewhere = refusal(307, Refusal::tls_required, "this server accepts only https");
    if (!request.host.empty())
      elsewhere.fields.emplace_back("Location", "https://" + request.host + request.path);
    return elsewhere;
  }
  if (asks_metrics) return metrics(from, asker, request);
  if (request.path == "/status.json" && request.method != HttpMethod::other)
    return status_json(asker, request);
  return answer_site(entry, asker, request);
}

/// A proxy's connection may be charged to another one by each request.
void WebConnections::charge_to(Entry& entry, const Asker& asker) {
  const std::string address = asker.is_many ? std::string() : asker.address;
  if (entry.charged == address) return;
  end_charges(entry);
  entry.charged = address;
  bytes_out_.open(entry.receiver(), steady_now_s());
}

void WebConnections::end_charges(Entry& entry) {
  if (entry.charged) bytes_out_.close(entry.receiver());
  entry.charged.reset();
}

void WebConnections::list_receivers(std::vector<BytesOut::Receiver>& receivers) {
  for (auto& [id, entry] : connections_)
    if (entry.charged) receivers.push_back(entry.receiver());
}

void WebConnections::go_on() {
  std::vector<std::shared_ptr<HttpConnection>> waiting;  // one that is closed is erased
  for (const auto& [id, entry] : connections_)
    if (entry.connection->waits()) waiting.push_back(entry.connection);
  for (const auto& connection : waiting) connection->go_on();
}

/// A WebSocket's place at the door is its person's, and not its proxy's.
HttpResponse WebConnections::answer_site(Entry& entry, const Asker& asker, const HttpRequest& request) {
  HttpResponse response = site_->answer(request, asker.peer);
  if (!response.is_upgrade()) return response;
  if (!config_.proxies.contains(entry.connection->ip())) {
    if (is_loopback_address(entry.connection->ip()) && entry.from.relayed) note_proxy_here();
    entry.from.relayed = entry.from.relayed || request.relayed;
    return response;
  }
  if (asker.ip == entry.connection->ip()) return response;
  const double now_s = steady_now_s();
  if (const auto no = door_.enter(asker.address, now_s)) {
    const Refused refused = door_refusal(*no);
    site_->note_refused(request, refused.message);
    return refusal(429, refused.reason, refused.message);
  }
  door_.leave(entry.from.address, now_s);
  entry.from = {asker.address, false};
  entry.client_ip = asker.ip;
  return response;
}

/// For everybody, plainly too: it says nothing that is not to be known.
HttpResponse WebConnections::answer_health(const HttpRequest& request) {
  const HealthMessage health = host_.health();
  const bool good = request.path == "/healthz" ? health.well
                    : request.path == "/livez" ? health.alive
                                               : health.ready;
  return {.status = good ? 200 : 503,
          .fields = {{"Content-Type", "application/json"}, {"Cache-Control", "no-store"}},
          .body = std::make_shared<const std::string>(health_answer(health))};
}

size_t WebConnections::file_room(const HttpConnection& connection) const {
  return static_cast<size_t>(std::max<int64_t>(0, connections_.at(connection.id()).bytes_out.room));
}

void WebConnections::sent(const HttpConnection& connection, size_t bytes) {
  bytes_out_.charge(connections_.at(connection.id()).bytes_out, bytes);
}

void WebConnections::answered(const HttpResponse& response, size_t bytes) {
  counts_.web.bytes_sent += bytes;
  if (response.is_file) ++(response.status == 304 ? counts_.web.not_modified : counts_.web.files);
  if (response.refused) counts_.refusals.add(*response.refused);
  host_.web_changed();
}

HttpResponse WebConnections::status_json(const Asker& asker, const HttpRequest& request) {
  if (const auto may = may_see_status(asker, request); !may) return for_administrators(may.error().reason);
  NetFigures figures = host_.status_figures();
  // A proxy here that nobody has named may ask, too, and show nothing.
  if (!authorizer_.knows_administrators())
    for (SessionRow& row : figures.sessions) row.name = row.address = "";
  std::string json = config_.status ? config_.status(figures) : std::string();
  return fresh_answer("application/json", std::move(json));
}

/// The figures name no person and no address.
HttpResponse WebConnections::metrics(const HttpConnection& from, const Asker& asker,
                                     const HttpRequest& request) {
  if (const auto may = may_see_metrics(from, asker, request); !may)
    return for_administrators(may.error().reason);
  return fresh_answer(figure_page_type, config_.metrics ? config_.metrics(host_.status_figures()) : "");
}

/// This machine's own programs may by whom no stranger may ask, also where there are administrators. Programs
/// of a network may that ask themselves, or for whom a trusted proxy speaks.
tl::expected<void, Refused> WebConnections::may_see_metrics(const HttpConnection& from, const Asker& asker,
                                                            const HttpRequest& request) {
  if (door_.is_free(asker.address) && !shows_strangers(request)) return {};
  const bool asks_itself = !request.relayed || config_.proxies.contains(from.ip());
  if (asks_itself && any_holds(config_.metrics_readers, asker.ip)) return {};
  return check_administrator(asker, request);
}

/// Where nobody could be an administrator, this machine's own programs may see it. A page that leads a
/// browser here by a name of its own may not, nor may a proxy, and nobody where strangers come by either
/// (Door::is_free).
tl::expected<void, Refused> WebConnections::may_see_status(const Asker& asker, const HttpRequest& request) {
  const bool nobody_can = !authorizer_.knows_administrators();
  if (nobody_can && door_.is_free(asker.address) && !shows_strangers(request)) return {};
  return check_administrator(asker, request);
}

/// By the request's token.
tl::expected<void, Refused> WebConnections::check_administrator(const Asker& asker,
                                                                const HttpRequest& request) {
  if (!authorizer_.knows_administrators()) return refuse(Refusal::no_admin_token, "");
  const auto token = bearer_token(request.authorization);
  if (!token) return refuse(Refusal::token_missing, "");
  if (!is_access_token(*token)) {
    if (!authorizer_.has_admin_token()) return refuse(Refusal::token_malformed, "");
    return authorizer_.check_admin_token(asker.address, *token, steady_now_s());
  }
  const Grant grant = TRY(authorizer_.access().grant(*token, unix_now_s()));
  if (!may_act_as(grant.role, Role::admin)) return refuse(Refusal::role, "");
  return {};
}

void WebConnections::opened_websocket(HttpConnection& from, std::shared_ptr<Transport> stream,
                                      std::span<const uint8_t> arrived) {
  ++counts_.web.websockets;
  auto node = connections_.extract(from.id());
  Entry& entry = node.mapped();
  end_charges(entry);
  if (!entry.client_ip.empty())
    stream = std::make_shared<ProxiedTransport>(std::move(stream), entry.client_ip);
  host_.begin_websocket(std::make_shared<WebSocketTransport>(std::move(stream), frame_bytes_max, arrived),
                        entry.from, from.id());
  host_.web_changed();
}

void WebConnections::disconnect(const HttpConnection& connection, Refusal reason) {
  counts_.refusals.add(reason);
  log_.say(log_of(LogPart::web), LogLevel::warn, name_of(reason),
           fmt::format("connection {}: cut off ({}): it speaks HTTP", connection.id(), name_of(reason)));
}

void WebConnections::ended(HttpConnection& connection) {
  auto node = connections_.extract(connection.id());
  end_charges(node.mapped());
  const Visitor& from = node.mapped().from;
  if (from.at_door) door_.leave(from.address, steady_now_s());
  host_.web_changed();
}

}  // namespace scree
