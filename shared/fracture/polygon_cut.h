// A volume cut along Voronoi cells as polygons, and its parts turned into pieces: the common part of the
// cutters `slice` and `conform`. Voxels; deterministic.
#pragma once

#include "shared/fracture/cutter.h"
#include "shared/fracture/polygon_mesh.h"

namespace scree {

/// Faces between a voxel inside and one outside, of a volume that is cut as polygons: twice those of the
/// largest carve of the smallest voxels. A volume off a wire may have 50 times as many, whose cut would take
/// gigabytes. Above: cut by `field`.
inline constexpr size_t polygon_faces_max = size_t{1} << 17;

/// A way to cut a closed mesh by cells.
struct PolygonCutting {
  /// The part of the mesh in each cell (voronoi_cells.h).
  std::vector<PolygonMesh> (*parts)(const PolygonMesh& mesh, const std::vector<PolygonMesh>& cells);
  /// Whether every part is closed exactly. If it is closed except for rounding, a voxel lies in a part when
  /// it lies in the whole and in the cell.
  bool closed;
};

struct PolygonParts {
  PolygonMesh whole;
  std::vector<PolygonMesh> cells;  ///< the cell of each seed, in a box around the whole
  std::vector<PolygonMesh> parts;  ///< the part of the whole in each cell
};

/// The volume's polygons, cut. The parts' volumes add up to that of the whole.
PolygonParts cut_polygons(const PolygonCutting& cutting, const Window& volume,
                          const std::vector<glm::vec3>& seeds_voxels);

/// Cuts as a CutFunction does. The lost mass is shared out in proportion to the volumes of the parts, to the
/// unit; the codes of a piece are the distances to its polygons. A volume so thin that it has no polygons
/// becomes dust; one of more than polygon_faces_max faces is cut by `field`.
Cut cut_as_polygons(const PolygonCutting& cutting, const Window& volume, std::vector<uint8_t> lost,
                    const std::vector<glm::vec3>& seeds_voxels);

}  // namespace scree
