// Solids from files as the voxels of one piece (AddPieceRequest).
#pragma once

#include <string>
#include <vector>

#include "shared/field/piece.h"
#include "tools/import/files/solid_files.h"

namespace scree {

struct PlacedPiece {
  /// Its lowest voxels are at y = 0, about the origin. Its box has a layer of air.
  Volume volume;
  glm::vec3 foot_voxels{0.0F};  ///< the middle of its lowest side
  size_t voxels = 0;            ///< that are solid
  /// Sentences on materials that are none of the world's.
  std::vector<std::string> said{};
};

/// The union of the solids, which are of voxels as large as the world's. `world`: the palette that
/// `read.palette` began with; rows beyond it become the row that looks most like them, rubble excepted.
/// `otherwise`: of rock for which the files say nothing. Codes are those of the surface alone: others are
/// full or empty, which packs well. The error says which limit of a piece it is beyond.
Result<PlacedPiece> placed_piece(const SolidsRead& read, const Palette& world, Material otherwise);

/// The row of the palette whose colour is nearest to that one, by what eyes see of it; rubble is none.
Material nearest_by_colour(const std::array<float, 3>& linear, const Palette& palette);

}  // namespace scree
