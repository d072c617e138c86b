// What an owner says of HTTP, and what it counts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/web/limits.h"

namespace scree {

struct WebConfig {
  bool on = true;                      ///< whether HTTP is spoken at all
  std::string folder{};                ///< of the page's files; empty: there is no page
  std::vector<std::string> origins{};  ///< sites beside the server's own whose pages may join
  /// Names by which people reach the server, beside those of its machine (WebNames).
  std::vector<std::string> hosts{};
  double head_seconds = limits::http_head_seconds_max;
  double idle_seconds = limits::http_idle_seconds_max;
};

/// Counts since the start.
struct WebStats {
  uint32_t connections = 0;  ///< now
  uint64_t requests = 0;
  uint64_t files = 0;         ///< sent, but for those that the browser had
  uint64_t not_modified = 0;  ///< those
  uint64_t bytes_sent = 0;    ///< without WebSockets
  uint64_t websockets = 0;    ///< opened
};

}  // namespace scree
