// The energy of what moves near persons on foot, before it strikes: who walks into a stone that lies still is
// not struck by it. No state of a world depends on it: a world that is restored or renewed begins without.
#pragma once

#include <map>
#include <utility>

#include "shared/base/ids.h"

namespace scree {

class PersonBlows {
 public:
  /// A body that is near a person's moves with that energy.
  void note(PieceId person, PieceId body, float energy_j, Tick tick) {
    Known& known = known_[{person, body}];
    if (energy_j >= known.energy_j) known = {energy_j, tick};
  }
  /// Joules; 0: it was not near.
  float energy_j(PieceId person, PieceId body) const {
    const auto found = known_.find({person, body});
    return found == known_.end() ? 0.0F : found->second.energy_j;
  }
  /// Forgets what was noted before that tick.
  void forget_before(Tick tick) {
    std::erase_if(known_, [&](const auto& one) { return one.second.tick < tick; });
  }
  void clear() { known_.clear(); }

 private:
  struct Known {
    float energy_j = 0.0F;
    Tick tick = 0;
  };
  std::map<std::pair<PieceId, PieceId>, Known> known_;  ///< by the person's body, and the other
};

}  // namespace scree
