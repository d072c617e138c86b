// Sizes of fragments, at once and in stages, and what a blast depends on.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>

#include "bench/support/scenes.h"
#include "bench/support/size_law.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"

namespace scree {
namespace {

struct Fragments {
  std::map<PieceId, std::shared_ptr<const Volume>> pieces;
  MassUnits dust = 0;

  double near_over_far(glm::vec3 impact_m) const {
    std::vector<const Volume*> volumes;
    for (const auto& [id, volume] : pieces) volumes.push_back(volume.get());
    return scree::near_over_far(volumes, impact_m / flat_terrain.voxel_size_m);
  }
  SizeLaw law() const {
    std::vector<double> masses;
    for (const auto& [id, volume] : pieces) masses.push_back(static_cast<double>(volume->mass));
    return size_law_of(masses, static_cast<double>(dust));
  }
};

CarveRequest blow(SeedPattern pattern, float radius_m, uint32_t seeds, uint32_t random_seed) {
  CarveRequest carve = blow_at(flat_terrain, 0.0F, 0.0F, radius_m, seeds, random_seed);
  carve.pattern = pattern;
  carve.blast_speed_m_s = 0.0F;
  return carve;
}

Fragments at_once(const CarveRequest& carve) {
  MapField field(flat_terrain);
  Fragments made;
  made.dust =
      apply(CarveOperation{carve.shape, carve.pattern, carve.seeds, carve.random_seed, carve.impact_m, 1},
            field, made.pieces)
          .dust;
  return made;
}

/// Until nothing waits for its cut; `stages`: the ticks in which something was cut.
Fragments in_stages(const CarveRequest& carve, int& stages) {
  WorldConfig config = flat_world();
  config.methods.recombine = Recombination::off;
  config.methods.impacts = false;
  World world(config);
  Fragments made;
  auto delta = world.step({{{1, 1, carve}}});
  stages = 0;
  for (int tick = 0; tick < 600; ++tick) {
    stages += delta->spawned.empty() ? 0 : 1;
    for (const SpawnedPiece& piece : delta->spawned) made.pieces[piece.id] = piece.volume;
    for (const AppliedOperation& applied : delta->operations)
      for (const PieceId id : pieces_ended_by(applied.operation)) made.pieces.erase(id);
    made.dust = delta->ledger.dust;
    EXPECT_EQ(delta->ledger.error(), 0);
    if (delta->work.refractures_put_off == 0) break;
    delta = world.step({});
  }
  return made;
}

TEST(sizes, natural_pieces_follow_the_law_of_blasted_rock_and_others_do_not) {
  for (const float radius_m : {2.0F, 3.0F})
    for (const uint32_t seeds : {30U, 100U, 200U}) {
      SCOPED_TRACE(testing::Message() << radius_m << " m, " << seeds << " seeds");
      double n = 0.0, ratio = 0.0, fines = 0.0, of_radial = 0.0;
      constexpr uint32_t blows = 8;
      for (uint32_t i = 1; i <= blows; ++i) {
        const Fragments made = at_once(blow(SeedPattern::natural, radius_m, seeds, i));
        EXPECT_LE(made.pieces.size(), seeds);
        n += made.law().n / blows;
        ratio += made.law().d90_over_d10 / blows;
        fines += made.law().fines / blows;
        of_radial += at_once(blow(SeedPattern::radial, radius_m, seeds, i)).law().n / blows;
      }
      EXPECT_GE(n, 0.8);
      EXPECT_LE(n, 2.2);
      EXPECT_GT(ratio, 2.8);
      EXPECT_GT(fines, 0.02);
      EXPECT_LT(fines, 0.08);
      EXPECT_GT(of_radial, 4.0) << "the test tells nothing";
    }
}

TEST(sizes, the_law_and_the_gradient_stay_when_a_carve_is_cut_in_stages) {
  constexpr uint32_t blows = 16;
  double radial = 0.0, radial_staged = 0.0, n = 0.0, natural_staged = 0.0;
  for (uint32_t i = 1; i <= blows; ++i) {
    int stages = 0;
    CarveRequest carve = blow(SeedPattern::radial, 3.0F, 200, i);
    radial += at_once(carve).near_over_far(carve.impact_m) / blows;
    radial_staged += in_stages(carve, stages).near_over_far(carve.impact_m) / blows;
    EXPECT_GT(stages, 1);
    carve = blow(SeedPattern::natural, 4.0F, 400, i);
    const Fragments made = in_stages(carve, stages);
    EXPECT_GT(stages, 1);
    n += made.law().n / blows;
    natural_staged += made.near_over_far(carve.impact_m) / blows;
    EXPECT_LT(made.law().fines, 0.08);
  }
  EXPECT_NEAR(radial_staged / radial, 1.0, 0.2) << radial << " at once, " << radial_staged << " in stages";
  EXPECT_GE(n, 0.8);
  EXPECT_LE(n, 2.2);
  EXPECT_LT(natural_staged, 0.8);
}

/// The mean velocity of the pieces of a blast in a block of rock, weighted alike.
glm::vec3 mean_velocity(glm::vec3 centre_m, glm::vec3 impact_m) {
  World world(rock_world());
  // A roof of 4 m, its underside 2 m above the ground.
  world.step({{{1, 1, FillRequest{box({0.0F, 4.0F, 0.0F}, {8.0F, 2.0F, 8.0F})}},
               {1, 2, FillRequest{box({-7.0F, 1.0F, 0.0F}, {1.0F, 1.5F, 8.0F})}}}});
  CarveRequest carve;
  carve.shape = sphere(centre_m, 1.2F);
  carve.impact_m = impact_m;
  carve.seeds = 20;
  const auto first = world.step({{{1, 3, carve}}});
  EXPECT_GT(first->spawned.size(), 5U);
  std::map<PieceId, glm::vec3> born_m;
  for (const SpawnedPiece& piece : first->spawned)
    born_m[piece.id] = piece.volume->centre_voxels * flat_terrain.voxel_size_m;
  glm::vec3 sum(0.0F);
  for (const PieceState& piece : first->pieces) {
    const auto found = born_m.find(piece.id);
    if (found != born_m.end()) sum += dequantise(piece.pose).position_m - found->second;
  }
  return sum / static_cast<float>(born_m.size());
}

TEST(sizes, a_blast_pushes_to_the_open_side) {
  // Impacts in the middle of the shapes: no direction of their own.
  const glm::vec3 under_the_roof(2.0F, 2.5F, 0.0F), on_the_roof(2.0F, 5.5F, 0.0F),
      at_the_side(8.0F, 4.0F, 0.0F);
  EXPECT_LT(mean_velocity(under_the_roof, under_the_roof).y, 0.0F);
  EXPECT_GT(mean_velocity(on_the_roof, on_the_roof).y, 0.0F);
  const glm::vec3 sideways = mean_velocity(at_the_side, at_the_side);
  EXPECT_GT(sideways.x, 0.0F);
  EXPECT_GT(sideways.x, std::abs(sideways.y));
}

TEST(sizes, a_blow_far_away_changes_nothing_of_a_blast) {
  const auto poses = [](bool with_another) {
    World world(flat_world());
    CarveRequest far = blow_at(flat_terrain, 60.0F, 0.0F, 2.0F, 24, 5);
    const CarveRequest near = blow_at(flat_terrain, 0.0F, 0.0F, 2.0F, 32, 7);
    std::vector<Command> commands;
    if (with_another) commands.push_back({1, 1, far});
    commands.push_back({1, 2, near});
    auto delta = world.step(commands);
    for (int tick = 0; tick < 20; ++tick) delta = world.step({});
    std::vector<std::pair<std::array<int32_t, 3>, uint32_t>> found;
    for (const PieceState& piece : delta->pieces)
      if (dequantise(piece.pose).position_m.x < 30.0F)
        found.push_back({{piece.pose.x, piece.pose.y, piece.pose.z}, piece.pose.rotation});
    std::ranges::sort(found);
    return found;
  };
  const auto alone = poses(false);
  EXPECT_GT(alone.size(), 10U);
  EXPECT_EQ(alone, poses(true));
}

}  // namespace
}  // namespace scree
