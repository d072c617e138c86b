// Pieces become terrain when they are at rest, not when they set out slowly, and heaps do so in bounded time.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>

#include "bench/support/scenes.h"
#include "server/bodies/bodies.h"
#include "server/recombine/rest.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"
#include "tests/support/tilted_ground.h"

namespace scree {
namespace {

/// What became of the pieces of a few blows into level ground.
struct Settled {
  double half_s = 0.0;  ///< until half of the pieces were terrain again, on average
  double all_s = 0.0;   ///< until all were, on average
  size_t merged = 0;
  size_t fast = 0;  ///< of these, faster than 0.5 m/s in the tick before, buried ones aside
  float fastest_m_s = 0.0F;
};

constexpr uint32_t rate_hz = 60;
constexpr uint32_t blows = 8;

std::vector<PieceId> pieces_of(const StampOperation& stamp) {
  std::vector<PieceId> ids{stamp.piece};
  for (const StampedPiece& other : stamp.others) ids.push_back(other.piece);
  return ids;
}

/// The pieces whose middles are in rock: they become terrain where they lie, moving or not.
std::vector<PieceId> buried_in(const World& world, const TickDelta& delta) {
  std::vector<PieceId> buried;
  for (const PieceState& piece : delta.pieces)
    if (sample(world.field(), dequantise(piece.pose).position_m / voxel_m).distance_voxels < 0.0F)
      buried.push_back(piece.id);
  return buried;
}

void observe(const TickDelta& delta, const std::vector<PieceId>& buried,
             std::map<PieceId, std::pair<glm::vec3, float>>& speeds, Settled& settled) {
  for (const AppliedOperation& applied : delta.operations)
    if (const auto* stamp = std::get_if<StampOperation>(&applied.operation); stamp != nullptr)
      for (const PieceId id : pieces_of(*stamp)) {
        const float speed = std::ranges::binary_search(buried, id) ? 0.0F : speeds[id].second;
        settled.fast += speed > 0.5F ? 1 : 0;
        settled.fastest_m_s = std::max(settled.fastest_m_s, speed);
        ++settled.merged;
      }
  for (const PieceState& piece : delta.pieces) {
    const glm::vec3 at_m = dequantise(piece.pose).position_m;
    const auto [found, is_new] = speeds.try_emplace(piece.id, at_m, 0.0F);
    found->second = {at_m, is_new ? 1e3F : glm::length(at_m - found->second.first) * rate_hz};
  }
}

Settled settle_blows() {
  Settled mean;
  for (uint32_t seed = 1; seed <= blows; ++seed) {
    World world(flat_world());
    size_t made = 0;
    std::map<PieceId, std::pair<glm::vec3, float>> speeds;
    auto delta =
        world.step(std::vector<Command>{{0, 0, blow_at(world.config().terrain, 0.0F, 0.0F, 2.0F, 48, seed)}});
    const size_t before = mean.merged;
    double half_s = 0.0;
    std::vector<PieceId> buried;
    while (!delta->pieces.empty() && delta->tick < 60 * rate_hz) {
      made += delta->spawned.size();
      observe(*delta, buried, speeds, mean);
      if (half_s == 0.0 && 2 * (mean.merged - before) >= made)
        half_s = static_cast<double>(delta->tick) / rate_hz;
      buried = buried_in(world, *delta);
      delta = world.step({});
    }
    observe(*delta, buried, speeds, mean);
    mean.half_s += half_s / blows;
    mean.all_s += static_cast<double>(delta->tick) / rate_hz / blows;
  }
  return mean;
}

TEST(SlowPieces, heaps_come_to_rest_in_bounded_time) {
  const Settled settled = settle_blows();
  std::printf("half %.2f s, all %.2f s; of %zu, %zu are faster than 0.5 m/s, the fastest %.2f m/s\n",
              settled.half_s, settled.all_s, settled.merged, settled.fast,
              static_cast<double>(settled.fastest_m_s));
  EXPECT_GT(settled.merged, 300U);
  EXPECT_LT(settled.all_s, 6.0);
  // By published poses, which overlaps move, too, where rubble that takes more room than its pieces reaches
  // into their neighbours: their own speed is at most 0.2 m/s.
  EXPECT_LE(settled.fast, settled.merged / 6);
}

/// Bodies that freeze from the ground up when they are at rest, as those of a world without merges do.
class Freezing {
 public:
  explicit Freezing(Field& field) : bodies_(field, {}), rest_({}, rate_hz) {}

  Bodies& bodies() { return bodies_; }
  void step() {
    bodies_.step();
    std::vector<RestPiece> pieces;
    for (const BodyState& body : bodies_.states())
      if (!body.frozen)
        pieces.push_back({body.id, body.pose, bodies_.reach_m(body.id), glm::length(body.velocity_m_s),
                          body.velocity_m_s});
    const BodyContacts contacts = bodies_.contacts();
    std::vector<RestSupport> supports;
    for (const Carried& carried : contacts.carried) supports.push_back({carried.upper, carried.lower});
    for (const PieceId id : rest_.update(pieces, contacts.on_terrain, supports, pieces.size()))
      bodies_.freeze(id);
  }

 private:
  Bodies bodies_;
  RestDetector rest_;
};

TEST(SlowPieces, a_tower_of_ten_blocks_stands_for_a_minute) {
  MapField field(flat_terrain);
  Freezing world(field);
  for (PieceId id = 1; id <= 10; ++id)
    world.bodies().add(box_shape(glm::vec3(0.5F)), body_at(id, {0.0F, static_cast<float>(id) - 0.5F, 0.0F}));
  for (uint32_t tick = 0; tick < 60 * rate_hz; ++tick) world.step();
  for (PieceId id = 1; id <= 10; ++id) {
    const glm::vec3 at = world.bodies().state(id).pose.position_m;
    EXPECT_GT(at.y, static_cast<float>(id) - 0.8F);
    EXPECT_LT(std::abs(at.x) + std::abs(at.z), 0.5F) << "it leans";
  }
}

/// Whether a block of rock that is laid on a slope of rock is at rest before it has slid a quarter of a
/// metre.
bool rests_on(float angle) {
  MapField field(flat_terrain);
  const Slope slope{.angle = angle};
  lay(field, slope, material::rock);
  Freezing world(field);
  BodyShape block = box_shape({0.5F, 0.25F, 0.5F});
  block.friction = builtin_row(material::rock).friction;
  world.bodies().add(block, on_slope(1, slope, 0.25F));
  for (uint32_t tick = 0; tick < 4 * rate_hz && world.bodies().frozen() == 0; ++tick) world.step();
  return glm::length(world.bodies().state(1).pose.position_m - on_slope(1, slope, 0.25F).pose.position_m) <
         0.25F;
}

TEST(SlowPieces, what_slides_slowly_is_not_at_rest) {
  constexpr float margin = 1.5F * 0.01745329F;
  const float limit = std::atan(builtin_row(material::rock).friction);
  EXPECT_TRUE(rests_on(limit - margin));
  EXPECT_FALSE(rests_on(limit + margin));
}

/// A slab of 10 m, set on its lower edge so far past its balance.
TEST(SlowPieces, a_slab_three_degrees_past_its_balance_falls) {
  MapField field(flat_terrain);
  Freezing world(field);
  const glm::vec3 half_m(0.75F, 5.0F, 1.5F);
  const float past = 3.0F * 0.01745329F, r_m = std::sqrt(half_m.x * half_m.x + half_m.y * half_m.y);
  BodyState state = body_at(1, {r_m * std::sin(past), r_m * std::cos(past), 0.0F});
  state.pose.rotation = glm::angleAxis(-std::atan(half_m.x / half_m.y) - past, glm::vec3(0.0F, 0.0F, 1.0F));
  world.bodies().add(box_shape(half_m), state);
  for (uint32_t tick = 0; tick < 8 * rate_hz && world.bodies().frozen() == 0; ++tick) world.step();
  EXPECT_LT(world.bodies().state(1).pose.position_m.y, 1.5F) << "it lies";
}

}  // namespace
}  // namespace scree
