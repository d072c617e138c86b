// A world of voxels of 0.1 m: edits reach less far than elsewhere, and each request that does not fit is told
// so.
#include <gtest/gtest.h>

#include "shared/base/limits.h"
#include "shared/field/field.h"
#include "shared/operation/blast.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

WorldConfig fine_world() {
  WorldConfig config = rock_world();
  config.terrain.voxel_size_m = limits::voxel_size_min_m;
  return config;
}

/// The requests with a shape, each with this one.
std::vector<Request> requests_of(const Shape& shape) {
  return {CarveRequest{.shape = shape, .seeds = 4, .impact_m = shape.a},
          FillRequest{shape},
          PaintRequest{shape, material::rock},
          CutOutRequest{shape},
          DigRequest{shape},
          PlaceRequest{shape, material::rock}};
}

TEST(FineVoxels, requests_that_reach_too_far_are_told_how_far_an_edit_reaches) {
  PropWorld world(fine_world());
  for (const Request& request : requests_of(sphere({0.0F, 0.0F, 0.0F}, 5.5F)))
    EXPECT_NE(world.ask(request).refusal.find("may be at most 5.4 m in voxels of 0.1 m"), std::string::npos)
        << request.index() << ": " << world.last().replies.front().refusal;
  for (const Request& request : requests_of(sphere({0.0F, 0.0F, 0.0F}, 2.0F))) {
    const std::string refusal = world.ask(request).refusal;
    EXPECT_EQ(refusal.find("may be at most"), std::string::npos) << request.index() << ": " << refusal;
  }
}

TEST(FineVoxels, the_strongest_blast_breaks_as_far_as_an_edit_reaches) {
  WorldConfig config = fine_world();
  PropWorld world(config);
  world.step();
  EXPECT_EQ(world.ask(BlastRequest{{0.0F, 0.0F, 0.0F}, blast_energy_max_j, 1}).refusal, "");
  const auto solid = [&](float y_m) {
    return sample(world.world().field(), glm::vec3(0.0F, y_m / config.terrain.voxel_size_m, 0.0F))
               .distance_voxels < 0.0F;
  };
  EXPECT_FALSE(solid(-5.2F));
  EXPECT_TRUE(solid(-5.6F));
  EXPECT_EQ(world.world().measure_terrain(), world.last().ledger.terrain);
}

}  // namespace
}  // namespace scree
