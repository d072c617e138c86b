#include "server/work/fair_turns.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Newcomers start later by this part of the others' pace at least: or those that never were here before
/// could keep a dear request waiting for ever.
constexpr uint64_t part_of_pace = 4;

}  // namespace

FairTurns::Turn FairTurns::turn_of(uint64_t who) const {
  const Share& share = shares_.at(who);
  return {share.start_ns + share.cost_ns, who};
}

void FairTurns::wait(uint64_t who, uint64_t cost_ns) {
  Share& share = shares_[who];
  CHECK_DEBUG(!turns_.contains(turn_of(who)) && !passed_over_.contains(turn_of(who)));
  share = {std::max(share.start_ns, served_ns_), cost_ns};
  turns_.insert(turn_of(who));
}

void FairTurns::expect(uint64_t who, uint64_t cost_ns) {
  const Turn before = turn_of(who);
  std::set<Turn>& among = turns_.contains(before) ? turns_ : passed_over_;
  CHECK(among.erase(before) == 1);
  shares_.at(who).cost_ns = cost_ns;
  among.insert(turn_of(who));
}

uint64_t FairTurns::next() const {
  CHECK(!turns_.empty());
  return turns_.begin()->second;
}

void FairTurns::charge(uint64_t charged_ns, Then then) {
  CHECK(!turns_.empty());
  const uint64_t who = next();
  served_ns_ += charged_ns / (part_of_pace * waiting());
  turns_.erase(turns_.begin());
  shares_.at(who).start_ns += charged_ns;
  if (then == Then::waits) turns_.insert(turn_of(who));
  if (then == Then::is_passed_over) passed_over_.insert(turn_of(who));
}

void FairTurns::leave(uint64_t who) {
  CHECK(turns_.erase(turn_of(who)) == 1);
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
  CHECK(passed_over_.empty());
  const bool nobody = turns_.empty();
  if (nobody) {
    for (const auto& [who, share] : shares_) served_ns_ = std::max(served_ns_, share.start_ns);
  } else {
    uint64_t least_ns = UINT64_MAX;
    for (const auto& [finish_ns, who] : turns_) least_ns = std::min(least_ns, shares_.at(who).start_ns);
    served_ns_ = std::max(served_ns_, least_ns);
  }
  std::erase_if(shares_, [&](const auto& entry) {
    const auto& [who, share] = entry;
    const Turn turn{share.start_ns + share.cost_ns, who};
    return nobody || (share.start_ns <= served_ns_ && !turns_.contains(turn));
  });
}

TurnsValue FairTurns::value() const {
  TurnsValue value{{}, served_ns_};
  for (const auto& [who, share] : shares_) {
    const Turn turn = turn_of(who);
    value.turns.push_back({who, share.start_ns, turns_.contains(turn) || passed_over_.contains(turn)});
  }
  return value;
}

void FairTurns::restore(const TurnsValue& value, const std::function<uint64_t(uint64_t who)>& cost_of) {
  *this = FairTurns();
  served_ns_ = value.served_ns;
  for (const TurnsValue::Turn& turn : value.turns) {
    shares_[turn.who] = {turn.start_ns, turn.waits ? cost_of(turn.who) : 0};
    if (turn.waits) turns_.insert(turn_of(turn.who));
  }
}

}  // namespace scree
