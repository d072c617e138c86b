// What terrain is made of, in layers: soil over rock, ice on the heights. A function of the terrain's source
// and the place alone, so it never crosses the wire; what is painted over it does (paint.h). Metres,
// kilograms, seconds.
//
// Mass in the ledger is volume (units of 1/254 voxel) whatever the material; density only tells how heavy a
// piece is as a body.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "shared/base/kind_table.h"
#include "shared/field/terrain.h"

namespace scree {

enum class Material : uint8_t { rock = 0, soil = 1, ice = 2 };

/// Pressure that a section of terrain carries, Pa, by how the load lies on it; and the tension at the edge of
/// a section, from the load's leverage, at which it breaks.
struct Bearing {
  float pressed_pa;
  float hanging_pa;
  float sideways_pa;
  float bending_pa;
};

struct MaterialRow {
  std::string_view name;
  float density_kg_m3;
  float friction;  ///< coefficient; of two that touch, the geometric mean counts
  /// Change of speed in one contact that breaks a piece of 1 m³. Larger pieces have more flaws and break
  /// sooner: with the fourth root of their volume, as rock does (Weibull's modulus near 4).
  float strength_m_s;
  /// Seeds of a break, relative to rock: how finely it crumbles.
  float seed_density;
  /// Energy that it takes to press a volume out of the ground, J/m³.
  float dent_resistance_j_m3;
  Bearing bearing;
  /// How deep the generator's layer of it reaches below the undisturbed ground, metres; 0: it lays none.
  float layer_depth_m;
  std::array<float, 3> albedo;  ///< where it is painted, or a cut lays its layer bare; linear RGB
};

/// Bearing: a column of so many metres of rock weighs 25,500 Pa a metre on its foot. Rock carries 200 m of
/// itself pressed, 50 m hanging and 25 m sideways, soil a tenth of that, ice in between. A beam of rock that
/// is 4 m high breaks under its own weight at 12 m, by leverage (shared/falling/leverage.h).
constexpr MaterialRow row_of(Material material) {
  switch (material) {
    case Material::rock:
      return {.name = "rock",
              .density_kg_m3 = 2600.0F,
              .friction = 0.7F,
              .strength_m_s = 10.0F,
              .seed_density = 1.0F,
              .dent_resistance_j_m3 = 5.0e7F,
              .bearing = {.pressed_pa = 5.1e6F,
                          .hanging_pa = 1.27e6F,
                          .sideways_pa = 6.4e5F,
                          .bending_pa = 2.75e6F},
              .layer_depth_m = 0.0F,
              .albedo = {0.33F, 0.31F, 0.30F}};
    case Material::soil:
      return {.name = "soil",
              .density_kg_m3 = 1700.0F,
              .friction = 0.9F,
              .strength_m_s = 7.0F,
              .seed_density = 1.5F,
              .dent_resistance_j_m3 = 2.5e5F,
              .bearing = {.pressed_pa = 4.0e5F,
                          .hanging_pa = 1.0e5F,
                          .sideways_pa = 5.0e4F,
                          .bending_pa = 1.0e5F},
              .layer_depth_m = 1.0F,
              .albedo = {0.20F, 0.12F, 0.06F}};
    case Material::ice:
      return {.name = "ice",
              .density_kg_m3 = 920.0F,
              .friction = 0.3F,
              .strength_m_s = 6.0F,
              .seed_density = 1.25F,
              .dent_resistance_j_m3 = 5.0e6F,
              .bearing = {.pressed_pa = 1.35e6F,
                          .hanging_pa = 3.4e5F,
                          .sideways_pa = 1.7e5F,
                          .bending_pa = 7.3e5F},
              .layer_depth_m = 1.5F,
              .albedo = {0.62F, 0.76F, 0.86F}};
  }
  return {};
}

/// The material that the ground stores for a brick of a chunk, if any.
std::optional<Material> stored_material(const GeneratedChunk& chunk, int index);

/// The undisturbed terrain's material at a place. Places above the undisturbed ground count as rock.
Material material_at(const TerrainSource& source, glm::vec3 p_m);

}  // namespace scree
