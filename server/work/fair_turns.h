// Whose turn it is, by start-time fair queueing (Goyal, Vin, Cheng 1996): of those who wait, next is the one
// that has been charged least; who waits again after a pause starts level with the others. Deterministic, no
// clock. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "proto/world_value.h"

namespace scree {

class FairTurns {
 public:
  /// Begins to wait; `who` must not wait yet.
  void wait(uint64_t who);
  /// Must not be empty().
  uint64_t next() const;
  /// Whether nobody waits that was not passed over.
  bool empty() const { return turns_.empty(); }
  enum class Then : uint8_t { leaves, waits, is_passed_over };
  /// Charges the next one, which waits for another turn or does not.
  void charge(uint64_t charged_ns, Then then);
  /// One that waits, and was not passed over, does not wait any more; what it was charged stands.
  void leave(uint64_t who);
  /// Leaves the next one out until bring_back().
  void pass_over();
  void bring_back();
  /// Of all that wait, passed over or not.
  size_t waiting() const { return turns_.size() + passed_over_.size(); }
  /// All of it; who was passed over waits as the others do, as he will in the next tick anyway.
  TurnsValue value() const;
  void restore(const TurnsValue& value);
  /// Forgets what those that do not wait were charged, as far as it makes no difference any more.
  void forget_the_idle();

 private:
  using Turn = std::pair<uint64_t, uint64_t>;  ///< start tag, who

  std::map<uint64_t, uint64_t> charged_ns_;  ///< start tags: of those who wait, or are ahead of the others
  std::set<Turn> turns_;
  std::set<Turn> passed_over_;
  uint64_t served_ns_ = 0;  ///< start tag of the one that was served last
};

}  // namespace scree
