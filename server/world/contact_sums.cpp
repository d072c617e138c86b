#include "server/world/contact_sums.h"

#include <algorithm>

namespace scree {

void ContactSums::add(const ContactEvent& part, bool goes_on) {
  Sum& sum = sums_[{part.body, part.other}];
  const float energy_j = sum.event.energy_j + part.energy_j;
  const float impulse_n_s = sum.event.impulse_n_s + part.impulse_n_s;
  if (sum.ticks == 0 || part.energy_j > sum.hardest_j) {
    sum.event = part;
    sum.hardest_j = part.energy_j;
  }
  sum.event.energy_j = energy_j;
  sum.event.impulse_n_s = impulse_n_s;
  ++sum.ticks;
  sum.is_over = !goes_on;
}

std::vector<ContactEvent> ContactSums::take_ended(uint32_t ticks_max) {
  std::vector<ContactEvent> ended;
  for (auto at = sums_.begin(); at != sums_.end();) {
    Sum& sum = at->second;
    if (sum.is_over || sum.ticks >= ticks_max) {
      ended.push_back(sum.event);
      at = sums_.erase(at);
    } else {
      sum.is_over = true;
      ++at;
    }
  }
  return ended;
}

}  // namespace scree
