// Copies out of the field what a worker needs to mesh a box of it.
#pragma once

#include <map>
#include <optional>

#include "shared/field/field.h"
#include "shared/field/piece.h"
#include "shared/field/surface_nets.h"

namespace scree {

struct BlockWindows {
  VoxelBox owned;
  Window now;
  std::optional<Window> before;  ///< as generated; absent where nothing was ever edited
  std::map<BrickCoord, Material> paint;

  /// Of the cells in the mask alone, if there is one, and with vertices at those places (surface_nets.h).
  SurfaceMesh mesh(const CellMask* mask = nullptr, const SheetPlace* place = nullptr) const;
  /// The same by marching_cubes.h.
  SurfaceMesh mesh_by_cubes(const CellMask* mask) const;
  /// Sets SurfaceVertex::paint of a mesh in this window's voxels.
  void put_paint_on(SurfaceMesh& mesh) const;
};

/// Nothing when all the bricks around are air, or all are rock.
std::optional<BlockWindows> gather_windows(Field& field, const VoxelBox& owned);

/// What SurfaceVertex::paint says.
inline uint8_t paint_number(std::optional<Material> paint) {
  return paint ? static_cast<uint8_t>(1 + static_cast<int>(*paint)) : uint8_t{0};
}

/// What a piece shows: its material, where the field is painted at the place that it was cut from.
uint8_t paint_number(const Field& field, const Volume& piece);

/// As gather(), of the field as it was generated.
Window gather_generated(Field& field, const VoxelBox& box);

}  // namespace scree
