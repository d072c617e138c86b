#include "studies/scale/most_held.h"

#include <algorithm>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

namespace {

size_t times(size_t load, double factor) {
  const auto product = static_cast<size_t>(std::lround(static_cast<double>(load) * factor));
  return factor > 1.0 ? std::max(load + 1, product) : std::min(load - 1, product);
}

}  // namespace

Result<MostHeld> most_held(const HeldSearch& search, const std::function<Result<bool>(size_t load)>& holds) {
  CHECK(search.start > 0 && search.growth > 1.0);
  MostHeld found;
  size_t load = search.start;
  while (load > found.holds && load <= search.most) {
    Result<bool> held = holds(load);
    if (held && !*held) held = holds(load);
    TRY(held);
    (*held ? found.holds : found.fails.emplace()) = load;
    if (!found.fails) {
      load = times(load, search.growth);
    } else if (found.holds == 0) {
      load = times(load, 1.0 / search.growth);
    } else {
      const auto between = static_cast<double>(*found.fails - found.holds);
      if (between <= std::max(1.0, search.within * static_cast<double>(found.holds))) break;
      load = found.holds + (*found.fails - found.holds) / 2;
    }
  }
  return found;
}

}  // namespace scree
