// Pieces that are enclosed in rock become terrain where they lie; none travels through rock.
#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "server/world/world.h"
#include "shared/field/piece.h"

namespace scree {
namespace {

constexpr int settle_ticks_max = 3600;
constexpr float travel_max_m = 1.0F;

/// Follows every piece and adds up how far each has moved while nine tenths of its voxels were deeper than
/// one voxel in rock.
class Travels {
 public:
  void look(World& world, const TickDelta& delta) {
    for (const SpawnedPiece& spawned : delta.spawned) volumes_[spawned.id] = spawned.volume;
    for (const PieceState& piece : delta.pieces) follow(world, piece);
  }
  float farthest_m() const { return farthest_m_; }

 private:
  struct Track {
    glm::vec3 last_m{0.0F};
    float buried_m = 0.0F;
  };

  void follow(World& world, const PieceState& piece) {
    const Pose pose = dequantise(piece.pose);
    const auto [found, is_new] = tracks_.try_emplace(piece.id, Track{pose.position_m, 0.0F});
    Track& track = found->second;
    const glm::vec3 moved = pose.position_m - track.last_m;
    track.last_m = pose.position_m;
    if (!is_buried(world, *volumes_.at(piece.id), pose)) {
      track.buried_m = 0.0F;
      return;
    }
    track.buried_m += std::sqrt(moved.x * moved.x + moved.y * moved.y + moved.z * moved.z);
    farthest_m_ = std::max(farthest_m_, track.buried_m);
  }

  static bool is_buried(World& world, const Volume& volume, const Pose& pose) {
    const float dx = world.config().terrain.voxel_size_m;
    const VoxelBox& box = volume.window.box;
    int solid = 0, deep = 0;
    for (int x = box.lo.x; x < box.hi.x; ++x)
      for (int y = box.lo.y; y < box.hi.y; ++y)
        for (int z = box.lo.z; z < box.hi.z; ++z) {
          if (volume.window.at(x, y, z) >= 0) continue;
          ++solid;
          const glm::vec3 at =
              pose.position_m / dx + pose.rotation * (glm::vec3(x, y, z) - volume.centre_voxels);
          if (sample(world.field(), at).distance_voxels < -1.0F) ++deep;
        }
    return solid > 0 && deep * 10 >= solid * 9;
  }

  std::map<PieceId, std::shared_ptr<const Volume>> volumes_;
  std::map<PieceId, Track> tracks_;
  float farthest_m_ = 0.0F;
};

class Buried : public ::testing::TestWithParam<TerrainColliderKind> {
 protected:
  Buried() : world_(config()) {}

  static WorldConfig config() {
    WorldConfig config;
    config.terrain = {TerrainKind::flat, 1, 0.25F};
    config.methods.collider = GetParam();
    return config;
  }

  std::shared_ptr<const TickDelta> step(std::vector<Command> commands = {}) {
    auto delta = world_.step(commands);
    travels_.look(world_, *delta);
    EXPECT_EQ(delta->ledger.error(), 0);
    for (const AppliedOperation& applied : delta->operations)
      if (std::holds_alternative<DiscardOperation>(applied.operation)) ++lost_;
    return delta;
  }
  void fill(const Shape& shape) {
    const auto delta = step({{1, ++request_, FillRequest{shape}}});
    ASSERT_EQ(delta->replies.at(0).refusal, "");
  }
  void carve(const Shape& shape, glm::vec3 impact_m, uint32_t seeds) {
    CarveRequest request;
    request.shape = shape;
    request.seeds = seeds;
    request.impact_m = impact_m;
    const auto delta = step({{1, ++request_, request}});
    ASSERT_EQ(delta->replies.at(0).refusal, "");
  }
  void expect_all_become_terrain() {
    auto delta = step();
    for (int tick = 0; tick < settle_ticks_max && !delta->pieces.empty(); ++tick) delta = step();
    EXPECT_TRUE(delta->pieces.empty()) << delta->pieces.size() << " are still alive";
    EXPECT_EQ(world_.measure_terrain(), delta->ledger.terrain);
    EXPECT_LE(travels_.farthest_m(), travel_max_m);
    EXPECT_EQ(lost_, 0) << "pieces left the world";
  }

  World world_;
  Travels travels_;
  uint32_t request_ = 0;
  int lost_ = 0;
};

TEST_P(Buried, a_block_that_falls_onto_its_rubble_leaves_no_piece_climbing_through_it) {
  fill(box({0.0F, 1.5F, 0.0F}, {1.0F, 1.5F, 1.0F}));
  fill(box({0.0F, 6.0F, 0.0F}, {4.0F, 3.0F, 4.0F}));
  carve(box({0.0F, 1.5F, 0.0F}, {1.5F, 1.4F, 1.5F}), {0.0F, 1.5F, 1.5F}, 64);
  expect_all_become_terrain();
}

TEST_P(Buried, a_ball_cut_at_its_foot_leaves_no_piece_climbing_through_it) {
  fill(capsule({0.0F, -1.0F, 0.0F}, {0.0F, 2.0F, 0.0F}, 0.8F));
  fill(sphere({0.0F, 5.0F, 0.0F}, 3.5F));
  carve(sphere({0.0F, 1.0F, 0.0F}, 1.4F), {0.0F, 1.0F, 1.0F}, 64);
  expect_all_become_terrain();
}

TEST_P(Buried, rock_poured_over_living_pieces_takes_them_in) {
  carve(sphere({0.0F, 0.0F, 0.0F}, 2.0F), {0.0F, 0.0F, 0.0F}, 48);
  for (int tick = 0; tick < 20; ++tick) step();
  const auto before = step();
  ASSERT_GT(before->pieces.size(), 20U);
  const auto delta = step({{1, 9, FillRequest{sphere({0.0F, 0.0F, 0.0F}, 6.0F)}}});
  EXPECT_GT(delta->replies.at(0).pieces, before->pieces.size() / 2) << "the reply counts pieces taken in";
  expect_all_become_terrain();
}

TEST_P(Buried, with_recombination_off_they_stand_still) {
  step({{1, 1, SettingsRequest{{{"recombine", "off"}}}}});
  carve(sphere({0.0F, 0.0F, 0.0F}, 2.0F), {0.0F, 0.0F, 0.0F}, 24);
  for (int tick = 0; tick < 20; ++tick) step();
  fill(sphere({0.0F, 0.0F, 0.0F}, 6.0F));
  for (int tick = 0; tick < 300; ++tick) step();
  EXPECT_LE(travels_.farthest_m(), travel_max_m);
  EXPECT_EQ(lost_, 0);
}

std::string name_of_collider(const ::testing::TestParamInfo<TerrainColliderKind>& info) {
  return std::vector<std::string>{"field", "mesh", "rays"}.at(static_cast<size_t>(info.param));
}

INSTANTIATE_TEST_SUITE_P(colliders, Buried,
                         ::testing::Values(TerrainColliderKind::field, TerrainColliderKind::mesh,
                                           TerrainColliderKind::rays),
                         name_of_collider);

}  // namespace
}  // namespace scree
