// Convex hulls, masses and inertias of freshly cut pieces, for the rigid bodies.
//
// A hull is the convex hull of points of the volume's own surface, whatever cutter made the piece; which, the
// simplifier says (simplify.h). One too thin to collide becomes a cube of the piece's mass.
// Deterministic; metres, kilograms.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "server/fracture/simplify.h"
#include "shared/operation/operation.h"

namespace scree {

struct PieceHull {
  PieceId id = 0;
  std::vector<glm::vec3> corners_m;  ///< relative to the centre of mass, in the volume's axes; at least 4
  glm::vec3 inertia_m2{0.0F};        ///< diagonal, about the volume's axes, of a mass of 1 kg
  float size_m3 = 0.0F;              ///< mass / density: Volume::mass in cubic metres of full voxels
};

/// Most corners of one hull by Simplifier::hull: GJK's cost grows with them, and 20 already follow a cell
/// well.
inline constexpr int hull_corners_max = 20;

/// Of each of applied.created, in the same order. Every one must be in `pieces`.
std::vector<PieceHull> make_hulls(const Applied& applied, const PieceTable& pieces, float voxel_size_m,
                                  Simplifier simplifier = Simplifier::hull);

/// Convex parts of a volume that is concave, block by block of one side: at most `count_max`, each with
/// corners as PieceHull's. Blocks that hold next to nothing are left out.
std::vector<std::vector<glm::vec3>> convex_parts(const Volume& volume, float voxel_size_m, size_t count_max);

/// Points of the volume's own surface, at most `count_max`, spread over all of it: with these a concave piece
/// touches the ground. Metres, relative to the centre of mass.
std::vector<glm::vec3> surface_samples(const Volume& volume, float voxel_size_m, size_t count_max);

PieceHull make_hull(PieceId id, const Volume& volume, float voxel_size_m,
                    Simplifier simplifier = Simplifier::hull);

}  // namespace scree
