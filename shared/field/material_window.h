// The materials of a box of voxels: gathered from a field beside a window of codes, or a piece's own. Values;
// every voxel has a material, that of ground which nobody changed included.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/mass.h"
#include "shared/field/window.h"

namespace scree {

/// One material for all voxels of a box, or each voxel's own, in a window's order. Invariant: `each` is empty
/// or has a material for every voxel of the box.
struct MaterialWindow {
  VoxelBox box;
  Material all = material::rock;  ///< where `each` is empty
  std::vector<Material> each;

  bool is_uniform() const { return each.empty(); }
  Material at(size_t index) const { return each.empty() ? all : each[index]; }
  Material at(VoxelCoord voxel) const;

  bool operator==(const MaterialWindow&) const = default;
};

/// Mass of one material.
struct MaterialMass {
  Material material{};
  MassUnits mass = 0;

  bool operator==(const MaterialMass&) const = default;
};
/// By material: in order of rows, each at most once; a mass may be negative where it is a change.
using MaterialMasses = std::vector<MaterialMass>;

MassUnits sum_of(std::span<const MaterialMass> masses);
/// The mass of a material among them.
MassUnits mass_of(std::span<const MaterialMass> masses, Material material);
void add(MaterialMasses& to, Material material, MassUnits mass);
void add(MaterialMasses& to, std::span<const MaterialMass> more);

/// The materials of a brick's voxels, in its order.
using BrickRock = std::array<Material, brick_voxels>;
/// The one material of a brick, if it has one; and each voxel's.
std::optional<Material> one_material_of(const Field& field, BrickCoord coord);
BrickRock materials_of(const Field& field, BrickCoord coord);

/// Copies the materials of a box out of the field.
MaterialWindow gather_materials(const Field& field, const VoxelBox& box);

/// The materials of a box that lies in the window; uniform where they are.
MaterialWindow part_of(const MaterialWindow& window, const VoxelBox& box);

/// Mass of the codes by material. Both windows have the same box.
MaterialMasses masses_of(const Window& codes, const MaterialWindow& materials);

/// Gives every voxel without rock (code ≥ 0) the material of a nearest solid one, counted in steps along the
/// axes, and makes the window uniform where it can be. The windows have the same box.
void spread(MaterialWindow& materials, const Window& codes);

/// Gives the marked voxels (a byte each, in a window's order over `box`) a material. Where that is the
/// ground's own, the field says nothing. Returns the bricks whose materials changed, in order.
std::vector<BrickCoord> set_materials(Field& field, const VoxelBox& box, std::span<const uint8_t> marks,
                                      const MaterialWindow& materials);

/// The terrain's material at a place (metres): of the voxel nearest to it.
Material material_at(const Field& field, glm::vec3 p_m);

}  // namespace scree
