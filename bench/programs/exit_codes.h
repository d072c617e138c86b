// How scree-bench ends.
#pragma once

namespace scree {

inline constexpr int exit_done = 0;
inline constexpr int exit_not_done = 1;  ///< something could not be done: the standard error says why
inline constexpr int exit_usage = 2;
/// A check was missed, where --strict asks for that; or a comparison found something worse, or with --strict
/// something gone.
inline constexpr int exit_worse = 3;

}  // namespace scree
