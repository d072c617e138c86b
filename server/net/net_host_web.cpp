// NetHost's part of connections that speak HTTP: they begin as sessions whose first bytes tell, and may
// become sessions again, by a WebSocket.
#include <algorithm>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "auth/access_token.h"
#include "proto/codec.h"
#include "server/doors/unix_time.h"
#include "server/net/net_host.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "transport/websocket_transport.h"

namespace scree {

namespace {

/// A client's message may be in one frame.
constexpr uint64_t frame_bytes_max = limits::client_message_bytes_max + length_prefix_bytes;

/// The token of an Authorization; nothing when it is none.
std::optional<std::string> bearer_token(const std::string& authorization) {
  constexpr std::string_view scheme = "Bearer ";
  if (!authorization.starts_with(scheme)) return std::nullopt;
  return authorization.substr(scheme.size());
}

int status_of(Refusal reason) {
  if (reason == Refusal::token_missing) return 401;
  return reason == Refusal::token_guesses ? 429 : 403;
}

}  // namespace

Result<void> NetHost::open_site() {
  if (!config_.web.on) return {};
  auto files = TRY(web_files(config_.web));
  site_ = std::make_unique<Site>(std::move(files), config_.web.origins);
  return {};
}

void NetHost::take_files(std::shared_ptr<const WebFiles> files) {
  CHECK(network_thread_.is_the_same());
  if (site_) site_->take_files(std::move(files));
}

void NetHost::begin_http(uint64_t id, std::shared_ptr<Transport> stream, std::span<const uint8_t> arrived) {
  const auto entry = sessions_.find(id);
  CHECK(entry != sessions_.end());  // a stream that was closed tells of no bytes (Transport::close)
  const auto session = entry->second.session;
  session->give_up_connection();
  sessions_.erase(entry);
  outsiders_.erase(id);
  const HttpTimes times{config_.web.head_seconds, config_.web.idle_seconds, config_.stall_seconds,
                        limits::linger_seconds_max};
  const auto connection = std::make_shared<HttpConnection>(std::move(stream), session->address(), id, *this,
                                                           times, steady_now_s());
  http_.emplace(id, connection);
  update_stats();
  connection->start(arrived);
}

HttpResponse NetHost::answer(const HttpConnection& from, const HttpRequest& request) {
  ++counts_.web.requests;
  Door& door = entrance_.door();
  if (!door.may_request(from.address(), steady_now_s()))
    return refusal(429, Refusal::http_requests_per_second,
                   "too many requests a second from your address (limits.http_requests_per_second_max)");
  if (stopping_) return refusal(503, Refusal::server_stops, "the server stops");
  if (config_.access.tls_required && !from.encrypted()) {
    HttpResponse elsewhere = refusal(307, Refusal::tls_required, "this server is reached by https alone");
    if (!request.host.empty())
      elsewhere.fields.emplace_back("Location", "https://" + request.host + request.path);
    return elsewhere;
  }
  if (request.path == "/status.json" && request.method != HttpMethod::other)
    return status_json(from, request);
  return site_->answer(request, door.is_free(from.address()));
}

void NetHost::answered(const HttpResponse& response, size_t bytes) {
  counts_.web.bytes_sent += bytes;
  if (response.is_file) ++(response.status == 304 ? counts_.web.not_modified : counts_.web.files);
  if (response.refused) counts_.refusals.add(*response.refused);
  update_stats();
}

HttpResponse NetHost::status_json(const HttpConnection& from, const HttpRequest& request) {
  if (const auto may = may_see_status(from, request); !may) {
    HttpResponse no = words(status_of(may.error().reason), std::string(name_of(may.error().reason)));
    if (no.status == 401) no.fields.emplace_back("WWW-Authenticate", "Bearer");
    no.refused = may.error().reason;
    return no;
  }
  update_stats();
  NetFigures figures{stats(), latency(), publisher_.status(), session_rows()};
  std::string json = config_.status ? config_.status(figures) : std::string();
  if (json.empty()) return words(503, "the server is starting");
  return {.fields = {{"Content-Type", "application/json"}, {"Cache-Control", "no-store"}},
          .body = std::make_shared<const std::string>(std::move(json))};
}

/// Where nobody could be an administrator, this machine's own programs may see it; but not who is led here by
/// a name of a page's, or by a proxy.
tl::expected<void, Refused> NetHost::may_see_status(const HttpConnection& from, const HttpRequest& request) {
  const bool nobody_can = config_.admin_token.empty() && !access_->takes_tokens();
  const bool from_here = entrance_.door().is_free(from.address()) && !request.relayed;
  if (nobody_can && from_here && is_own_host(request.host)) return {};
  if (nobody_can) return refuse(Refusal::no_admin_token, "");
  const auto token = bearer_token(request.authorization);
  if (!token) return refuse(Refusal::token_missing, "");
  if (!is_access_token(*token) && config_.admin_token.empty()) return refuse(Refusal::token_malformed, "");
  if (!is_access_token(*token)) return check_admin_token(from.address(), *token);
  const auto grant = access_->grant(*token, unix_now_s());
  TRY(grant);
  if (!may_act_as(grant->role, Role::admin)) return refuse(Refusal::role, "");
  return {};
}

void NetHost::opened_websocket(HttpConnection& from, std::shared_ptr<Transport> stream,
                               std::span<const uint8_t> arrived) {
  ++counts_.web.websockets;
  http_.erase(from.id());
  begin_session(std::make_shared<WebSocketTransport>(std::move(stream), frame_bytes_max, arrived),
                from.address(), from.id(), from.relayed());
  update_stats();
}

void NetHost::cut_off(const HttpConnection& connection, Refusal reason) {
  counts_.refusals.add(reason);
  say(spdlog::level::warn, name_of(reason),
      fmt::format("connection {}: cut off ({}): it speaks HTTP", connection.id(), name_of(reason)));
}

void NetHost::ended(HttpConnection& connection) {
  entrance_.door().leave(connection.address(), steady_now_s());
  http_.erase(connection.id());
  update_stats();
}

void NetHost::check_http(double now_s) {
  const auto http = http_;  // who is closed is erased
  for (const auto& [id, connection] : http) connection->check_time(now_s);
}

}  // namespace scree
