// Copies the codes out of the field that a worker needs to mesh a box.
#pragma once

#include <map>
#include <optional>

#include "client/render/scene/paint_number.h"
#include "shared/field/field.h"
#include "shared/field/piece.h"
#include "shared/surface/surface_nets.h"

namespace scree {

struct BlockWindows {
  VoxelBox owned;
  Window now;
  std::optional<Window> before;  ///< as generated; absent where nothing was ever edited
  std::map<BrickCoord, Material> paint;
  TerrainSource source;

  /// The mesh of the cells in the mask alone, if there is one, with vertices at those places
  /// (surface_nets.h).
  SurfaceMesh mesh(const CellMask* mask = nullptr, const SheetPlace* place = nullptr) const;
  /// The same by marching_cubes.h.
  SurfaceMesh mesh_by_cubes(const CellMask* mask) const;
  /// Sets SurfaceVertex::paint of a mesh in this window's voxels: by brick, and by layer in cuts. Makes
  /// SurfaceVertex::before a distance, 0 … 127, of what lies here now from the field as generated, also where
  /// that was at the same place but faced another way (worn_at in client/shaders/bricks.glsl).
  void set_paint(SurfaceMesh& mesh) const;

 private:
  Code worn(const SurfaceVertex& vertex, glm::vec3 p) const;
  float layer_m(const MaterialHeights& layers, glm::vec3 p) const;
};

/// Nothing when all the bricks around are air, or all are rock.
std::optional<BlockWindows> gather_windows(const Field& field, const VoxelBox& owned);

/// The material that shows on a brick: its paint, else what the ground stores for it, if any.
std::optional<Material> shown_material(const Field& field, BrickCoord brick);

/// The paint number of a piece: its material, everywhere if the field is painted where it was cut, else only
/// in its cuts.
uint8_t paint_number(const Field& field, const Volume& piece);

/// Like gather(), but of the generated field without edits.
Window gather_generated(const Field& field, const VoxelBox& box);

}  // namespace scree
