// Whose turn it is, by weighted fair queueing (Demers, Keshav, Shenker 1989): next is the one that would have
// been served first if all who wait were served at once, each at the same pace. So a cheap request waits for
// few dear ones, however many ask for those, and nobody gets more than his share. Who waits again after a
// pause starts level with the one that had least (Chen, Minimum Starting-tag Fair Queueing, 1997), so that he
// is next, but has saved nothing. Deterministic, no clock. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "server/formats/world_value.h"

namespace scree {

/// Nanoseconds of microseconds that are not negative: sums of these are exact.
inline uint64_t in_ns(float us) {
  return static_cast<uint64_t>(us * 1000.0F);
}

class FairTurns {
 public:
  /// Begins to wait for a turn that will cost about so much; `who` must not wait yet.
  void wait(uint64_t who, uint64_t cost_ns);
  /// The turn of one that waits, passed over or not, will cost about so much.
  void expect(uint64_t who, uint64_t cost_ns);
  /// Must not be empty().
  uint64_t next() const;
  /// Whether nobody waits that was not passed over.
  bool empty() const { return turns_.empty(); }
  enum class Then : uint8_t { leaves, waits, is_passed_over };
  /// Charges the next one, which waits for another turn, of like cost unless expect() says so, or does not.
  void charge(uint64_t charged_ns, Then then);
  /// One that waits, and was not passed over, does not wait any more; what it was charged stands.
  void leave(uint64_t who);
  /// Leaves the next one out until bring_back().
  void pass_over();
  void bring_back();
  /// How many wait, passed over or not.
  size_t waiting() const { return turns_.size() + passed_over_.size(); }
  /// All of it; who was passed over waits as the others do, as he will in the next tick anyway.
  TurnsValue value() const;
  /// `cost_of`: of the turn of one that waits.
  void restore(const TurnsValue& value, const std::function<uint64_t(uint64_t who)>& cost_of);
  /// Once a tick, when nobody is passed over: newcomers start where the one does that had least. Forgets what
  /// those that do not wait were charged, as far as it makes no difference any more.
  void forget_the_idle();

 private:
  struct Share {
    uint64_t start_ns = 0;  ///< start tag: what it had, at the pace of all, when its turn began to wait
    uint64_t cost_ns = 0;   ///< of that turn
  };
  using Turn = std::pair<uint64_t, uint64_t>;  ///< finish tag, who

  Turn turn_of(uint64_t who) const;

  std::map<uint64_t, Share> shares_;  ///< of those who wait, or are ahead of the others
  std::set<Turn> turns_;
  std::set<Turn> passed_over_;
  uint64_t served_ns_ = 0;  ///< where newcomers start
};

}  // namespace scree
