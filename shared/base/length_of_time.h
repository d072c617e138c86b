// Lengths of time as people write them: "90s", "10m", "2h", "1d".
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// Seconds of a whole number with a unit. The error says how to write one, and the bounds, which are whole.
Result<double> seconds_of(const std::string& text, double least_s, double most_s);
/// Whole seconds in the largest unit that shows them all.
std::string length_text(double seconds);

}  // namespace scree
