// Convex hulls, masses and inertias of freshly cut pieces, for the rigid bodies.
//
// A hull is the convex hull of points of the volume's own surface; the simplifier chooses them (simplify.h).
// Where they are too thin to collide, the hull is a cube of the piece's mass. The cutter makes no difference.
// Deterministic; metres, kilograms.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "server/fracture/simplify.h"
#include "shared/material/palette.h"
#include "shared/operation/operation.h"

namespace scree {

struct PieceHull {
  PieceId id = 0;
  std::vector<glm::vec3> corners_m;  ///< relative to the volume's centre, in the volume's axes; at least 4
  glm::mat3 inertia_m2{0.0F};        ///< tensor in the volume's axes, of a mass of 1 kg; positive definite
  float size_m3 = 0.0F;  ///< mass / density: Volume::mass in cubic metres of full voxels; positive
};

/// Hulls of applied.created, in the same order. `pieces` must hold every created piece.
std::vector<PieceHull> make_hulls(const Applied& applied, const PieceTable& pieces, float voxel_size_m,
                                  Simplifier simplifier = Simplifier::hull);

/// Convex parts of a concave volume: one for each block of a grid of cubes, at most `count_max`, which is
/// positive. Corners as in PieceHull. Blocks whose part is too thin to collide have none.
std::vector<std::vector<glm::vec3>> convex_parts(const Volume& volume, float voxel_size_m, size_t count_max);

/// Points spread over the volume's own surface, at most `count_max`, which is positive: a concave piece
/// collides with the ground by these. Metres, relative to the centre of mass.
std::vector<glm::vec3> surface_samples(const Volume& volume, float voxel_size_m, size_t count_max);

/// The mass of a volume by its materials' densities, its centre, and the tensor about that.
struct WeighedVolume {
  float mass_kg = 0.0F;
  glm::vec3 centre_m{0.0F};       ///< from the volume's centre, in its axes; 0 where it is of one material
  glm::mat3 inertia_kg_m2{0.0F};  ///< in the volume's axes
};
/// `hull` is that of the volume. Materials that the palette lacks weigh as its first.
WeighedVolume weigh(const Volume& volume, const PieceHull& hull, const Palette& palette, float voxel_size_m);

/// The volume's mass must be positive.
PieceHull make_hull(PieceId id, const Volume& volume, float voxel_size_m,
                    Simplifier simplifier = Simplifier::hull);

}  // namespace scree
