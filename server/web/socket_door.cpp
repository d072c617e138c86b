#include "server/web/socket_door.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "crypto/sha256.h"
#include "crypto/signing_key.h"
#include "crypto/websocket_accept.h"
#include "server/web/limits.h"
#include "shared/base/text.h"

namespace scree {

namespace {

constexpr std::string_view websocket_version = "13";

/// Sixteen bytes in base64 (RFC 6455, 4.1).
bool is_websocket_key(std::string_view key) {
  constexpr size_t key_letters = 24;
  const auto is_base64 = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
  };
  return key.size() == key_letters && key.ends_with("==") &&
         std::ranges::all_of(key.substr(0, key_letters - 2), is_base64);
}

/// The value of a name in "attempt=…&pass=…", if it is of hexadecimal digits; else empty.
std::string_view digits_of(std::string_view query, std::string_view name) {
  while (!query.empty()) {
    const size_t end = std::min(query.find('&'), query.size());
    const std::string_view part = query.substr(0, end);
    query = query.substr(std::min(end + 1, query.size()));
    if (!part.starts_with(name) || part.substr(name.size(), 1) != "=") continue;
    const std::string_view value = part.substr(name.size() + 1);
    const bool fits =
        value.size() == limits::socket_digits && value.find_first_not_of("0123456789abcdef") == value.npos;
    return fits ? value : std::string_view();
  }
  return {};
}

/// A handshake that arrived without what makes it one: a browser sent all of it.
std::string lost_on_the_way(const HttpRequest& request) {
  std::string lines;
  if (request.old_version) lines += " proxy_http_version 1.1;";
  if (!request.names_upgrade) lines += " proxy_set_header Upgrade $http_upgrade;";
  if (!request.connection_upgrade) lines += " proxy_set_header Connection \"upgrade\";";
  return "A proxy between this page and the server does not pass on the upgrade to a WebSocket. In nginx, "
         "these "
         "lines are missing beside proxy_pass:" +
         lines + " The page docs/host.md has whole configurations.";
}

/// The origin as text that may be shown: a field may have any bytes, and JSON has none that are no UTF-8.
std::string foreign_to_here(const HttpRequest& request, const WebPeer& peer) {
  const std::string origin = showable(request.origin.value_or(""), limits::origin_bytes_max);
  if (!peer.from_here) return "pages of " + origin + " may not join here (--web-origin)";
  return "The page is of " + origin +
         ", and the server does not know that name as its own. A proxy on its machine has to pass on name "
         "and "
         "address. In nginx, these lines are missing beside proxy_pass: proxy_set_header Host $http_host; "
         "proxy_set_header X-Forwarded-For $proxy_add_x_forwarded_for; Or start the server with "
         "--web-origin " +
         origin;
}

}  // namespace

SocketDoor::SocketDoor(WebNames names) : names_(std::move(names)) {
  for (int i = 0; i < 4; ++i) secret_ += std::to_string(random_number()) + " ";
}

std::string SocketDoor::pass_for(const std::string& address) const {
  const std::string text = secret_ + address;
  const Digest digest = sha256(std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
  return hex_of(digest).substr(0, limits::socket_digits);
}

bool SocketDoor::may_join(const HttpRequest& request, const WebPeer& peer) const {
  if (!request.origin) return true;  // no browser
  const std::string& origin = *request.origin;
  if (names_.is_named_site(origin)) return true;
  const bool any_name_does = peer.vouched && !names_.names_hosts();
  if (!any_name_does && !names_.knows_site(origin)) return false;
  return is_of_host(origin, request.host) || (peer.vouched && is_of_host(origin, request.forwarded_host)) ||
         digits_of(request.query, "pass") == pass_for(peer.address);
}

void SocketDoor::note(const HttpRequest& request, const std::string& words, bool foreign) {
  const std::string_view name = digits_of(request.query, "attempt");
  if (name.empty()) return;
  attempts_.push_back({std::string(name), words, foreign});
  if (attempts_.size() > limits::socket_attempts_max) attempts_.pop_front();
}

HttpResponse SocketDoor::open(const HttpRequest& request, const WebPeer& peer) {
  const auto refused = [&](int status, Refusal reason, const std::string& words) {
    note(request, words, reason == Refusal::origin_foreign);
    return refusal(status, reason, words);
  };
  if (request.method != HttpMethod::get)
    return refused(405, Refusal::http_malformed, "a WebSocket is opened by GET");
  if (!request.wants_websocket || request.websocket_version != websocket_version) {
    const bool lost = !request.wants_websocket && !request.websocket_key.empty();
    HttpResponse no = refused(
        426, Refusal::http_malformed,
        lost ? lost_on_the_way(request) : "this path accepts only a WebSocket of version 13 (RFC 6455)");
    no.fields.emplace_back("Upgrade", "websocket");
    no.fields.emplace_back("Sec-WebSocket-Version", websocket_version);
    return no;
  }
  if (!is_websocket_key(request.websocket_key))
    return refused(400, Refusal::http_malformed, "Sec-WebSocket-Key must be sixteen bytes in base64");
  if (!may_join(request, peer)) return refused(403, Refusal::origin_foreign, foreign_to_here(request, peer));
  return {.status = 101,
          .fields = {{"Upgrade", "websocket"},
                     {"Connection", "Upgrade"},
                     {"Sec-WebSocket-Accept", websocket_accept(request.websocket_key)}}};
}

HttpResponse SocketDoor::tell(const HttpRequest& request, const WebPeer& peer) const {
  const std::string_view name = digits_of(request.query, "attempt");
  const auto found = std::find_if(attempts_.rbegin(), attempts_.rend(),
                                  [&](const Attempt& attempt) { return attempt.name == name; });
  const bool seen = found != attempts_.rend();
  nlohmann::ordered_json json{{"seen", seen}};
  if (seen) json["words"] = found->words;
  if (seen && found->foreign) json["pass"] = pass_for(peer.address);
  return {.fields = {{"Content-Type", "application/json"}, {"Cache-Control", "no-store"}},
          .body = std::make_shared<const std::string>(json.dump() + "\n")};
}

}  // namespace scree
