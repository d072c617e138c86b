// Places on an axis of logarithms that have a label. Pure.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace scree {

inline constexpr size_t ticks_least = 3;  ///< with fewer, nobody can read a value between them

/// At least ticks_least round numbers from `lo` to `hi`, which are positive and differ, rising. They are
/// powers of ten; where these are too few, also 2 and 5 times these, or all multiples. In a narrow range they
/// are numbers equally far apart.
std::vector<double> log_ticks(double lo, double hi);

/// The range in which `lo` and `hi`, which are positive, lie, with 1, 2 or 5 times a power of ten at its
/// ends.
std::pair<double, double> round_log_range(double lo, double hi);

}  // namespace scree
