// How far one surface lies from another, and the pieces and poses by which merges are measured.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "shared/operation/operation.h"

namespace scree {

/// Squares of distances in voxels², and how many.
struct SurfaceDistance {
  double squares = 0.0;
  double samples = 0.0;

  void add(double voxels) {
    squares += voxels * voxels;
    samples += 1.0;
  }
  double rms() const { return samples > 0.0 ? std::sqrt(squares / samples) : 0.0; }
};

/// Calls `visit(voxel, step, part)` where an edge of the lattice crosses the surface of the window: at
/// voxel + part · step.
template <typename Visit>
void for_each_crossing(const Window& window, const Visit& visit) {
  constexpr VoxelCoord steps[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const VoxelBox& box = window.box;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z)
        for (const VoxelCoord& step : steps) {
          const VoxelCoord next{x + step.x, y + step.y, z + step.z};
          if (!box.holds(next)) continue;
          const double a = window.at(x, y, z), b = window.at(next.x, next.y, next.z);
          if ((a < 0.0) != (b < 0.0)) visit(VoxelCoord{x, y, z}, step, a / (a - b));
        }
}

/// The distance that a window of codes has there, linear along the edge; air outside the window.
double distance_on_edge(const Window& window, VoxelCoord voxel, VoxelCoord step, double part);

/// Adds the distances of `exact` at the points where edges of the lattice cross the surface of `merged`, a
/// voxel within its box. Both have the same box.
void add_distances(const Window& merged, const Window& exact, SurfaceDistance& distance);

/// The union of terrain and pieces, as exactly as their codes tell it.
Window exact_union(Field& field, const PieceTable& pieces, const std::vector<StampedPiece>& places);

/// On the ground south of the origin, turned anyhow: as pieces come to rest. One a piece, none over another,
/// each above the ground by no more than a step. `reach_m`: none of the pieces is larger.
std::vector<Pose> resting_places(Field& field, const PieceTable& pieces, float reach_m, uint64_t random_seed);

/// The volume of the convex hull of points, by its polar dual: the intersection of the half-spaces dual to
/// the points, whose corners are the duals of the hull's faces.
double hull_volume(const std::vector<glm::vec3>& points);

}  // namespace scree
