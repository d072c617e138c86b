// Requests on their way to the world and their answers: limits, the queue of commands, times. Requests beyond
// a session's role or a limit never reach the world. On the network thread.
#pragma once

#include <cstdint>

#include "server/net/command_queue.h"
#include "server/net/departures.h"
#include "server/net/net_server.h"
#include "server/net/request_times.h"
#include "server/net/session_table.h"

namespace scree {

class Requests {
 public:
  /// All arguments must outlive this object. `counts`: requests are counted there.
  Requests(CommandQueue& commands, SessionTable& sessions, NetStats& counts, const NetConfig& config)
      : commands_(commands),
        departures_(commands),
        sessions_(sessions),
        counts_(counts),
        replay_(config.replay),
        is_edge_(config.way_back != nullptr),
        reach_m_(config.service.reach_m),
        sight_(config.service.sight),
        tick_rate_hz_(config.tick_rate_hz) {}

  /// How often, and how far from its eye, a session may ask for edits.
  void grant(const ServiceLimits& service);
  /// Passes a request on if the session's role may ask it, and its eye is near enough; else it is refused. A
  /// person's input has a rate of its own. Whether it is on its way to the world, and gets an answer.
  bool ask(ClientSession& session, uint32_t request, const Request& body);
  /// Whether the request is on its way to the world; else it is refused.
  bool pass(ClientSession& session, const Command& command);
  /// Answers a request that is counted already.
  void refuse(ClientSession& session, uint32_t request, const Refused& refused);

  /// The session has no connection any more: its requests are not timed.
  void forget(uint64_t session) { times_.forget(session); }
  /// The session cannot go on any more: the world is told.
  void gone(uint64_t session) { departures_.gone(session); }
  /// Tells the world of those that it could not be told of at once. Call a few times a second.
  void tell_departures() { departures_.tell(); }

  RequestTimes& times() { return times_; }

 private:
  void pass_input(ClientSession& session, const Command& command);

  CommandQueue& commands_;
  Departures departures_;
  RequestTimes times_;
  SessionTable& sessions_;
  NetStats& counts_;
  const bool replay_;
  const bool is_edge_;
  double reach_m_;
  bool sight_;
  const double tick_rate_hz_;
};

}  // namespace scree
