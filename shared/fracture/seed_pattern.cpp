#include "shared/fracture/seed_pattern.h"

namespace scree {

SeedPattern pattern_of(BreakLook look, GrainAxis axis) {
  const auto along = [axis](SeedPattern first) {
    return static_cast<SeedPattern>(static_cast<uint8_t>(first) + static_cast<uint8_t>(axis));
  };
  switch (look) {
    case BreakLook::even:
      return SeedPattern::natural;
    case BreakLook::grain:
      return along(SeedPattern::grain_x);
    case BreakLook::slabs:
      return along(SeedPattern::slabs_x);
    case BreakLook::shards:
      return SeedPattern::shards;
  }
  CHECK(is_known(look));
  return plain_pattern;
}

Result<void> validate_carve_pattern(SeedPattern pattern) {
  return validate_kind(pattern, "seed pattern");
}

Result<void> validate_shatter_pattern(SeedPattern pattern) {
  TRY(validate_kind(pattern, "seed pattern"));
  if (is_drawn(pattern)) return {};
  return fail("a piece that breaks has no points for the seed pattern " + std::string(name_of(pattern)));
}

}  // namespace scree
