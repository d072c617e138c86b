// The materials of a box of voxels: gathered from a field beside a window of codes, or a piece's own. Values;
// every voxel has a material, that of ground which nobody changed included.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/mass.h"
#include "shared/field/window.h"
#include "shared/material/rubble.h"

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

/// What each voxel of a window would be once cut, and how much of it its stones fill (RubbleRows).
struct RockWindow {
  MaterialWindow stones;
  FillWindow fills;
};
RockWindow rock_of(MaterialWindow materials, const RubbleRows& rows);

/// Mass of one material.
struct MaterialMass {
  Material material{};
  MassUnits mass = 0;

  bool operator==(const MaterialMass&) const = default;
};
/// By material: in order of rows, each at most once; a mass may be negative where it is a change.
using MaterialMasses = std::vector<MaterialMass>;

/// Sums by row: those that are not 0.
MaterialMasses listed(const std::array<MassUnits, 256>& sums);
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

/// What a brick's voxels say of their materials.
struct BrickSays {
  BrickCoord coord;
  BrickMaterials materials;
};

/// Reads the materials of single voxels of a box, without copying all of them, while the field stays as it
/// is.
class MaterialReader {
 public:
  MaterialReader(const Field& field, const VoxelBox& box);
  MaterialReader(const MaterialReader&) = delete;
  MaterialReader& operator=(const MaterialReader&) = delete;

  const VoxelBox& box() const { return box_; }
  /// The one material of all bricks of the box, if there is one.
  std::optional<Material> uniform() const;
  Material at(VoxelCoord voxel) const;
  /// Copies them all.
  MaterialWindow window() const;

  /// What a brick's voxels say, and what says the ground below them; both live as long as the reader.
  struct BrickOf {
    const BrickMaterials* said;
    const BrickMaterials* ground;

    std::optional<Material> uniform() const;
    Material at(int index) const;
    void resolve(VoxelMaterials& to) const;
  };
  /// The bricks that touch the box: how many, and the place of one among them, in order.
  size_t bricks() const { return bricks_.size(); }
  size_t place_of(BrickCoord coord) const;
  const BrickOf& brick_at(size_t place) const { return bricks_[place]; }

 private:
  const BrickOf& brick(BrickCoord coord) const { return bricks_[place_of(coord)]; }
  void add_chunk(const Field& field, ChunkCoord chunk, const VoxelBox& part);

  VoxelBox box_;
  BrickMaterials bulk_;
  BrickCoord lo_, size_;
  std::vector<BrickOf> bricks_;
  std::deque<BrickMaterials> owned_;  ///< where the field hands out no references
};

/// Copies the materials of a box out of the field.
MaterialWindow gather_materials(const Field& field, const VoxelBox& box);

/// The materials of a box that lies in the window; uniform where they are.
MaterialWindow part_of(const MaterialWindow& window, const VoxelBox& box);

/// Mass of the codes by material. Both windows have the same box.
MaterialMasses masses_of(const Window& codes, const MaterialWindow& materials);

/// What the terrain lost of each material, in order, none of it 0: of rubble, that of its stones. All three
/// have the same box.
MaterialMasses masses_lost(const Window& before, const Window& after, const RockWindow& rock);

/// The material of the solid voxel (code < 0) nearest to one, which is in the box, at most two voxels away;
/// if there is none, its own. The windows have the same box.
Material material_near(const Window& codes, const MaterialWindow& materials, VoxelCoord voxel);

/// Writes a window of codes back, and what bricks in it say, which are in order. Returns the bricks that
/// changed, in order.
std::vector<BrickCoord> scatter(Field& field, const Window& window, std::span<const BrickSays> says);

/// The terrain's material at a place (metres): of the voxel nearest to it.
Material material_at(const Field& field, glm::vec3 p_m);

}  // namespace scree
