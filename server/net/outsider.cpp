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
  for (const Outsider& outsider : outsiders) crowd.add(outsider.origin);
  const auto rank = [&crowd](const Outsider& outsider) {
    const size_t weight = crowd.weight(outsider.origin);
    return std::tuple(weight > limits::outsiders_of_an_address ? weight : 0, outsider.is_done,
                      outsider.is_silent, ~outsider.id);
  };
  return *std::ranges::max_element(outsiders, std::ranges::less{}, rank);
}

}  // namespace scree
