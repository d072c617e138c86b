#include "server/web/http_request.h"

#include <algorithm>
#include <array>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <charconv>
#include <utility>  // Boost.Beast 1.74 lacks it

#include "server/web/limits.h"

namespace scree {

namespace {

namespace http = boost::beast::http;
using Head = http::request<http::empty_body>;

/// Those that begin with X-Forwarded- beside them.
constexpr std::array proxy_fields = {"Forwarded",      "Via",
                                     "X-Real-IP",      "X-Client-IP",
                                     "CDN-Loop",       "CF-Connecting-IP",
                                     "True-Client-IP", "Fastly-Client-IP",
                                     "X-ProxyUser-Ip", "X-Original-Host"};

std::string text_of(const Head& head, http::field field) {
  const auto value = head[field];
  return {value.data(), value.size()};
}

HttpMethod method_of(const Head& head) {
  if (head.method() == http::verb::get) return HttpMethod::get;
  return head.method() == http::verb::head ? HttpMethod::head : HttpMethod::other;
}

/// "gzip", but not "gzip;q=0" (RFC 9110, 12.5.3).
bool accepts_gzip(const Head& head) {
  for (const auto& [coding, parameters] : http::ext_list(head[http::field::accept_encoding])) {
    if (!boost::beast::iequals(coding, "gzip")) continue;
    for (const auto& [name, value] : parameters)
      if (boost::beast::iequals(name, "q") && value.find_first_not_of("0.") == value.npos) return false;
    return true;
  }
  return false;
}

bool is_relayed(const Head& head) {
  const auto is_there = [&](const char* field) { return head.count(field) > 0; };
  const auto is_forwarding = [](const auto& field) {
    constexpr std::string_view prefix = "X-Forwarded-";
    return boost::beast::iequals(field.name_string().substr(0, prefix.size()), prefix.data());
  };
  return head.version() == 10 || std::ranges::any_of(proxy_fields, is_there) ||
         std::any_of(head.begin(), head.end(), is_forwarding);
}

/// One list: each proxy on the way adds to the field, or adds another one.
std::string list_of(const Head& head, const char* field) {
  std::string list;
  const auto [first, last] = head.equal_range(field);
  for (auto at = first; at != last; ++at) {
    if (!list.empty()) list += ",";
    list.append(at->value().data(), at->value().size());
  }
  return list;
}

/// The first entry of a list, without spaces around it.
std::string first_of(const std::string& list) {
  const size_t from = list.find_first_not_of(" \t");
  if (from == list.npos) return {};
  const std::string entry = list.substr(from, list.find(',') - from);
  return entry.substr(0, entry.find_last_not_of(" \t") + 1);
}

/// NAME or NAME:PORT; an IPv6 address as NAME is in brackets.
bool has_sound_port(std::string_view host) {
  const size_t name_end = host.starts_with('[') ? host.find(']') : 0;
  if (name_end == host.npos) return false;
  const size_t colon = host.find(':', name_end);
  if (colon == host.npos) return true;
  const std::string_view digits = host.substr(colon + 1);
  uint16_t port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  return digits.empty() || (error == std::errc() && end == digits.data() + digits.size());
}

bool has_body(const Head& head) {
  const auto length = head[http::field::content_length];
  return head.count(http::field::transfer_encoding) > 0 || (!length.empty() && length != "0");
}

}  // namespace

Result<HttpRequest> parse_http_head(std::string_view text) {
  http::request_parser<http::empty_body> parser;
  parser.header_limit(limits::http_head_bytes_max);
  boost::beast::error_code error;
  const size_t used = parser.put(boost::asio::const_buffer(text.data(), text.size()), error);
  if (error) return fail("not an HTTP request: " + error.message());
  if (!parser.is_header_done() || used != text.size())
    return fail("not an HTTP request: its head has no end");
  const Head& head = parser.get();
  if (head.version() != 10 && head.version() != 11) return fail("this server speaks HTTP/1.1");
  if (has_body(head)) return fail("a request has a body, which this server does not accept");
  const size_t hosts = head.count(http::field::host);
  if (hosts > 1 || (hosts == 0 && head.version() == 11)) return fail("a request names one host (Host)");
  const std::string target(head.target().data(), head.target().size());
  if (!target.starts_with('/')) return fail("the target must be a path");
  HttpRequest request;
  request.method = method_of(head);
  request.path = target.substr(0, target.find('?'));
  if (request.path.size() < target.size()) request.query = target.substr(request.path.size() + 1);
  request.host = text_of(head, http::field::host);
  if (!has_sound_port(request.host)) return fail("the port in Host is none");
  if (head.count(http::field::origin) > 1) return fail("a request has one origin");
  if (head.count(http::field::origin) > 0) request.origin = text_of(head, http::field::origin);
  request.authorization = text_of(head, http::field::authorization);
  request.if_none_match = text_of(head, http::field::if_none_match);
  request.accepts_gzip = accepts_gzip(head);
  request.relayed = is_relayed(head);
  request.forwarded_for = list_of(head, "X-Forwarded-For");
  request.forwarded_host = first_of(list_of(head, "X-Forwarded-Host"));
  request.old_version = head.version() == 10;
  request.names_upgrade = http::token_list(head[http::field::upgrade]).exists("websocket");
  request.connection_upgrade = http::token_list(head[http::field::connection]).exists("upgrade");
  request.keep_alive = head.keep_alive();
  // HTTP/1.0 knows no upgrade (RFC 9110, 7.8).
  request.wants_websocket = head.version() == 11 && parser.upgrade() && request.names_upgrade;
  request.websocket_key = text_of(head, http::field::sec_websocket_key);
  request.websocket_version = text_of(head, http::field::sec_websocket_version);
  return request;
}

}  // namespace scree
