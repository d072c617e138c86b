// Requests that wait for a tick with room for them. Each client has a queue of its own; the clients are
// served by start-time fair queueing (Goyal, Vin, Cheng 1996): next is the one that has been charged least,
// where a client that asks after a pause starts level with the others. So a client that asks for much waits
// for itself alone. Part of the simulation: deterministic, no clock. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "server/work/command.h"
#include "shared/base/ids.h"
#include "shared/base/result.h"

namespace scree {

/// A request with its estimated cost and the tick of its arrival.
struct WaitingRequest {
  Command command;
  float cost_us = 0.0F;
  Tick since = 0;
};

class RequestQueue {
 public:
  /// `client_us_per_s`: estimated work that all clients together get a second.
  explicit RequestQueue(float client_us_per_s);

  /// Refuses, by name, what would make a client wait too long or take the others' places
  /// (limits::waiting_work_max_s, requests_waiting_max).
  Result<void> push(WaitingRequest request);
  /// The next request by the clients' turns, valid until another call; null when none waits, or all that wait
  /// belong to clients that were passed over.
  const WaitingRequest* next() const;
  /// Removes the next request and charges its client.
  void pop(float charged_us);
  /// Leaves the next request's client out until the next begin_tick().
  void pass_over();
  void begin_tick();

  /// Number of requests that wait.
  size_t size() const { return size_; }
  /// Whether another client than this has requests waiting.
  bool others_wait(uint64_t session) const;

 private:
  struct Client {
    std::deque<WaitingRequest> requests;
    float waiting_us = 0.0F;
    uint64_t charged_ns = 0;  ///< start tag of its next request
  };
  using Turn = std::pair<uint64_t, uint64_t>;  ///< charged_ns, session

  void forget_the_idle();

  float client_us_per_s_;
  std::map<uint64_t, Client> clients_;  ///< by session: those with requests, or ahead of the others
  std::set<Turn> turns_;                ///< of the clients with requests that were not passed over
  std::set<Turn> passed_over_;
  uint64_t served_ns_ = 0;  ///< start tag of the request that was served last
  size_t size_ = 0;
};

}  // namespace scree
