// Meshes of pieces: sharp, and nowhere beyond the piece.
#include "client/render/meshing/piece_mesh.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "shared/field/voxel_vector.h"
#include "shared/operation/operation.h"
#include "shared/surface/surface_nets.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

/// Between the codes of a window, in voxels.
float distance_at(const Window& window, glm::vec3 place) {
  const glm::vec3 low =
      glm::clamp(glm::floor(place), as_vector(window.box.lo), as_vector(window.box.hi - VoxelCoord{2, 2, 2}));
  const VoxelCoord cell{static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(low.z)};
  float sum = 0.0F;
  for (int i = 0; i < 8; ++i) {
    const VoxelCoord off{i >> 2, (i >> 1) & 1, i & 1}, p = cell + off;
    const glm::vec3 share = glm::mix(1.0F - (place - low), place - low, as_vector(off));
    sum += share.x * share.y * share.z * decode(window.at(p.x, p.y, p.z));
  }
  return sum;
}

TEST(PieceMesh, has_no_fins_that_the_piece_does_not_have) {
  MapField field(flat_terrain);
  PieceTable pieces;
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    const glm::vec3 at_m(8.0F * static_cast<float>(seed), 0.0F, 0.0F);
    const CarveOperation carve{crater(at_m, 1.6F), SeedPattern::natural, 40, seed, at_m, 1 + 1000 * seed};
    apply(Operation(carve), field, pieces);
  }
  ASSERT_GT(pieces.size(), 40U);
  float farthest = 0.0F;
  for (const auto& [id, volume] : pieces) {
    const PieceMesh made = mesh_piece(gather_piece(field, id, {volume, {}}));
    const Window closed = closed_window(volume->window);
    for (const SurfaceVertex& vertex : made.mesh.vertices) {
      const glm::vec3 place =
          as_vector(made.mesh.origin) +
          glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]) / surface_steps_per_voxel;
      farthest = std::max(farthest, std::abs(distance_at(closed, place)));
    }
  }
  EXPECT_LT(farthest, 0.75F) << "voxels";
}

}  // namespace
}  // namespace scree
