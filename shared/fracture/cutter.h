// The cutters: the methods that cut a volume into pieces along the Voronoi cells of seeds (paper,
// section 2.3; cell of seed i = intersection of the half-spaces nearer to i than to j). Each is a row of one
// table and a file of its own. A cutter decides bits, so it is part of the operation. Voxels; deterministic.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "shared/base/check.h"
#include "shared/base/kind_table.h"
#include "shared/base/limits.h"
#include "shared/field/piece.h"

namespace scree {

/// A piece, and the indices of the seeds whose cells it consists of: one, or several where cells were too
/// small to stand alone and joined their largest neighbour.
struct CutPiece {
  Volume volume;
  std::vector<uint32_t> seeds;
};

struct Cut {
  std::vector<CutPiece> pieces;  ///< in the order of their first seeds
  MassUnits dust = 0;            ///< mass of a volume too small for any piece
  /// Where the cutter knows it: the mass that each voxel lost (units), the cell nearest to it, and the piece
  /// of each cell. Else empty.
  std::vector<uint8_t> lost{};
  std::vector<uint16_t> cell_of_voxel{};
  std::vector<uint16_t> piece_of_cell{};
};

/// Cuts `volume`. The cutter shares out the mass that was lost at each voxel (units, in the window's order),
/// so that Σ piece mass + dust is exactly its sum.
using CutFunction = Cut(const Window& volume, std::vector<uint8_t> lost,
                        const std::vector<glm::vec3>& seeds_voxels);

/// The cutter `field` works on codes, without any mesh (field_cutter.cpp). It shares the mass out by nearest
/// seed.
CutFunction cut_by_field;
/// The cutter `slice` is the paper's: each cell's planes cut the surface as polygons, and caps close the
/// holes (slice_cutter.h). This one and the next share the mass out in proportion to the volumes of the
/// parts.
CutFunction cut_by_slices;
/// The cutter `conform` bounds the cells by the shape itself (conform_cutter.h).
CutFunction cut_by_conforming;

enum class Cutter : uint8_t { field = 0, slice = 1, conform = 2 };

/// The model's price, microseconds (shared/operation/limits.h): of a volume, of a voxel of its window, and of
/// a piece with its hull and body.
struct CutPrice {
  float volume_us = 0.0F;
  float voxel_us = 0.0F;
  float piece_us = 0.0F;
};

struct CutterRow {
  std::string_view name;
  CutPrice price;
  CutFunction* cut = nullptr;
};

constexpr CutterRow row_of(Cutter cutter) {
  constexpr CutPrice of_codes{.volume_us = 100.0F, .voxel_us = 0.04F, .piece_us = 25.0F};
  constexpr CutPrice of_polygons{.volume_us = 3500.0F, .voxel_us = 0.5F, .piece_us = 200.0F};
  switch (cutter) {
    case Cutter::field:
      return {.name = "field", .price = of_codes, .cut = cut_by_field};
    case Cutter::slice:
      return {.name = "slice", .price = of_polygons, .cut = cut_by_slices};
    case Cutter::conform:
      return {.name = "conform", .price = of_polygons, .cut = cut_by_conforming};
  }
  return {};
}

/// The cutter for volumes that are too large for the chosen one, and for what a client predicts.
inline constexpr Cutter cheapest_cutter = Cutter::field;

inline Cut cut_volume(Cutter cutter, const Window& volume, std::vector<uint8_t> lost,
                      const std::vector<glm::vec3>& seeds_voxels) {
  CHECK(lost.size() == volume.codes.size() && seeds_voxels.size() <= limits::seeds_max);
  return traits_of(cutter).cut(volume, std::move(lost), seeds_voxels);
}
/// Cuts `volume` (= before ∩ shape), all of which is without pores. All three windows have the same box.
inline Cut cut_volume(Cutter cutter, const Window& volume, const Window& before, const Window& after,
                      const std::vector<glm::vec3>& seeds_voxels) {
  CHECK(volume.box == before.box && volume.box == after.box);
  CHECK_DEBUG(std::ranges::equal(before.codes, after.codes, std::ranges::less_equal()));
  return cut_volume(cutter, volume, mass_changes(before.codes, after.codes), seeds_voxels);
}

}  // namespace scree
