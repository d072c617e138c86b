// Contacts of two hulls that touch face to face, or edge to face: the corners of the area in which they
// overlap. The nearest points alone are one contact a step, by which a crate rocks before it stands. Pieces
// do without: their faces seldom meet flat. Private to this folder. Metres; deterministic.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "server/bodies/hull_distance.h"

namespace scree {

struct FaceContact {
  glm::vec3 on_b{0.0F};  ///< relative to b's centre
  float distance_m = 0.0F;
};

/// `normal`: unit, from b to a, of their nearest points. `a_from_b`: a's centre relative to b's. Corners
/// count as of a face that lie within a few degrees of it. None where one of them touches with a corner, or
/// both with an edge. By clipping polygons (Sutherland and Hodgman, 1974).
std::vector<FaceContact> face_contacts(const HullCorners& a, const HullCorners& b, glm::vec3 a_from_b,
                                       glm::vec3 normal);

}  // namespace scree
