// Fracture: seeds scattered in a volume, and the volume cut along their Voronoi cells (paper, section 2.3;
// cell of seed i = intersection of the half-spaces nearer to i than to j).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "shared/base/kind_table.h"
#include "shared/field/piece.h"
#include "shared/fracture/seed_pattern.h"

namespace scree {

/// The method that cuts a volume along cells. field: works on codes, without any mesh (cut_cells). slice: the
/// paper's; the surface as polygons is cut by each cell's planes and capped (slice_cutter.h). conform: cells
/// bounded by the shape itself (conform_cutter.h).
enum class Cutter : uint8_t { field = 0, slice = 1, conform = 2 };

struct CutterRow {
  std::string_view name;
};

constexpr CutterRow row_of(Cutter cutter) {
  switch (cutter) {
    case Cutter::field:
      return {.name = "field"};
    case Cutter::slice:
      return {.name = "slice"};
    case Cutter::conform:
      return {.name = "conform"};
  }
  return {};
}

/// Up to `count` seeds (voxels) inside the volume, no two nearer than a voxel; fewer where there is no room,
/// none where the volume has no solid voxel. The pattern is one of drawn_patterns.
std::vector<glm::vec3> scatter_seeds(const Window& volume, SeedPattern pattern, uint32_t count,
                                     uint32_t random_seed, glm::vec3 impact_voxels);

/// The points (voxels) that can be seeds, in their order. A point outside the volume (its voxel is not
/// solid), or nearer than a voxel to an earlier one, is dropped, so that every seed gets a cell. When none is
/// left, one random seed is added: the volume stays whole.
std::vector<glm::vec3> authored_seeds(const Window& volume, const std::vector<glm::vec3>& points_voxels,
                                      uint32_t random_seed);

/// A piece, and the indices of the seeds whose cells it consists of: one, or several where cells were too
/// small to stand alone and joined their largest neighbour.
struct CutPiece {
  Volume volume;
  std::vector<uint32_t> seeds;
};

struct Cut {
  std::vector<CutPiece> pieces;  ///< in the order of their first seeds
  MassUnits dust = 0;            ///< mass of a volume too small for any piece
};

/// The cutter `field`: cuts `volume` (= before ∩ shape). The mass that the terrain lost, Σ occupancy(before)
/// − occupancy(after), is shared out by nearest seed, so that Σ piece mass + dust is exactly that. All three
/// windows have the same box.
Cut cut_cells(const Window& volume, const Window& before, const Window& after,
              const std::vector<glm::vec3>& seeds_voxels);

}  // namespace scree
