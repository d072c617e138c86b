// Sessions that may go on by another connection, and the secrets by which they do. A ticket is for one use
// and gives no right: who comes with it is looked at as anybody is. Times are seconds of steady_now_s(). Not
// thread-safe.
//
// Invariant: of sessions whose connection has ended, at most limits::departed_max are known. Above: of those
// of the address or network that has the most (Crowd), those that were there for the shortest time are
// forgotten, so that nobody voids another's ticket by coming and going.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "server/doors/access.h"
#include "server/doors/crowd.h"
#include "shared/base/rate_limit.h"

namespace scree {

/// A session without a connection.
struct Departed {
  uint64_t session = 0;
  Grant grant;
  std::string ip;  ///< from which it was connected
  Origin origin;
  RateLimit requests;
  double joined_s = 0.0;
  uint64_t party = 0;  ///< Parties
  double departed_s = 0.0;
  bool reserves_place = false;  ///< in a full server, for limits::place_kept_seconds_max
};

class Tickets {
 public:
  /// `over` is told of each session that had a ticket and cannot go on any more.
  explicit Tickets(std::function<void(uint64_t session)> over = [](uint64_t) {}) : over_(std::move(over)) {}

  /// A ticket for the session; the one before does not hold any more.
  std::string issue(uint64_t session);
  /// The session of a ticket that holds.
  std::optional<uint64_t> session_of(const std::string& ticket) const;
  /// The session's ticket does not hold any more.
  void forget(uint64_t session);

  /// The connection of a session that has a ticket has ended.
  void depart(Departed departed);
  /// Null while the session is connected, or not known.
  const Departed* departed(uint64_t session) const;
  /// Forgets those that are older than limits::ticket_seconds_max.
  void expire(double now_s);
  /// Forgets departed sessions of which it is true.
  void forget_departed(const std::function<bool(const Departed&)>& unwanted);
  size_t reserved_places(double now_s) const;

 private:
  void erase_departed(uint64_t session);

  std::function<void(uint64_t session)> over_;
  std::map<uint64_t, std::string> secrets_;  ///< by session
  std::map<uint64_t, Departed> departed_;    ///< likewise, those of them without a connection
  Crowd crowd_;                              ///< of these
};

/// Whether the departed session's place is still kept.
bool has_place(const Departed& departed, double now_s);

}  // namespace scree
