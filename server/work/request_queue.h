// Requests that wait for a tick with room for them. Parties take turns (command.h), and within a party its
// sessions do (turn_queue.h): who asks for much waits for himself alone, and by more sessions nobody gets
// more. Part of the simulation: deterministic, no clock. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "server/command/command.h"
#include "server/work/fair_turns.h"
#include "server/work/turn_queue.h"
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
  void expect(float client_us_per_s) { client_us_per_s_ = client_us_per_s; }

  /// Refuses, by name, what would make a session wait too long or take the other parties' places
  /// (limits::waiting_work_max_s, requests_waiting_max).
  Result<void> push(WaitingRequest request);
  /// The next request by the turns, valid until another call; null when none waits, or all that wait belong
  /// to sessions that were passed over.
  const WaitingRequest* next() const;
  /// Removes the next request and charges its session and party.
  void pop(float charged_us);
  /// Leaves the next request's session out until the next begin_tick().
  void pass_over();
  /// Removes all requests of a session, and returns them in order. They cost nothing. Call before
  /// begin_tick(): who was passed over comes back.
  std::vector<Command> drop(uint64_t session);
  void begin_tick();

  /// All that waits, and whose turn it is.
  RequestsValue value() const;
  /// Refuses what no queue holds; then this one is empty. Whether the commands are valid the caller knows.
  Result<void> restore(const RequestsValue& value);

  /// Number of requests that wait.
  size_t size() const { return size_; }
  /// Whether another party than this has requests waiting.
  bool others_wait(uint64_t party) const;

 private:
  using Party = TurnQueue<WaitingRequest>;  ///< its sessions' requests

  /// By name, if no more of this party's requests, or this session's, may wait.
  Result<void> may_wait(const WaitingRequest& request) const;
  bool waits(uint64_t party) const;
  /// Tells the turns what this party's next request costs, if it has one.
  void expect_next(uint64_t id, const Party& party);
  void bring_back();
  Result<void> restore_party(const PartyValue& value);

  float client_us_per_s_;
  std::map<uint64_t, Party> parties_;  ///< those with requests, and until the next tick those that had some
  FairTurns turns_;                    ///< of the parties
  size_t size_ = 0;
};

}  // namespace scree
