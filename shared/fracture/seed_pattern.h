// How the seeds of a break lie in the volume that breaks.
#pragma once

#include <cstdint>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

/// uniform: anywhere in the volume. radial: density ∝ 1/d² from the impact, the paper's "spiderweb" (1.2.2).
/// clustered: density ∝ 1/d² from the nearest of a few places in the volume, one for every eight seeds, 64 at
/// most. authored: at the points that come with the request.
enum class SeedPattern : uint8_t { uniform = 0, radial = 1, clustered = 2, authored = 3 };

struct SeedPatternRow {
  std::string_view name;
  bool needs_points;  ///< the seeds come with the request, as many points as seeds; else they are drawn
};

constexpr SeedPatternRow row_of(SeedPattern pattern) {
  switch (pattern) {
    case SeedPattern::uniform:
      return {.name = "uniform", .needs_points = false};
    case SeedPattern::radial:
      return {.name = "radial", .needs_points = false};
    case SeedPattern::clustered:
      return {.name = "clustered", .needs_points = false};
    case SeedPattern::authored:
      return {.name = "authored", .needs_points = true};
  }
  return {};
}

constexpr bool is_drawn(SeedPattern pattern) {
  return is_known(pattern) && !traits_of(pattern).needs_points;
}

/// Patterns for whoever has no points to give: a shatter, a hand that carves.
inline constexpr auto drawn_patterns = kinds_that<SeedPattern, is_drawn>;

/// Whether a carve, or a shatter, may have this pattern. Codecs and validate() ask the same function, so that
/// no client refuses an operation that its server applies.
Result<void> validate_carve_pattern(SeedPattern pattern);
Result<void> validate_shatter_pattern(SeedPattern pattern);

}  // namespace scree
