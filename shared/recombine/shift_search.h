// The search for the shift with which a merge meets its mass.
#pragma once

#include <algorithm>

#include "shared/base/check.h"
#include "shared/recombine/stamp_plan.h"

namespace scree {

/// The largest shift found within low … high whose gain stays within the budget; `low` when there is none.
/// `gain_of(shift)` should grow with the shift. False position (Illinois), as gains are nearly linear in
/// small steps; every fourth step bisects, as they also jump. At most 18 calls of gain_of.
template <typename Gain>
StampPlan search_shift(int low, int high, MassUnits budget, Gain&& gain_of) {
  constexpr int evaluations_max = 16;
  CHECK(low < high);
  const StampPlan most{high, gain_of(high)};
  if (most.gain <= budget) return most;
  StampPlan best{low, gain_of(low)};
  if (best.gain >= budget) return best;
  auto under = static_cast<double>(best.gain - budget), over = static_cast<double>(most.gain - budget);
  int side = 0;
  for (int i = 0; i < evaluations_max && high - low > 1 && best.gain < budget; ++i) {
    const int guess = low + static_cast<int>(under / (under - over) * (high - low));
    const int middle = std::clamp(i % 4 == 3 ? (low + high) / 2 : guess, low + 1, high - 1);
    const MassUnits gain = gain_of(middle);
    const int now = gain <= budget ? -1 : 1;
    if (now < 0) {
      best = {middle, gain};
      low = middle;
      under = static_cast<double>(gain - budget);
      if (side == now) over *= 0.5;
    } else {
      high = middle;
      over = static_cast<double>(gain - budget);
      if (side == now) under *= 0.5;
    }
    side = now;
  }
  CHECK(best.gain <= budget);
  return best;
}

}  // namespace scree
