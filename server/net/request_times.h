// When requests came and how long each stage of their way took, for their replies, the status and the report.
// Stamps stay on the network's side: commands, ticks and recordings have none. Time comes in as an argument,
// seconds of steady_now_s(). Not thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>

#include "server/metrics/durations.h"
#include "shared/base/latency.h"

namespace scree {

/// When a tick took the commands that waited for it, and when it was done.
struct TickSpan {
  double taken_s = 0.0;
  double done_s = 0.0;
};
constexpr TickSpan instant(double now_s) {
  return {now_s, now_s};
}

/// By stage, since the start.
using LatencyCounts = std::array<Durations, latency_stages.size()>;

class RequestTimes {
 public:
  /// A request was handed to the simulation. A client may use a number again: replies go to the oldest.
  /// Above limits::requests_timed_max nothing is noted, and the reply says nothing.
  void received(uint64_t session, uint32_t request, double now_s);
  /// The session has ended.
  void forget(uint64_t session);

  /// The stages of a request that the tick answered, when its reply is handed over now; zeroes for one that
  /// is not known. Each is cut to limits::latency_max_us.
  ServerLatency answered(uint64_t session, uint32_t request, const TickSpan& tick, double now_s);

  /// Over the requests answered since the last call, which is a second ago.
  LatencyStatus drain_status();
  const LatencyCounts& counts() const { return counts_; }

 private:
  struct Waiting {
    uint32_t request;
    double received_s;
  };

  std::map<uint64_t, std::deque<Waiting>> waiting_;  ///< by session; oldest first
  size_t waiting_count_ = 0;
  std::deque<ServerLatency> answered_;  ///< since the last status
  LatencyCounts counts_;
};

}  // namespace scree
