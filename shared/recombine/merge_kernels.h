// Loops over the voxels of a merge's patch (merge_patch.h), which compilers make vectors of. Arrays must not
// overlap. `count` is in whole vectors; steps are those to the next voxel along x and y. Private to this
// folder.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shared/field/brick.h"
#include "shared/field/coord.h"

namespace scree::merge_kernels {

/// Edges and clefts give way by an eighth of the sum of the six differences at the most: 2^-8 a shift.
constexpr int curvature_bits = 8;
constexpr int curvature_max = 1016;

/// A voxel farther than this from the piece's surface has no part in its edges or clefts.
constexpr int near_surface = 64;

/// The longest vectors of a clone. Loops take whole ones: the rest would be done voxel by voxel, and a window
/// is some fifty vectors.
constexpr size_t vector_bytes = 32;

constexpr size_t whole_vectors(size_t bytes) {
  return (bytes + vector_bytes - 1) / vector_bytes * vector_bytes;
}

/// Negative where a neighbour lies on the other side.
inline int8_t crossing_signs(const Code* c, ptrdiff_t step_x, ptrdiff_t step_y) {
  const int8_t own = c[0];
  return static_cast<int8_t>((own ^ c[-1]) | (own ^ c[1]) | (own ^ c[-step_y]) | (own ^ c[step_y]) |
                             (own ^ c[-step_x]) | (own ^ c[step_x]));
}

inline int16_t bend(const Code* c, ptrdiff_t step_x, ptrdiff_t step_y) {
  return static_cast<int16_t>(c[-1] + c[1] + c[-step_y] + c[step_y] + c[-step_x] + c[step_x] - 6 * c[0]);
}

struct Amounts {
  int16_t curved;
  int16_t uniform;  ///< codes
};

void unite(size_t count, const Code* terrain, const Code* piece, Code* united, uint8_t* touched);

/// Outside voxels next to changed ones that lie in a gap of less than a voxel, between rock on both
/// sides along an axis, become rock, just inside. Width of the gap: h / (h − low) + h / (h − high) < 1, which
/// is h² < low · high.
void fill_gaps(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* c, const uint8_t* touched,
               Code* out);

/// How much the piece's edges stand out, and the union's clefts lie back, near the surface.
void find_bends(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* piece, const Code* united,
                const uint8_t* touched, int16_t* convex, int16_t* concave);

/// Clefts filled and the piece grown.
void grow(size_t count, Amounts by, const Code* united, const Code* piece, const int16_t* concave, Code* out);

/// Edges rounded and the piece shrunk, where it changed the terrain.
void shrink(size_t count, Amounts by, const Code* united, const Code* terrain, const int16_t* convex,
            const uint8_t* touched, Code* out);

/// Fills voxels just outside, near the piece, that lie between rock along two axes or all three: the rest of
/// a seam.
void fill_pits(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* c, const uint8_t* core,
               Code* out);

/// Σ occupancy as it will be once redistanced, of the inner voxels: one that touches no zero crossing will be
/// full, or empty.
int settled_sum(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* c, const uint8_t* inner);

/// The same of voxels that have pores (MergeFills), as mass.
int settled_mass(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* c, const Code* terrain,
                 const uint8_t* were, const uint8_t* brought, const uint8_t* inner);

/// Σ mass of the inner voxels, of these fills.
int filled_sum(size_t count, const Code* codes, const uint8_t* fills, const uint8_t* inner);

/// All ones for core voxels near the piece that touch a zero crossing, else 0.
void find_surface(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* c, const Code* piece,
                  const uint8_t* core, uint8_t* surface);

int count_marks(size_t count, const uint8_t* marks);

/// Σ occupancy of the inner voxels.
int inner_sum(size_t count, const Code* codes, const uint8_t* inner);

/// All ones for every voxel but those of the outermost layers. The mask holds zeros.
void mark_inner(const VoxelCoord& size, int layers, uint8_t* mask);

}  // namespace scree::merge_kernels
