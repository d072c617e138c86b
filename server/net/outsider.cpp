#include "server/net/outsider.h"

#include <algorithm>
#include <functional>
#include <tuple>

#include "server/net/limits.h"
#include "shared/base/check.h"

namespace scree {

const Outsider& who_leaves(std::span<const Outsider> outsiders) {
  CHECK(!outsiders.empty());
  Crowd crowd;
  size_t silent = 0, begun = 0;
  for (const Outsider& outsider : outsiders) {
    crowd.add(outsider.origin);
    if (!outsider.is_done) ++(outsider.is_silent ? silent : begun);
  }
  const bool silent_leave = silent >= begun;
  const auto rank = [&crowd, silent_leave](const Outsider& outsider) {
    const size_t weight = crowd.weight(outsider.origin);
    return std::tuple(weight > limits::outsiders_of_an_address ? weight : 0, outsider.is_done,
                      outsider.is_silent == silent_leave, ~outsider.id);
  };
  return *std::ranges::max_element(outsiders, std::ranges::less{}, rank);
}

}  // namespace scree
