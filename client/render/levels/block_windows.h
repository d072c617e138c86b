// Copies the codes out of the field that a worker needs to mesh a box.
#pragma once

#include <optional>

#include "client/render/levels/face_edges.h"
#include "client/render/levels/look_window.h"
#include "shared/field/field.h"
#include "shared/surface/surface_nets.h"

namespace scree {

struct BlockWindows {
  VoxelBox owned;
  Window now;
  std::optional<Window> before;  ///< as generated; absent where nothing was ever edited
  LookWindow looks{};
  bool smooth_ground = false;  ///< rock as generated has no edges (has_smooth_ground())

  /// The mesh of the cells in the mask alone, if there is one, with vertices at those places
  /// (surface_nets.h).
  SurfaceMesh mesh(FaceEdges edges, const CellMask* mask = nullptr, const SheetPlace* place = nullptr) const;
  /// Moves a mesh of this window to the edges of its faces (creases.h).
  void sharpen(SurfaceMesh& mesh, const std::vector<bool>* fixed = nullptr) const;
  /// The same by marching_cubes.h.
  SurfaceMesh mesh_by_cubes(const CellMask* mask) const;
  /// Whether all looks as the ground does that nobody touched.
  bool is_untouched() const { return !before && looks.is_ground(); }
  /// Sets SurfaceVertex::look of a mesh in this window's voxels (surface_looks.h).
  void set_looks(SurfaceMesh& mesh) const;
  /// Packs SurfaceVertex::before for a shader.
  void set_worn(SurfaceMesh& mesh) const;

 private:
  SurfaceMesh finished(SurfaceMesh&& made) const;
  int worn(const SurfaceVertex& vertex, glm::vec3 p) const;
};

/// Nothing when all the bricks around are air, or all are rock.
std::optional<BlockWindows> gather_windows(const Field& field, const VoxelBox& owned);

/// Like gather(), but of the generated field without edits.
Window gather_generated(const Field& field, const VoxelBox& box);

}  // namespace scree
