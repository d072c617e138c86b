// The head of an HTTP request, as far as the server looks at it. Heads are never trusted.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "shared/base/result.h"

namespace scree {

enum class HttpMethod { get, head, other };

/// Fields that are not there are empty.
struct HttpRequest {
  HttpMethod method = HttpMethod::get;
  std::string path;   ///< of the target, as it came, up to '?': nothing is decoded
  std::string query;  ///< of the target, behind '?'
  std::string host;
  std::optional<std::string> origin;
  std::string authorization;
  std::string if_none_match;
  bool accepts_gzip = false;
  /// A proxy passed it on, as far as that shows: fields that proxies add, or HTTP/1.0, which is left to them.
  bool relayed = false;
  std::string forwarded_for;        ///< X-Forwarded-For, all of them in their order
  std::string forwarded_host{};     ///< X-Forwarded-Host, the first: the name that the browser used
  bool old_version = false;         ///< HTTP/1.0
  bool names_upgrade = false;       ///< Upgrade has "websocket"
  bool connection_upgrade = false;  ///< Connection has "upgrade"
  bool keep_alive = true;           ///< the client wants to ask again on this connection
  bool wants_websocket = false;     ///< Connection and Upgrade say so
  std::string websocket_key;        ///< Sec-WebSocket-Key
  std::string websocket_version{};  ///< Sec-WebSocket-Version
};

/// `head` ends with the empty line. Refused are heads that break RFC 9112, those of requests with a body, of
/// other versions than 1.0 and 1.1, and without exactly one Host in 1.1.
Result<HttpRequest> parse_http_head(std::string_view head);

}  // namespace scree
