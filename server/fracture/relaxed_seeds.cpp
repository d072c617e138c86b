#include "server/fracture/relaxed_seeds.h"

#include <algorithm>
#include <array>

#include "server/fracture/even_seeds.h"
#include "shared/base/check.h"

namespace scree {

namespace {

struct RelaxedPattern {
  SeedPattern pattern;
  std::vector<glm::vec3> (*seeds)(const Window& volume, uint32_t count, uint32_t random_seed);
};

constexpr std::array relaxed_patterns{RelaxedPattern{SeedPattern::even, even_seeds}};
static_assert(relaxed_patterns.size() == kinds_that<SeedPattern, is_relaxed>.size(),
              "each relaxed pattern places its own points");

}  // namespace

std::vector<glm::vec3> relaxed_seeds(SeedPattern pattern, const Window& volume, uint32_t count,
                                     uint32_t random_seed) {
  const auto* row = std::ranges::find(relaxed_patterns, pattern, &RelaxedPattern::pattern);
  CHECK(row != relaxed_patterns.end());
  return row->seeds(volume, count, random_seed);
}

}  // namespace scree
