// The mass of a window whose rubble slid, by material: which voxels become of what, and the single codes by
// which the sums stay as they were. Private to slides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shared/field/material_window.h"
#include "shared/field/window.h"

namespace scree {

class SlideMass {
 public:
  /// `near` has a byte for each column of the window: not 0 where codes may have changed. All outlive it.
  SlideMass(const MaterialReader& were, const RubbleRows& rows, const Window& before, Material material,
            const std::vector<uint8_t>& near);

  /// Decides what the changed voxels of that window are of. What covers another material's surface counts for
  /// the one or the other, so that each keeps its mass nearly. Voxels that touch no zero crossing are full or
  /// empty in it.
  void assign(const Window& after);
  /// What the rubble, and what its stones are of, gained.
  MassUnits gain_of_rubble() const { return gains_[row_number(rows_.stones[row_number(material_)])]; }
  /// What may be met by single codes of that rubble's surface, about.
  MassUnits reach_of_rubble() const;
  /// Moves surface voxels by single codes until nothing has gained. False where that cannot be.
  bool meet(Window& after);
  /// Whether the materials that were assigned have the mass that they had.
  bool is_met(const Window& after) const;
  /// Mass times height, in units and voxels, that the window gained.
  int64_t lifted(const Window& after) const;
  /// What a voxel has become of; 0 where it is of what it was.
  const std::vector<VoxelMaterial>& becomes() const { return becomes_; }

 private:
  struct Open {
    size_t at;
    Material was;
    int had, has;
  };
  struct Surface {
    size_t at;
    Material material;
    int moved = 0;
  };
  using Gains = std::array<MassUnits, 256>;

  int mass(int code, Material material) const;
  Material is_of(VoxelCoord voxel, size_t at) const;
  void assign_open(const std::vector<Open>& open, Gains& converted);
  void list_surface(const Window& after);
  bool meet_one(Window& after, size_t stones);
  void spread(Window& after, std::vector<Surface*>& movable, MassUnits& wanted) const;
  bool finish(Window& after, const std::vector<Surface*>& movable, MassUnits wanted) const;
  Gains gains_of(const Window& after) const;
  template <typename F>
  void for_each_near(F&& f) const;

  const MaterialReader& were_;
  const RubbleRows& rows_;
  const Window& before_;
  Material material_;
  const std::vector<uint8_t>& near_;
  std::vector<VoxelMaterial> becomes_;
  std::vector<Surface> surface_;
  Gains gains_{};
};

}  // namespace scree
