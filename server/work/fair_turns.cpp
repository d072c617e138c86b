#include "server/work/fair_turns.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

void FairTurns::wait(uint64_t who) {
  uint64_t& start_ns = charged_ns_[who];
  CHECK_DEBUG(!turns_.contains({start_ns, who}) && !passed_over_.contains({start_ns, who}));
  start_ns = std::max(start_ns, served_ns_);
  turns_.insert({start_ns, who});
}

uint64_t FairTurns::next() const {
  CHECK(!turns_.empty());
  return turns_.begin()->second;
}

void FairTurns::charge(uint64_t charged_ns, Then then) {
  CHECK(!turns_.empty());
  const auto [start_ns, who] = *turns_.begin();
  turns_.erase(turns_.begin());
  served_ns_ = std::max(served_ns_, start_ns);
  charged_ns_[who] = start_ns + charged_ns;
  if (then == Then::waits) turns_.insert({start_ns + charged_ns, who});
  if (then == Then::is_passed_over) passed_over_.insert({start_ns + charged_ns, who});
}

void FairTurns::leave(uint64_t who) {
  CHECK(turns_.erase({charged_ns_.at(who), who}) == 1);
}

void FairTurns::pass_over() {
  CHECK(!turns_.empty());
  passed_over_.insert(*turns_.begin());
  turns_.erase(turns_.begin());
}

void FairTurns::bring_back() {
  turns_.merge(passed_over_);
  CHECK(passed_over_.empty());
}

void FairTurns::forget_the_idle() {
  const bool nobody = waiting() == 0;
  if (nobody)
    for (const auto& [who, charged_ns] : charged_ns_) served_ns_ = std::max(served_ns_, charged_ns);
  std::erase_if(charged_ns_, [&](const auto& entry) {
    const Turn turn{entry.second, entry.first};
    return nobody || (entry.second <= served_ns_ && !turns_.contains(turn) && !passed_over_.contains(turn));
  });
}

TurnsValue FairTurns::value() const {
  TurnsValue value{{}, served_ns_};
  for (const auto& [who, start_ns] : charged_ns_) {
    const Turn turn{start_ns, who};
    value.turns.push_back({who, start_ns, turns_.contains(turn) || passed_over_.contains(turn)});
  }
  return value;
}

void FairTurns::restore(const TurnsValue& value) {
  *this = FairTurns();
  served_ns_ = value.served_ns;
  for (const TurnsValue::Turn& turn : value.turns) {
    charged_ns_[turn.who] = turn.start_ns;
    if (turn.waits) turns_.insert({turn.start_ns, turn.who});
  }
}

}  // namespace scree
