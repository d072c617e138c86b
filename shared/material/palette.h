// The palette: the materials of a world, as a table that comes from a file (content/palette_text.h).
//
// A world, a recording and a welcome carry it by its digest (proto/palette_codec.h). Rows can be added, but
// never removed or renumbered, because voxels hold their numbers. No kernel that decides bits of the field
// reads a row's numbers: they drive bodies, breaks, falls, sounds and drawing, and may change in a running
// world. Only `ground`, and what is rubble of what, decide bits, and stay. A value; metres, kilograms,
// seconds, pascals.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/digest.h"
#include "shared/base/kind_table.h"
#include "shared/base/result.h"
#include "shared/material/material.h"

namespace scree {

/// Pressure that a section of terrain carries, Pa, by how the load lies on it; and the tension at the edge of
/// a section, from the load's leverage, at which it breaks.
struct Bearing {
  float pressed_pa = 5.1e6F;
  float hanging_pa = 1.27e6F;
  float sideways_pa = 6.4e5F;
  float bending_pa = 2.75e6F;

  bool operator==(const Bearing&) const = default;
};

/// How a body of the material comes apart. even: lumps, smaller near the blow. grain: splinters along an
/// axis. slabs: flat plates across an axis. shards: blades that run from the blow through the thin side.
enum class BreakLook : uint8_t { even = 0, grain = 1, slabs = 2, shards = 3 };

struct BreakLookRow {
  std::string_view name;
  bool has_axis;
};
constexpr BreakLookRow row_of(BreakLook look) {
  switch (look) {
    case BreakLook::even:
      return {.name = "even", .has_axis = false};
    case BreakLook::grain:
      return {.name = "grain", .has_axis = true};
    case BreakLook::slabs:
      return {.name = "slabs", .has_axis = true};
    case BreakLook::shards:
      return {.name = "shards", .has_axis = false};
  }
  return {};
}

/// Axis of the grain or across the slabs, in the terrain that a piece was cut from.
enum class GrainAxis : uint8_t { x = 0, y = 1, z = 2 };

struct GrainAxisRow {
  std::string_view name;
};
constexpr GrainAxisRow row_of(GrainAxis axis) {
  switch (axis) {
    case GrainAxis::x:
      return {.name = "x"};
    case GrainAxis::y:
      return {.name = "y"};
    case GrainAxis::z:
      return {.name = "z"};
  }
  return {};
}

/// A procedural pattern of a surface, whose scale is a row's pattern_m: the size of a grain, the thickness of
/// a stratum, the length of a brick, the width of a plank, the size of a pebble.
enum class SurfacePattern : uint8_t { plain = 0, grain = 1, strata = 2, bricks = 3, planks = 4, pebbles = 5 };

struct SurfacePatternRow {
  std::string_view name;
};
constexpr SurfacePatternRow row_of(SurfacePattern pattern) {
  switch (pattern) {
    case SurfacePattern::plain:
      return {.name = "plain"};
    case SurfacePattern::grain:
      return {.name = "grain"};
    case SurfacePattern::strata:
      return {.name = "strata"};
    case SurfacePattern::bricks:
      return {.name = "bricks"};
    case SurfacePattern::planks:
      return {.name = "planks"};
    case SurfacePattern::pebbles:
      return {.name = "pebbles"};
  }
  return {};
}

struct MaterialSound {
  float pitch = 1.0F;       ///< of its modes, relative to rock of the same size
  float damping_s = 0.08F;  ///< time in which the ringing falls to 1/e
  float noise = 0.5F;       ///< share of noise in a blow, 0 to 1

  bool operator==(const MaterialSound&) const = default;
};

struct MaterialLook {
  std::array<float, 3> colour{0.5F, 0.5F, 0.5F};  ///< linear RGB, 0 to 1
  float variation = 0.1F;                         ///< of its brightness from place to place, 0 to 1
  float roughness = 0.9F;                         ///< 0: a mirror; 1: dull
  SurfacePattern pattern = SurfacePattern::plain;
  float pattern_m = 0.25F;
  std::optional<Digest> albedo{};  ///< SHA-256 of a PNG, drawn over the colour
  std::optional<Digest> normal{};  ///< likewise, of normals
  float image_m = 1.0F;            ///< side of the place that an image covers

  bool operator==(const MaterialLook&) const = default;
};

/// A row that is rubble: of which row its stones are, and how much of it they fill. Both decide bits, and
/// stay.
struct RubbleOf {
  Material of{};
  /// In 128ths: 0.62, so that broken rock takes 1.6 times its volume (swell factor of rock: 50 to 80 %,
  /// Hartman, SME Mining Engineering Handbook, 1992, table 9.1.1).
  uint8_t fill = 79;

  bool operator==(const RubbleOf&) const = default;
};
inline constexpr int rubble_fill_min = 32, rubble_fill_max = fill_solid - 1;

struct MaterialRow {
  std::string name;
  float density_kg_m3 = 2600.0F;
  float friction = 0.7F;      ///< coefficient; of two that touch, the geometric mean counts
  float restitution = 0.05F;  ///< share of the speed that a blow gives back; combined likewise
  /// Change of speed in one contact that breaks a piece of 1 m³. Larger pieces have more flaws and break
  /// sooner: by the volume to the power of `strength_by_size` (rock: 1/4, Weibull's modulus near 4).
  float strength_m_s = 10.0F;
  float strength_by_size = 0.25F;
  /// Seeds of a break, relative to rock: how finely it crumbles.
  float seed_density = 1.0F;
  BreakLook breaks = BreakLook::even;
  GrainAxis axis = GrainAxis::y;
  /// Energy that it takes to press a volume out of the ground, J/m³.
  float dent_resistance_j_m3 = 5.0e7F;
  Bearing bearing;
  MaterialSound sound;
  MaterialLook look;
  std::optional<RubbleOf> rubble{};
  /// Loose ground such as sand, which a merge leaves as it is. Decides bits, and stays.
  bool loose = false;

  bool operator==(const MaterialRow&) const = default;
};

struct Palette {
  std::vector<MaterialRow> rows;  ///< 1 to materials_max, with different names
  GroundRows ground;

  bool operator==(const Palette&) const = default;

  bool has(Material material) const { return row_number(material) < rows.size(); }
  /// The row of a material that the palette has.
  const MaterialRow& row(Material material) const;
  /// The same, or the first row where the palette has none: for what came of another palette.
  const MaterialRow& row_or_first(Material material) const {
    return row(has(material) ? material : Material{});
  }
  std::string_view name(Material material) const { return row(material).name; }
  std::optional<Material> named(std::string_view name) const;
  std::vector<std::string_view> names() const;
};

/// One row that looks and behaves like any rock: for who has no palette yet.
const std::shared_ptr<const Palette>& plain_palette();

/// Whether every number keeps its bounds, names are different, and the ground's rows are there. The error
/// names the row and the member.
Result<void> validate(const Palette& palette);

/// Whether `next` may take the place of `before` in a world: it has all rows of it under the same numbers and
/// names, and the same ground.
Result<void> validate_change(const Palette& before, const Palette& next);

}  // namespace scree
