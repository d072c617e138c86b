// Hulls of freshly cut pieces: within their volumes, near to them, and with sane masses.
#include "server/fracture/hull.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "server/fracture/hull_corners.h"
#include "server/fracture/point_spread.h"
#include "shared/field/edit.h"
#include "shared/field/window_sample.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

struct Blast {
  MapField field{{TerrainKind::noise, 3, voxel_m}};
  PieceTable pieces;
  Applied applied;
  std::vector<PieceHull> hulls;

  explicit Blast(uint32_t seeds, SeedPattern pattern = SeedPattern::uniform, Cutter cutter = Cutter::field) {
    CarveOperation carve;
    carve.cutter = cutter;
    const glm::vec3 at(3.0F, ground_height_m(field.source(), 3.0F, 3.0F) - 0.5F, 3.0F);
    carve.shape = sphere(at, 2.0F);
    carve.pattern = pattern;
    carve.seeds = seeds;
    carve.impact_m = at;
    carve.first_piece = 10;
    applied = apply(carve, field, pieces);
    hulls = make_hulls(applied, pieces, voxel_m);
  }
};

TEST(Hull, every_piece_gets_one_in_order) {
  const Blast blast(64);
  ASSERT_EQ(blast.hulls.size(), blast.applied.created.size());
  for (size_t i = 0; i < blast.hulls.size(); ++i) {
    EXPECT_EQ(blast.hulls[i].id, blast.applied.created[i].id);
    EXPECT_GE(blast.hulls[i].corners_m.size(), 4U);
    EXPECT_LE(blast.hulls[i].corners_m.size(), static_cast<size_t>(hull_corners_max));
  }
}

TEST(Hull, corners_lie_on_or_in_the_volume) {
  const Blast blast(64, SeedPattern::radial);
  for (const PieceHull& hull : blast.hulls) {
    const Volume& volume = *blast.pieces.at(hull.id);
    if (volume.mass < 8 * units_per_voxel) continue;  // splinters fall back to a cube
    for (const glm::vec3& corner : hull.corners_m) {
      const glm::vec3 p = corner / voxel_m + volume.centre_voxels;
      ASSERT_TRUE(covers(volume.window, p));
      EXPECT_LT(sample_covered(volume.window, p).distance_voxels, 0.3F) << "piece " << hull.id;
    }
  }
}

/// Largest |x|, |y|, |z| extents of corners.
glm::vec3 extent_of(const std::vector<glm::vec3>& corners) {
  glm::vec3 lo(1e30F), hi(-1e30F);
  for (const glm::vec3& p : corners) lo = glm::min(lo, p), hi = glm::max(hi, p);
  return hi - lo;
}

TEST(Hull, of_one_seed_spans_the_whole_ball) {
  const Blast blast(1);
  ASSERT_EQ(blast.hulls.size(), 1U);
  const glm::vec3 extent = extent_of(blast.hulls[0].corners_m);
  EXPECT_GT(extent.x, 3.4F);
  EXPECT_LT(extent.x, 4.2F);
  EXPECT_GT(extent.z, 3.4F);
  EXPECT_LT(extent.z, 4.2F);
}

TEST(Hull, masses_and_inertias_are_sane) {
  const Blast blast(64);
  float size_m3 = 0.0F;
  MassUnits mass = 0;
  for (const PieceHull& hull : blast.hulls) {
    size_m3 += hull.size_m3;
    mass += blast.pieces.at(hull.id)->mass;
    EXPECT_GT(hull.size_m3, 0.0F);
    const glm::vec3 extent = extent_of(hull.corners_m) + voxel_m;
    const float most = glm::dot(extent, extent) / 4.0F;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GT(hull.inertia_m2[axis][axis], 0.0F);
      EXPECT_LT(hull.inertia_m2[axis][axis], most);
    }
    EXPECT_LE(hull.inertia_m2[0][0], hull.inertia_m2[1][1] + hull.inertia_m2[2][2]);
    EXPECT_EQ(hull.inertia_m2, glm::transpose(hull.inertia_m2));
    EXPECT_GT(glm::determinant(hull.inertia_m2), 0.0F);
  }
  EXPECT_NEAR(size_m3, static_cast<float>(mass) / units_per_voxel * voxel_m * voxel_m * voxel_m, 0.01F);
}

TEST(Hull, boxes_that_lie_on_voxels_have_the_inertia_of_boxes) {
  for (const float offset : {0.0F, 0.25F, 0.5F}) {
    const glm::vec3 half(4.0F, 6.0F, 3.0F);
    const Shape shape = box(glm::vec3(offset), half);
    Volume volume;
    volume.window = codes_of(shape, band_box(shape));
    volume.mass = mass_of(volume.window);
    volume.centre_voxels = shape.a;
    const glm::mat3 inertia = make_hull(1, volume, 1.0F).inertia_m2;
    EXPECT_NEAR(inertia[0][0], (half.y * half.y + half.z * half.z) / 3.0F, 0.03F * inertia[0][0]) << offset;
    EXPECT_NEAR(inertia[1][1], (half.x * half.x + half.z * half.z) / 3.0F, 0.03F * inertia[1][1]) << offset;
    EXPECT_NEAR(inertia[2][2], (half.x * half.x + half.y * half.y) / 3.0F, 0.03F * inertia[2][2]) << offset;
  }
}

constexpr Simplifier simplifiers[] = {Simplifier::none, Simplifier::hull, Simplifier::merge};

/// Whether they are at least four, and not all in one plane.
bool are_solid(const std::vector<glm::vec3>& corners) {
  for (size_t i = 1; i < corners.size(); ++i)
    for (size_t j = i + 1; j < corners.size(); ++j) {
      const glm::vec3 normal = glm::cross(corners[i] - corners[0], corners[j] - corners[0]);
      const float area = glm::length(normal);
      if (area < 1e-3F * voxel_m * voxel_m) continue;
      for (const glm::vec3& p : corners)
        if (std::abs(glm::dot(normal / area, p - corners[0])) > 0.05F * voxel_m) return true;
      return false;
    }
  return false;
}

TEST(Hull, every_simplifier_of_every_cutter_gives_bodies) {
  for (const Cutter cutter : {Cutter::field, Cutter::slice, Cutter::conform}) {
    const Blast blast(64, SeedPattern::radial, cutter);
    std::vector<size_t> points;
    for (const Simplifier simplifier : simplifiers) {
      const auto hulls = make_hulls(blast.applied, blast.pieces, voxel_m, simplifier);
      ASSERT_EQ(hulls.size(), blast.applied.created.size());
      points.push_back(0);
      for (const PieceHull& hull : hulls) {
        EXPECT_TRUE(are_solid(hull.corners_m));
        EXPECT_LE(hull.corners_m.size(), whole_points_max);
        points.back() += hull.corners_m.size();
      }
    }
    EXPECT_GT(points[0], 2 * points[1]) << "none keeps more than hull";
    EXPECT_GT(points[0], points[2]) << "none keeps more than merge";
  }
}

TEST(Hull, of_any_simplifier_spans_the_whole_ball) {
  const Blast blast(1);
  for (const Simplifier simplifier : simplifiers) {
    const auto hulls = make_hulls(blast.applied, blast.pieces, voxel_m, simplifier);
    const glm::vec3 extent = extent_of(hulls.at(0).corners_m);
    EXPECT_GT(extent.x, 3.2F);
    EXPECT_LT(extent.x, 4.2F);
  }
}

TEST(Simplify, points_nearer_than_a_voxel_become_one) {
  const std::vector<glm::vec3> points = {
      {0.0F, 0.0F, 0.0F}, {0.5F, 0.0F, 0.0F}, {1.2F, 0.0F, 0.0F}, {-0.2F, 0.3F, 0.0F}, {9.0F, 9.0F, 9.0F}};
  const std::vector<glm::vec3> merged = merge_near(points, 10);
  ASSERT_EQ(merged.size(), 3U);
  EXPECT_LT(glm::distance(merged[0], glm::vec3(0.1F, 0.1F, 0.0F)), 1e-5F) << "the mean of three";
  EXPECT_EQ(merged[1], points[2]);
  EXPECT_EQ(merge_near(points, 2).size(), 2U) << "a wider tolerance";
  EXPECT_EQ(spread(points, 100.0F, 10).size(), 1U + 1U) << "one each side of zero";
}

TEST(Hull, is_the_same_every_time) {
  const Blast a(64), b(64);
  ASSERT_EQ(a.hulls.size(), b.hulls.size());
  for (size_t i = 0; i < a.hulls.size(); ++i) EXPECT_EQ(a.hulls[i].corners_m, b.hulls[i].corners_m);
}

TEST(Hull, convex_parts_of_an_arch_leave_its_opening_open) {
  Volume arch;
  arch.window = Window(VoxelBox{{0, 0, 0}, {28, 22, 10}});
  const auto solid = [](int x, int y, int z) {
    const bool block = x >= 2 && x < 26 && y >= 2 && y < 20 && z >= 2 && z < 8;
    return block && !(x >= 10 && x < 18 && y < 14);
  };
  for (int x = 0; x < 28; ++x)
    for (int y = 0; y < 22; ++y)
      for (int z = 0; z < 10; ++z) {
        arch.window.codes[arch.window.index(x, y, z)] = solid(x, y, z) ? Code{-60} : Code{60};
        arch.mass += solid(x, y, z) ? units_per_voxel : 0;
      }
  arch.centre_voxels = {13.5F, 12.0F, 4.5F};
  const auto parts = convex_parts(arch, voxel_m, 64);
  EXPECT_GE(parts.size(), 6U);
  EXPECT_LE(parts.size(), 64U);
  glm::vec3 lo(1e30F), hi(-1e30F);
  for (const auto& part : parts) {
    EXPECT_GE(part.size(), 4U);
    for (const glm::vec3& corner : part) {
      const glm::vec3 p = corner / voxel_m + arch.centre_voxels;
      lo = glm::min(lo, p), hi = glm::max(hi, p);
      EXPECT_FALSE(p.x > 11.0F && p.x < 16.0F && p.y < 12.5F) << "a corner in the opening";
    }
  }
  EXPECT_NEAR(hi.x - lo.x, 24.0F, 1.0F);
  EXPECT_NEAR(hi.y - lo.y, 18.0F, 1.0F);
}

}  // namespace
}  // namespace scree
