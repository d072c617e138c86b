#include "server/publish/session_turns.h"

#include "shared/base/check.h"

namespace scree {

namespace {

/// What a turn costs is known when it is over; before, all cost the same.
constexpr uint64_t unknown_cost = 1;

}  // namespace

void SessionTurns::wait(uint64_t session, uint64_t party) {
  if (!party_of_.emplace(session, party).second) return;
  FairTurns& among = sessions_[party];
  if (among.waiting() == 0) parties_.wait(party, unknown_cost);
  among.wait(session, unknown_cost);
}

void SessionTurns::leave(uint64_t session) {
  const auto found = party_of_.find(session);
  if (found == party_of_.end()) return;
  FairTurns& among = sessions_.at(found->second);
  among.leave(session);
  if (among.waiting() == 0) parties_.leave(found->second);
  party_of_.erase(found);
}

void SessionTurns::begin() {
  parties_.forget_the_idle();
  std::erase_if(sessions_, [](const auto& entry) { return entry.second.waiting() == 0; });
  for (auto& [party, among] : sessions_) among.forget_the_idle();
}

void SessionTurns::charge(uint64_t cost, FairTurns::Then then) {
  CHECK(!empty());
  FairTurns& among = sessions_.at(parties_.next());
  if (then == FairTurns::Then::leaves) party_of_.erase(among.next());
  among.charge(cost, then);
  parties_.charge(cost, !among.empty()         ? FairTurns::Then::waits
                        : among.waiting() != 0 ? FairTurns::Then::is_passed_over
                                               : FairTurns::Then::leaves);
}

void SessionTurns::end() {
  parties_.bring_back();
  for (auto& [party, among] : sessions_) among.bring_back();
}

}  // namespace scree
