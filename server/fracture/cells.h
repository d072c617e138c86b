// The corners of Voronoi cells, by voro++.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace scree {

/// Corners of each seed's cell within the box (any one unit), in the order of the seeds. Empty where there is
/// none: of a seed outside the box, one that coincides with an earlier seed, or a cell that voro++ dropped.
std::vector<std::vector<glm::vec3>> cell_corners(const std::vector<glm::vec3>& seeds, glm::vec3 box_lo,
                                                 glm::vec3 box_hi);

}  // namespace scree
