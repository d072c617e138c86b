// A request's way through a server, by stages, and as its client sees it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace scree {

/// The server's part of a request's way.
struct ServerLatency {
  uint32_t waiting_us = 0;  ///< from its arrival at the network thread until the tick that answers it begins
  uint32_t tick_us = 0;     ///< until that tick is published
  uint32_t sending_us = 0;  ///< until the reply is handed to the transport

  double total_ms() const {
    return (static_cast<double>(waiting_us) + static_cast<double>(tick_us) +
            static_cast<double>(sending_us)) /
           1000.0;
  }
  bool operator==(const ServerLatency&) const = default;
};

struct LatencyStageRow {
  std::string_view name;
  uint32_t ServerLatency::*us;
};

/// In the order of the way. Statuses, reports and the HUD iterate over it.
inline constexpr std::array latency_stages{LatencyStageRow{"waiting", &ServerLatency::waiting_us},
                                           LatencyStageRow{"tick", &ServerLatency::tick_us},
                                           LatencyStageRow{"sending", &ServerLatency::sending_us}};

/// The latency of the requests that the ticks of the last second answered.
struct LatencyStatus {
  ServerLatency median;
  ServerLatency worst;

  bool operator==(const LatencyStatus&) const = default;
};

/// From sending a request to receiving its reply.
struct RequestLatency {
  double total_ms = 0.0;
  ServerLatency server{};

  /// What the server does not account for: the network, and both programs' sockets. A server may claim more
  /// than the whole: then nothing is left.
  double network_ms() const { return std::max(0.0, total_ms - server.total_ms()); }
};

}  // namespace scree
