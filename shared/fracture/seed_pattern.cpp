#include "shared/fracture/seed_pattern.h"

namespace scree {

Result<void> validate_carve_pattern(SeedPattern pattern) {
  return validate_kind(pattern, "seed pattern");
}

Result<void> validate_shatter_pattern(SeedPattern pattern) {
  TRY(validate_kind(pattern, "seed pattern"));
  if (is_drawn(pattern)) return {};
  return fail("a piece that breaks has no points for the seed pattern " + std::string(name_of(pattern)));
}

}  // namespace scree
