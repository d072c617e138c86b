// How often a test repeats what repetition makes sure of: less where our checks in hot loops, or a
// sanitizer's, make it ten to thirty times slower.
#pragma once

namespace scree {

/// `all`; `few` in builds with SCREE_CHECK_DEBUG (debug, sanitizers).
template <typename T>
constexpr T rounds([[maybe_unused]] T all, [[maybe_unused]] T few) {
#ifdef SCREE_CHECK_DEBUG
  return few;
#else
  return all;
#endif
}

}  // namespace scree
