// A quantile of samples.
#pragma once

#include <vector>

namespace scree {

/// The smallest sample below or at which the given share (0 … 1) of all samples lies (nearest rank); 0 when
/// there are none.
double quantile(std::vector<double> samples, double share);

}  // namespace scree
