#include "server/web/site.h"

#include <algorithm>
#include <array>
#include <climits>
#include <unistd.h>

#include "crypto/websocket_accept.h"

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

/// Without the port that its scheme means anyhow.
std::string_view without_default_port(std::string_view host, std::string_view scheme) {
  const std::string_view port = scheme == "https" ? ":443" : ":80";
  return host.ends_with(port) ? host.substr(0, host.size() - port.size()) : host;
}

bool is_same(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

/// A proxy in between may speak TLS for the server, so that schemes differ.
bool is_of_host(std::string_view origin, std::string_view host) {
  const size_t end = origin.find("://");
  if (end == origin.npos || host.empty()) return false;
  const std::string_view scheme = origin.substr(0, end);
  if (scheme != "http" && scheme != "https") return false;
  return is_same(without_default_port(origin.substr(end + 3), scheme), without_default_port(host, scheme));
}

bool has_etag(std::string_view listed, std::string_view etag) {
  return listed == "*" || listed.find(etag) != listed.npos;
}

HttpResponse without_page() {
  return words(404,
               "This is a Scree server without its page. Build the page with ./scree web, or name the folder "
               "where it lies (--web DIR). The viewers reach the server on this port, too.");
}

}  // namespace

bool is_origin(std::string_view text) {
  for (const std::string_view scheme : {"http", "https"}) {
    const std::string start = std::string(scheme) + "://";
    if (!text.starts_with(start)) continue;
    const std::string_view host = text.substr(start.size());
    return !host.empty() && host.find_first_of("/?#@ *") == host.npos &&
           without_default_port(host, scheme).size() == host.size();
  }
  return false;
}

bool is_own_host(std::string_view host) {
  if (host.starts_with('[')) return host.find(']') != host.npos;  // IPv6
  host = host.substr(0, host.find(':'));
  if (is_same(host, "localhost")) return true;
  std::array<char, HOST_NAME_MAX + 1> own{};
  if (gethostname(own.data(), own.size() - 1) == 0 && is_same(host, own.data())) return true;
  const auto numeric = [](char c) { return c == '.' || (c >= '0' && c <= '9'); };
  return !host.empty() && std::ranges::all_of(host, numeric);
}

HttpResponse Site::answer(const HttpRequest& request, bool from_here) const {
  if (request.path == "/session") return open_websocket(request, from_here);
  if (request.method == HttpMethod::other) {
    HttpResponse no = words(405, "this server answers GET and HEAD");
    no.fields.emplace_back("Allow", "GET, HEAD");
    return no;
  }
  if (request.path == "/healthz") return words(200, "ok");
  return file(request);
}

HttpResponse Site::file(const HttpRequest& request) const {
  const WebFile* const found = files_->find(request.path);
  if (found == nullptr && !files_->has_page() && (request.path == "/" || request.path == "/status"))
    return without_page();
  if (found == nullptr) return words(404, "there is no such file");
  const bool gzip = request.accepts_gzip && found->gzip != nullptr;
  HttpResponse response;
  response.is_file = true;
  response.fields = {{"Content-Type", found->type},
                     {"ETag", found->etag},
                     {"Cache-Control", found->immutable ? "public, max-age=31536000, immutable" : "no-cache"},
                     {"Vary", "Accept-Encoding"}};
  if (has_etag(request.if_none_match, found->etag)) {
    response.status = 304;
    return response;
  }
  if (gzip) response.fields.emplace_back("Content-Encoding", "gzip");
  response.body = gzip ? found->gzip : found->bytes;
  return response;
}

bool Site::may_join(const HttpRequest& request, bool from_here) const {
  if (!request.origin) return true;  // no browser
  const auto is_named = [&](const std::string& origin) { return is_same(origin, *request.origin); };
  if (std::ranges::any_of(origins_, is_named)) return true;
  return is_of_host(*request.origin, request.host) && (!from_here || is_own_host(request.host));
}

HttpResponse Site::open_websocket(const HttpRequest& request, bool from_here) const {
  if (request.method != HttpMethod::get)
    return refusal(405, Refusal::http_malformed, "a WebSocket is opened by GET");
  if (!request.wants_websocket || request.websocket_version != websocket_version) {
    HttpResponse no =
        refusal(426, Refusal::http_malformed, "this path accepts only a WebSocket of version 13 (RFC 6455)");
    no.fields.emplace_back("Upgrade", "websocket");
    no.fields.emplace_back("Sec-WebSocket-Version", websocket_version);
    return no;
  }
  if (!is_websocket_key(request.websocket_key))
    return refusal(400, Refusal::http_malformed, "Sec-WebSocket-Key must be sixteen bytes in base64");
  if (!may_join(request, from_here))
    return refusal(403, Refusal::origin_foreign, "pages of this site may not join here (--web-origin)");
  return {.status = 101,
          .fields = {{"Upgrade", "websocket"},
                     {"Connection", "Upgrade"},
                     {"Sec-WebSocket-Accept", websocket_accept(request.websocket_key)}}};
}

}  // namespace scree
