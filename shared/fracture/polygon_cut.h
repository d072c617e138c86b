// A volume cut along Voronoi cells as polygons, and its parts turned into pieces: what the cutters `slice`
// and `conform` have in common. Voxels; deterministic.
#pragma once

#include "shared/fracture/polygon_mesh.h"
#include "shared/fracture/voronoi.h"

namespace scree {

struct PolygonParts {
  PolygonMesh whole;
  std::vector<PolygonMesh> cells;  ///< of each seed, in a box about the whole
  std::vector<PolygonMesh> parts;  ///< of the whole in each cell
};

/// The volume's polygons cut by `slice` or `conform`. The parts' volumes add up to that of the whole.
PolygonParts cut_polygons(Cutter cutter, const Window& volume, const std::vector<glm::vec3>& seeds_voxels);

/// As cut_cells (voronoi.h), by any cutter. The polygons' shares of the volume are the pieces' of the mass
/// lost, to the unit; the codes of a piece are the distances to its polygons. A volume so thin that it has no
/// polygons becomes dust.
Cut cut_volume(Cutter cutter, const Window& volume, const Window& before, const Window& after,
               const std::vector<glm::vec3>& seeds_voxels);

}  // namespace scree
