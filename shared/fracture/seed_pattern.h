// How the seeds of a break lie in the volume that breaks: a row for each pattern.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "shared/base/kind_table.h"
#include "shared/field/coord.h"
#include "shared/material/palette.h"

namespace scree {

class Random;

/// - uniform: anywhere in the volume.
/// - radial: density ∝ 1/d² from the impact, the paper's "spiderweb" (1.2.2).
/// - clustered: density ∝ 1/d² from the nearest of a few places in the volume, one for every eight seeds, 64
///   at most.
/// - authored: at the points that come with the request.
/// - even: far from each other, so that the pieces are of like size (server/fracture/even_seeds.h).
/// - grain_x, …: radial, but all in one plane across the axis, so that cells are splinters along it.
/// - slabs_x, …: radial, but all on one line along the axis, so that cells are plates across it.
/// - shards: radial, but all in one plane across the volume's shortest side, so that cells go through it.
/// - natural: a few blocks, radial, each cut on by itself: sizes by the law of blasted rock, small near the
///   impact, and dust (natural_cut.h).
enum class SeedPattern : uint8_t {
  uniform = 0,
  radial = 1,
  clustered = 2,
  authored = 3,
  even = 4,
  grain_x = 5,
  grain_y = 6,
  grain_z = 7,
  slabs_x = 8,
  slabs_y = 9,
  slabs_z = 10,
  shards = 11,
  natural = 12
};

/// drawn: by everyone who applies the operation, from its random seed. given: points that come with the
/// request. relaxed: points that the server computes. Points travel in the operation, as many as seeds.
enum class SeedSource : uint8_t { drawn, given, relaxed };

/// Places in a volume, whose solid voxels are listed, about which `count` drawn seeds are dense.
using DensePlaces = std::vector<glm::vec3>(uint32_t count, glm::vec3 impact_voxels,
                                           const std::vector<VoxelCoord>& solid, Random& random);
DensePlaces at_impact;
DensePlaces at_clusters;

/// Along which axes all seeds of a drawn pattern lie at one place: x, y, z as bits 0 to 2.
enum class Flattened : uint8_t { none = 0, x = 1, y = 2, xy = 3, z = 4, xz = 5, yz = 6, shortest = 7 };

struct SeedPatternRow {
  std::string_view name;
  SeedSource source;
  DensePlaces* places = nullptr;  ///< of a drawn pattern; null: seeds lie anywhere
  Flattened flattened = Flattened::none;
  bool is_cut_on = false;  ///< the seeds make blocks, which are cut on
};

constexpr SeedPatternRow drawn_flat(std::string_view name, Flattened flattened) {
  return {.name = name, .source = SeedSource::drawn, .places = at_impact, .flattened = flattened};
}

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
    case SeedPattern::grain_x:
      return drawn_flat("grain_x", Flattened::x);
    case SeedPattern::grain_y:
      return drawn_flat("grain_y", Flattened::y);
    case SeedPattern::grain_z:
      return drawn_flat("grain_z", Flattened::z);
    case SeedPattern::slabs_x:
      return drawn_flat("slabs_x", Flattened::yz);
    case SeedPattern::slabs_y:
      return drawn_flat("slabs_y", Flattened::xz);
    case SeedPattern::slabs_z:
      return drawn_flat("slabs_z", Flattened::xy);
    case SeedPattern::shards:
      return drawn_flat("shards", Flattened::shortest);
    case SeedPattern::natural:
      return {.name = "natural", .source = SeedSource::drawn, .places = at_impact, .is_cut_on = true};
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
/// Whether the pieces are no cells of the pattern's own seeds, but cut from these.
constexpr bool is_cut_on(SeedPattern pattern) {
  return is_known(pattern) && traits_of(pattern).is_cut_on;
}
/// Whether a request needs no points.
constexpr bool asks_no_points(SeedPattern pattern) {
  return !is_given(pattern);
}

/// Patterns that need no points: for a piece that shatters, and for a person who carves.
inline constexpr auto drawn_patterns = kinds_that<SeedPattern, is_drawn>;
inline constexpr auto pointless_patterns = kinds_that<SeedPattern, asks_no_points>;

/// What people and programs ask for that say nothing else.
inline constexpr SeedPattern usual_pattern = SeedPattern::natural;

/// Takes the place of a pattern whose points are missing, in later cuts and in predictions.
inline constexpr SeedPattern plain_pattern = SeedPattern::uniform;

/// How a body of a material breaks, by its row of the palette.
SeedPattern pattern_of(BreakLook look, GrainAxis axis);

/// Whether a carve, or a shatter, may have this pattern. Codecs and validate() ask the same function, so that
/// no client refuses an operation that its server applies.
Result<void> validate_carve_pattern(SeedPattern pattern);
Result<void> validate_shatter_pattern(SeedPattern pattern);

}  // namespace scree
