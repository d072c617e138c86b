// From a file's triangles to bodies: closed surfaces, and surfaces with holes. Inside and outside are of the
// whole file, whatever its materials and groups are.
#pragma once

#include "shared/base/result.h"
#include "tools/import/mesh/sheet.h"

namespace scree {

/// A surface with holes, and the edges around them.
struct OpenBody {
  using Edge = std::array<glm::dvec3, 2>;

  TriangleMesh mesh;
  std::vector<Edge> edges;
};

struct BodiesRule {
  SheetRule sheet = SheetRule::refuse;
  double voxel_m = 0.25;
  /// Rock that sheets stand on, y; they are filled down to it, or to their lowest point if that is lower.
  std::optional<double> level_m{};
};

/// Counts of one kind of part.
struct PartCount {
  size_t parts = 0;
  double volume_m3 = 0.0;
  double area_m2 = 0.0;
};

struct MeshBodies {
  TriangleMesh closed;
  std::vector<OpenBody> open;

  size_t triangles = 0;
  WeldFindings welded;
  PartFindings turned;
  PartCount whole;  ///< closed parts
  PartCount holed;  ///< closed by winding numbers; the volume is with flat caps
  size_t open_edges = 0;
  double missing = 0.0;   ///< of the surface of those with holes, the share that is not there
  PartCount filled;       ///< sheets that were filled down
  double bottom_m = 0.0;  ///< to here
  PartCount dropped;      ///< sheets that were left out
  PartCount thin;         ///< parts that are thinner than a voxel, of all these
  PartCount slim;         ///< parts that are thinner than two voxels, but not than one
  double thinnest_m = 0.0;

  double volume_m3() const { return whole.volume_m3 + holed.volume_m3 + filled.volume_m3; }
};

/// The error says that there are open sheets, and which options import them.
Result<MeshBodies> bodies_of(TriangleMesh mesh, const BodiesRule& rule);

}  // namespace scree
