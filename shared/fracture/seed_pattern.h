// How the seeds of a break lie in the volume that breaks.
#pragma once

#include <cstdint>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

/// - uniform: anywhere in the volume.
/// - radial: density ∝ 1/d² from the impact, the paper's "spiderweb" (1.2.2).
/// - clustered: density ∝ 1/d² from the nearest of a few places in the volume, one for every eight seeds, 64
///   at most.
/// - authored: at the points that come with the request.
/// - even: far from each other, so that the pieces are of like size (server/fracture/even_seeds.h).
enum class SeedPattern : uint8_t { uniform = 0, radial = 1, clustered = 2, authored = 3, even = 4 };

/// drawn: by everyone who applies the operation, from its random seed. given: points that come with the
/// request. relaxed: points that the server computes. Points travel in the operation, as many as seeds.
enum class SeedSource : uint8_t { drawn, given, relaxed };

struct SeedPatternRow {
  std::string_view name;
  SeedSource source;
};

constexpr SeedPatternRow row_of(SeedPattern pattern) {
  switch (pattern) {
    case SeedPattern::uniform:
      return {.name = "uniform", .source = SeedSource::drawn};
    case SeedPattern::radial:
      return {.name = "radial", .source = SeedSource::drawn};
    case SeedPattern::clustered:
      return {.name = "clustered", .source = SeedSource::drawn};
    case SeedPattern::authored:
      return {.name = "authored", .source = SeedSource::given};
    case SeedPattern::even:
      return {.name = "even", .source = SeedSource::relaxed};
  }
  return {};
}

constexpr bool is_drawn(SeedPattern pattern) {
  return is_known(pattern) && traits_of(pattern).source == SeedSource::drawn;
}
constexpr bool is_given(SeedPattern pattern) {
  return is_known(pattern) && traits_of(pattern).source == SeedSource::given;
}
constexpr bool is_relaxed(SeedPattern pattern) {
  return is_known(pattern) && traits_of(pattern).source == SeedSource::relaxed;
}
/// Whether a request needs no points.
constexpr bool asks_no_points(SeedPattern pattern) {
  return !is_given(pattern);
}

/// Patterns that need no points: for a piece that shatters, and for a person who carves.
inline constexpr auto drawn_patterns = kinds_that<SeedPattern, is_drawn>;
inline constexpr auto pointless_patterns = kinds_that<SeedPattern, asks_no_points>;

/// Whether a carve, or a shatter, may have this pattern. Codecs and validate() ask the same function, so that
/// no client refuses an operation that its server applies.
Result<void> validate_carve_pattern(SeedPattern pattern);
Result<void> validate_shatter_pattern(SeedPattern pattern);

}  // namespace scree
