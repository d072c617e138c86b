#include "shared/base/quantile.h"

#include <algorithm>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

double quantile(std::vector<double> samples, double share) {
  CHECK(share >= 0.0 && share <= 1.0);
  if (samples.empty()) return 0.0;
  const double rank = std::ceil(share * static_cast<double>(samples.size()));
  const auto nth = samples.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::ranges::nth_element(samples, nth);
  return *nth;
}

}  // namespace scree
