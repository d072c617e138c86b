// The sizes of fragments: how well they follow Rosin and Rammler's law (shared/fracture/natural_cut.h).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "shared/field/piece.h"

namespace scree {

/// By mass over the diameter of the ball of the same mass. Dust passes below all pieces.
struct SizeLaw {
  double n = 0.0;  ///< slope of ln(−ln(1 − P)) over ln d, by least squares over the pieces
  double d90_over_d10 = 0.0;
  double fines = 0.0;         ///< the dust's share of all mass
  double fines_by_law = 0.0;  ///< the share that the fit has below the smallest piece
};

/// Masses of at least three pieces that differ, and of the dust that they left.
SizeLaw size_law_of(std::vector<double> masses, double dust);

/// Means of the third of the pieces that is nearest to a place (voxels), and of the farthest: the ratio of
/// their volumes. At least three pieces.
double near_over_far(const std::vector<const Volume*>& pieces, glm::vec3 place_voxels);

}  // namespace scree
