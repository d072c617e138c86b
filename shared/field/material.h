// What terrain is made of, in layers: soil over rock, ice on the heights. A function of the terrain's source
// and the place alone, so it never crosses the wire; what is painted over it does (paint.h). Metres,
// kilograms, seconds.
//
// Mass in the ledger is volume (units of 1/254 voxel) whatever the material; density only tells how heavy a
// piece is as a body.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "shared/field/terrain.h"

namespace scree {

enum class Material : uint8_t { rock = 0, soil = 1, ice = 2 };

std::string_view name_of(Material material);
std::optional<Material> material_named(std::string_view name);

struct MaterialTraits {
  float density_kg_m3 = 0.0F;
  float friction = 0.0F;  ///< coefficient; of two that touch, the geometric mean counts
  /// Change of speed in one contact that breaks a piece of 1 m³. Larger pieces have more flaws and break
  /// sooner: with the fourth root of their volume, as rock does (Weibull's modulus near 4).
  float strength_m_s = 0.0F;
  /// Seeds of a break, relative to rock: how finely it crumbles.
  float seed_density = 0.0F;
  /// Energy that it takes to press a volume out of the ground, J/m³.
  float dent_resistance_j_m3 = 0.0F;
};

const MaterialTraits& traits_of(Material material);

/// Soil covers ground below the one height, ice above the other.
struct MaterialHeights {
  float soil_below_m = 0.0F;
  float ice_above_m = 0.0F;
};
MaterialHeights heights_of(TerrainKind kind);

/// The undisturbed terrain's material at a place. Places above the undisturbed ground count as rock.
Material material_at(const TerrainSource& source, glm::vec3 p_m);

}  // namespace scree
