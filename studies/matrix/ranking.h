// Ranks of combinations by several criteria at once, of each of which less is better.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace scree {

struct Criterion {
  std::string_view name;   ///< in files: "frame_ms"
  std::string_view title;  ///< in tables, with its unit
};

inline constexpr std::array matrix_criteria{
    Criterion{"frame_ms", "frame, ms"},
    Criterion{"tick_ms", "tick, ms"},
    Criterion{"memory_mib", "memory, MiB"},
    Criterion{"mass_error_percent", "mass error, %"},
    Criterion{"fidelity_error_voxels", "surface error, voxels"},
};

/// A combination's values, in the order of the criteria.
using MatrixScore = std::array<double, matrix_criteria.size()>;

/// For each criterion, the share of all others that are better, 0 (none) to 1: equal values have equal ranks.
std::vector<MatrixScore> ranks_of(const std::vector<MatrixScore>& scores);

/// Those than which none is as good in every criterion and better in one, in ascending order.
std::vector<size_t> pareto_front(const std::vector<MatrixScore>& scores);

/// The member of the front whose worst rank is the least; among several, that with the least sum of ranks,
/// and then the first. `scores` must not be empty.
size_t balanced_choice(const std::vector<MatrixScore>& scores);

/// The least in one criterion; of several, that which is least in the sum of its ranks.
size_t best_by(const std::vector<MatrixScore>& scores, size_t criterion);

}  // namespace scree
