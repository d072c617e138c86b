#include "shared/fracture/shatter.h"

#include "shared/base/check.h"

namespace scree {

Cut shatter(Cutter cutter, const Volume& piece, const std::vector<glm::vec3>& seeds_voxels) {
  const Window nothing(piece.window.box);
  Cut cut = cut_volume(cutter, piece.window, piece.window, nothing, seeds_voxels);
  MassUnits cells = 0;
  for (const CutPiece& child : cut.pieces) cells += child.volume.mass;
  CHECK(cut.pieces.empty() || cells > 0);
  // Each share is the difference of two cumulative ones, in the order of the pieces, so no unit is left over.
  // The products stay below 2^60: a window has at most 128³ voxels of 254 units.
  MassUnits before = 0, given = 0;
  for (CutPiece& child : cut.pieces) {
    before += child.volume.mass;
    const MassUnits due = piece.mass * before / cells;
    child.volume.mass = due - given;
    given = due;
  }
  cut.dust = piece.mass - given;
  return cut;
}

}  // namespace scree
