// How the seeds of a break lie in the volume that breaks: a row for each pattern.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "shared/base/kind_table.h"
#include "shared/field/coord.h"

namespace scree {

class Random;

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

/// Places in a volume, whose solid voxels are listed, about which `count` drawn seeds are dense.
using DensePlaces = std::vector<glm::vec3>(uint32_t count, glm::vec3 impact_voxels,
                                           const std::vector<VoxelCoord>& solid, Random& random);
DensePlaces at_impact;
DensePlaces at_clusters;

struct SeedPatternRow {
  std::string_view name;
  SeedSource source;
  DensePlaces* places = nullptr;  ///< of a drawn pattern; null: seeds lie anywhere
};

constexpr SeedPatternRow row_of(SeedPattern pattern) {
  switch (pattern) {
    case SeedPattern::uniform:
      return {.name = "uniform", .source = SeedSource::drawn, .places = nullptr};
    case SeedPattern::radial:
      return {.name = "radial", .source = SeedSource::drawn, .places = at_impact};
    case SeedPattern::clustered:
      return {.name = "clustered", .source = SeedSource::drawn, .places = at_clusters};
    case SeedPattern::authored:
      return {.name = "authored", .source = SeedSource::given, .places = nullptr};
    case SeedPattern::even:
      return {.name = "even", .source = SeedSource::relaxed, .places = nullptr};
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

/// Takes the place of a pattern whose points are missing, in later cuts and in predictions.
inline constexpr SeedPattern plain_pattern = SeedPattern::uniform;

/// Whether a carve, or a shatter, may have this pattern. Codecs and validate() ask the same function, so that
/// no client refuses an operation that its server applies.
Result<void> validate_carve_pattern(SeedPattern pattern);
Result<void> validate_shatter_pattern(SeedPattern pattern);

}  // namespace scree
