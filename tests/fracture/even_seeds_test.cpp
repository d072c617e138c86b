// Evenly spaced seeds, and voro++'s cells as the reference of all cutters.
#include "server/fracture/even_seeds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <voro++/voro++.hh>

#include "shared/field/edit.h"
#include "shared/fracture/cutter.h"
#include "shared/fracture/seeds.h"
#include "shared/operation/operation.h"

namespace scree {
namespace {

/// Deviation of the pieces' masses over their mean.
double spread_of(const Shape& shape, SeedPattern pattern, uint32_t seeds, uint32_t random_seed) {
  MapField field({TerrainKind::noise, 1, 0.25F});
  CarveOperation carve{.shape = shape, .pattern = pattern, .seeds = seeds, .random_seed = random_seed};
  carve.impact_m = centre_of(shape);
  if (is_relaxed(pattern)) {
    for (const glm::vec3& seed : even_seeds(carved_volume(field, shape), seeds, random_seed))
      carve.authored_m.push_back(seed * 0.25F);
    EXPECT_EQ(carve.authored_m.size(), seeds) << "there is room for all";
  }
  PieceTable pieces;
  const Applied applied = apply(carve, field, pieces);
  EXPECT_EQ(applied.created.size(), seeds);
  double sum = 0.0, squares = 0.0;
  for (const auto& [id, volume] : pieces) {
    sum += static_cast<double>(volume->mass);
    squares += static_cast<double>(volume->mass) * static_cast<double>(volume->mass);
  }
  const double mean = sum / static_cast<double>(pieces.size());
  return std::sqrt(squares / static_cast<double>(pieces.size()) - mean * mean) / mean;
}

TEST(even_seeds, pieces_are_of_like_size) {
  const float ground_m = ground_height_m({TerrainKind::noise, 1, 0.25F}, 3.0F, 3.0F);
  for (const uint32_t seeds : {24U, 64U, 160U})
    for (const Shape& shape : {sphere({3.0F, ground_m - 1.0F, 3.0F}, 3.0F),
                               box({3.0F, ground_m - 3.0F, 3.0F}, {5.0F, 2.0F, 3.0F})}) {
      const double even = spread_of(shape, SeedPattern::even, seeds, seeds);
      const double uniform = spread_of(shape, SeedPattern::uniform, seeds, seeds);
      EXPECT_LE(even, 0.25) << seeds;
      EXPECT_LT(even, 0.7 * uniform) << seeds;
    }
}

TEST(even_seeds, there_are_fewer_where_there_is_no_room_and_none_in_the_air) {
  Window volume({{0, 0, 0}, {6, 6, 6}});
  EXPECT_TRUE(even_seeds(volume, 8, 1).empty());
  volume.at(2, 3, 4) = code_solid;
  const std::vector<glm::vec3> one = even_seeds(volume, 8, 1);
  ASSERT_FALSE(one.empty());
  for (const glm::vec3& seed : one)
    EXPECT_LE(glm::distance(seed, glm::vec3(2.0F, 3.0F, 4.0F)), 0.5F * std::sqrt(3.0F)) << "in the voxel";
}

TEST(even_seeds, lie_in_solid_voxels_though_the_cells_are_hollow) {
  Window shell({{-12, -12, -12}, {13, 13, 13}});
  for (int x = -12; x < 13; ++x)
    for (int y = -12; y < 13; ++y)
      for (int z = -12; z < 13; ++z)
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) >= 11) shell.at(x, y, z) = code_solid;
  const std::vector<glm::vec3> seeds = even_seeds(shell, 6, 3);
  ASSERT_EQ(seeds.size(), 6U);
  EXPECT_EQ(authored_seeds(shell, seeds, 1).size(), 6U);
}

/// Volumes (voxels) of the cells of these seeds in a box.
std::vector<double> reference_volumes(const std::vector<glm::vec3>& seeds, glm::dvec3 lo, glm::dvec3 hi) {
  voro::container container(lo.x, hi.x, lo.y, hi.y, lo.z, hi.z, 3, 3, 3, false, false, false, 8);
  for (size_t i = 0; i < seeds.size(); ++i)
    container.put(static_cast<int>(i), static_cast<double>(seeds[i].x), static_cast<double>(seeds[i].y),
                  static_cast<double>(seeds[i].z));
  std::vector<double> volumes(seeds.size());
  voro::c_loop_all loop(container);
  voro::voronoicell cell;
  if (loop.start()) do
      if (container.compute_cell(cell, loop)) volumes[static_cast<size_t>(loop.pid())] = cell.volume();
    while (loop.inc());
  return volumes;
}

TEST(cutters, cells_have_the_volumes_that_voropp_gives_them) {
  const Shape block = box({0.25F, 0.5F, -0.25F}, {12.0F, 9.5F, 11.0F});
  const Window solid = codes_of(block, band_box(block));
  const Window before(solid.box, code_solid);
  Window after = before;
  carve(after, solid);
  const Window volume = extract(before, solid);
  std::vector<glm::vec3> seeds = scatter_seeds(volume, SeedPattern::uniform, 24, 5, glm::vec3(0.0F));
  std::erase_if(seeds,
                [&](glm::vec3 seed) { return distance(block, seed) > -0.5F; });  // the box is the container
  const glm::dvec3 centre(0.25, 0.5, -0.25), half(12.0, 9.5, 11.0);
  const std::vector<double> reference = reference_volumes(seeds, centre - half, centre + half);
  for (const Cutter cutter : all_kinds<Cutter>) {
    const Cut cut = cut_volume(cutter, volume, before, after, seeds);
    ASSERT_GT(cut.pieces.size(), 15U) << name_of(cutter);
    for (const CutPiece& piece : cut.pieces) {
      double expected = 0.0;
      for (const uint32_t seed : piece.seeds) expected += reference[seed];
      const double cut_voxels = static_cast<double>(piece.volume.mass) / units_per_voxel;
      EXPECT_NEAR(cut_voxels, expected, 2.0 + 0.03 * expected) << name_of(cutter) << " " << piece.seeds[0];
    }
  }
}

}  // namespace
}  // namespace scree
