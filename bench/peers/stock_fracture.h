// OpenVDB's stock way to break terrain and to put it back, a peer of our own: level sets in a FloatGrid,
// cells as polygon meshes turned into volumes. Metres. Not thread-safe; OpenVDB itself uses every core.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/piece.h"

namespace scree::peers {

struct BreakTimes {
  double extract_ms = 0.0;  ///< csgIntersection
  double carve_ms = 0.0;    ///< csgDifference
  double cells_ms = 0.0;    ///< voro++, and meshToVolume of each cell
  double cut_ms = 0.0;      ///< csgIntersectionCopy of each
  double mesh_ms = 0.0;     ///< volumeToMesh of each
  size_t pieces = 0;

  double total_ms() const { return extract_ms + carve_ms + cells_ms + cut_ms + mesh_ms; }
};

struct MergeTimes {
  double volume_ms = 0.0;  ///< meshToVolume of each posed piece
  double unite_ms = 0.0;   ///< csgUnion of each
  size_t pieces = 0;

  double total_ms() const { return volume_ms + unite_ms; }
};

class StockTerrain {
 public:
  /// A level set with the field's distances in that box.
  StockTerrain(const Field& field, const VoxelBox& box);
  ~StockTerrain();

  /// Carves a ball and breaks it into the Voronoi cells of the seeds (metres). The pieces wait for `merge`;
  /// the terrain stays carved.
  BreakTimes carve(glm::vec3 centre_m, float radius_m, const std::vector<glm::vec3>& seeds_m);

  /// Puts the pieces of the last carve at these poses, one each as far as there are any; a pose turns about
  /// the carve's centre and moves it to its position.
  MergeTimes merge(const std::vector<Pose>& poses);

 private:
  struct Grids;
  std::unique_ptr<Grids> grids_;
};

}  // namespace scree::peers
