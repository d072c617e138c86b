// A volume cut along Voronoi cells as polygons, and its parts turned into pieces: the common part of the
// cutters `slice` and `conform`. Voxels; deterministic.
#pragma once

#include "shared/fracture/polygon_mesh.h"
#include "shared/fracture/voronoi.h"

namespace scree {

/// Faces between a voxel inside and one outside, of a volume that is cut as polygons: twice those of the
/// largest carve of the smallest voxels. A volume off a wire may have 50 times as many, whose cut would take
/// gigabytes. Above: cut by `field`.
inline constexpr size_t polygon_faces_max = size_t{1} << 17;

struct PolygonParts {
  PolygonMesh whole;
  std::vector<PolygonMesh> cells;  ///< the cell of each seed, in a box around the whole
  std::vector<PolygonMesh> parts;  ///< the part of the whole in each cell
};

/// The volume's polygons cut by `slice` or `conform`. The parts' volumes add up to that of the whole.
PolygonParts cut_polygons(Cutter cutter, const Window& volume, const std::vector<glm::vec3>& seeds_voxels);

/// Cuts like cut_cells() (voronoi.h), by any cutter. The polygon cutters share the lost mass out in
/// proportion to the volumes of the parts, to the unit; the codes of a piece are the distances to its
/// polygons. A volume so thin that it has no polygons becomes dust; one of more than polygon_faces_max faces
/// is cut by `field`.
Cut cut_volume(Cutter cutter, const Window& volume, const Window& before, const Window& after,
               const std::vector<glm::vec3>& seeds_voxels);

}  // namespace scree
