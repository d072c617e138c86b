// The largest load that holds, found by trying. Pure but for what is tried.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "shared/base/result.h"

namespace scree {

struct MostHeld {
  size_t holds = 0;               ///< the largest that did; 0: none
  std::optional<size_t> fails{};  ///< the smallest that did not; nothing: all that were tried held
};

/// How a search goes: from `start`, a positive number, by steps of `growth` until one fails (or down until
/// one holds), then between the two until they are within a share of each other. A load that fails is tried
/// once more: a machine that did something else for a moment is not at its end. Ends above `most`.
struct HeldSearch {
  size_t start = 1;
  double growth = 1.3;
  double within = 0.06;
  size_t most = 1000;
};

/// An error of `holds` ends the search.
Result<MostHeld> most_held(const HeldSearch& search, const std::function<Result<bool>(size_t load)>& holds);

}  // namespace scree
