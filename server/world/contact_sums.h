// Blows between bodies that go on for several ticks: a rock that falls on a light crate pushes it on, tick by
// tick, before it stops. Their parts are summed, so that one event has the whole energy. No state of a world
// depends on them: a world that is restored or renewed begins without.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "proto/messages.h"
#include "server/bodies/bodies.h"

namespace scree {

class ContactSums {
 public:
  /// Adds a tick's part of a blow. `goes_on`: the two still near each other. Each pair at most once a tick.
  void add(const ContactEvent& part, bool goes_on);
  /// Ends a tick: the blows that are over, or that have gone on for `ticks_max` ticks, ordered by pair. Each
  /// has the place and the direction of its hardest part, and the sums of energy and impulse.
  std::vector<ContactEvent> take_ended(uint32_t ticks_max);
  void clear() { sums_.clear(); }

 private:
  struct Sum {
    ContactEvent event;
    float hardest_j = 0.0F;
    uint32_t ticks = 0;
    bool is_over = true;  ///< unless this tick's part goes on
  };
  std::map<std::pair<PieceId, PieceId>, Sum> sums_;
};

}  // namespace scree
