// Voronoi cells by voro++, as polyhedra.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace scree::peers {

struct VoroCell {
  std::vector<double> corners;  ///< x, y, z of each
  std::vector<int> faces;       ///< each a count and that many corners
};

/// The cells of the seeds within a box in which they lie; any unit. Cells that voro++ does not find are left
/// out.
std::vector<VoroCell> voro_cells(glm::vec3 lo, glm::vec3 hi, const std::vector<glm::vec3>& seeds);

double volume_of(const VoroCell& cell);

}  // namespace scree::peers
