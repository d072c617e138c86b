// Merging by facets: stones keep their faces and edges.
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "shared/field/edit.h"
#include "shared/field/voxel_vector.h"
#include "shared/operation/operation.h"
#include "shared/recombine/posed_piece.h"
#include "shared/recombine/stamp_method.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

/// A block of those half extents, voxels, with its middle at the origin.
Volume stone(glm::vec3 half) {
  Volume volume;
  const Shape shape = box(glm::vec3(0.0F), half);
  volume.window = codes_of(shape, band_box(shape));
  volume.mass = mass_of(volume.window);
  return volume;
}

QuantisedPose turned(glm::vec3 position_m, Random& random) {
  QuantisedPose pose = quantise({position_m, {1.0F, 0.0F, 0.0F, 0.0F}});
  pose.rotation = random.next();
  return pose;
}

/// RMS of how far codes near the surface of a posed block are off its exact distances inside, voxels; and the
/// same within one voxel of its edges alone. Outside, distances to edges are round.
struct Off {
  double sum = 0.0, edges = 0.0;
  int count = 0, at_edges = 0;

  void add(const Window& codes, glm::vec3 half, const QuantisedPose& quantised) {
    const Pose pose = dequantise(quantised);
    size_t i = 0;
    for (int x = codes.box.lo.x; x < codes.box.hi.x; ++x)
      for (int y = codes.box.lo.y; y < codes.box.hi.y; ++y)
        for (int z = codes.box.lo.z; z < codes.box.hi.z; ++z, ++i) {
          const glm::vec3 off = as_vector({x, y, z}) - pose.position_m / voxel_m;
          const glm::vec3 q = glm::abs(glm::conjugate(pose.rotation) * off) - half;
          const float exact = std::max(q.x, std::max(q.y, q.z));
          if (exact > 0.0F || exact < -1.0F) continue;
          const double error = static_cast<double>(decode(codes.codes[i]) - exact);
          sum += error * error;
          ++count;
          const int near = (q.x > -1.0F ? 1 : 0) + (q.y > -1.0F ? 1 : 0) + (q.z > -1.0F ? 1 : 0);
          if (near < 2) continue;
          edges += error * error;
          ++at_edges;
        }
  }
  double rms() const { return std::sqrt(sum / count); }
  double edge_rms() const { return std::sqrt(edges / at_edges); }
};

TEST(facets, a_block_that_is_read_by_planes_has_its_faces_up_to_the_edges) {
  Random random(5);
  Off by_codes, by_planes;
  for (int turn = 0; turn < 40; ++turn) {
    const glm::vec3 half = glm::vec3(1.6F, 2.1F, 2.7F) + random.unit();
    const Volume volume = stone(half);
    const QuantisedPose pose = turned({random.unit(), random.unit(), random.unit()}, random);
    const VoxelBox bounds = posed_bounds(volume, pose, voxel_m);
    by_codes.add(posed_codes(volume, pose, voxel_m, bounds), half, pose);
    by_planes.add(posed_codes(volume, pose, voxel_m, bounds, Reading::planes), half, pose);
  }
  EXPECT_LT(by_planes.rms(), 0.5 * by_codes.rms()) << by_codes.rms();
  EXPECT_LT(by_planes.edge_rms(), 0.5 * by_codes.edge_rms()) << by_codes.edge_rms();
  EXPECT_LT(by_planes.rms(), 0.08);
}

TEST(facets, what_is_read_by_planes_lies_within_the_bounds_of_what_is_near) {
  MapField field({TerrainKind::noise, 3, voxel_m});
  PieceTable pieces;
  const glm::vec3 centre(0.0F, ground_height_m(field.source(), 0.0F, 0.0F) - 0.8F, 0.0F);
  apply(CarveOperation{crater(centre, 2.0F), SeedPattern::radial, 60, 7, centre, 1}, field, pieces);
  Random random(9);
  for (const auto& [id, volume] : pieces) {
    const QuantisedPose pose = turned({3.0F, 4.0F, 5.0F}, random);
    const VoxelBox bounds = posed_bounds(*volume, pose, voxel_m);
    const Window wide = posed_codes(*volume, pose, voxel_m, bounds.grown(3), Reading::planes);
    const VoxelBox near = near_box(wide);
    EXPECT_TRUE(near.empty() || bounds.covers(near)) << "piece " << id;
  }
}

/// As the merged terrain has it.
TEST(facets, a_merged_block_keeps_more_of_its_edges_than_by_the_stamp_and_weighs_the_same) {
  Random random(17);
  Off merged[2];
  for (int turn = 0; turn < 30; ++turn) {
    const glm::vec3 half = glm::vec3(2.0F, 2.4F, 3.0F) + 0.5F * random.unit();
    const QuantisedPose pose = turned({0.1F, 2.0F, 0.3F}, random);
    for (const StampMethod method : {StampMethod::stamp, StampMethod::facets}) {
      MapField field(flat_terrain);
      const auto block = std::make_shared<const Volume>(stone(half));
      PieceTable pieces{{1, block}};
      const Volume& volume = *block;  // which apply() takes out of the table
      const Window before = gather(field, stamp_box(method, volume, pose, voxel_m));
      const StampPlan plan = plan_stamp(method, before, volume, pose, voxel_m, volume.mass);
      const Applied applied = apply(StampOperation{1, pose, plan.shift, method}, field, pieces);
      EXPECT_EQ(applied.terrain_gain, plan.gain);
      EXPECT_LE(std::abs(applied.terrain_gain - volume.mass) * 1000, volume.mass);
      merged[method == StampMethod::facets ? 1 : 0].add(gather(field, before.box), half, pose);
    }
  }
  EXPECT_LT(merged[1].edge_rms(), 0.75 * merged[0].edge_rms());
  EXPECT_LT(merged[1].rms(), merged[0].rms());
}

}  // namespace
}  // namespace scree
