// Whose turn it is among sessions that wait for one kind of work of the network thread. Parties (Parties)
// take turns, and within a party its sessions do (fair_turns.h). So however many sessions a party has, and
// however much they ask for, another party waits for a turn of it alone.
//
// Sessions begin and cease to wait between two rounds; a round is what begin() and end() enclose. No clock.
// Not thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>

#include "server/work/fair_turns.h"

namespace scree {

class SessionTurns {
 public:
  /// Nothing happens if it waits already.
  void wait(uint64_t session, uint64_t party);
  /// Nothing happens if it does not wait. What it was charged stands.
  void leave(uint64_t session);

  void begin();
  /// Whether nobody waits but those who were passed over in this round.
  bool empty() const { return parties_.empty(); }
  /// The session whose turn it is. Must not be empty().
  uint64_t next() const { return sessions_.at(parties_.next()).next(); }
  /// Charges the session whose turn it is, and its party. Costs are in any unit, the same for all.
  void charge(uint64_t cost, FairTurns::Then then);
  /// Leaves that session out for the rest of the round, at no cost.
  void pass_over() { charge(0, FairTurns::Then::is_passed_over); }
  void end();

 private:
  FairTurns parties_;
  std::map<uint64_t, FairTurns> sessions_;  ///< by party
  std::unordered_map<uint64_t, uint64_t> party_of_;
};

}  // namespace scree
