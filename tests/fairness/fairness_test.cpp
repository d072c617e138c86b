// Work that follows from requests belongs to the party that caused it, and parties take turns: whatever
// others leave to be done, an honest client's terrain falls, breaks and merges soon. Each attack is played by
// the rules before as well (rules::as_they_come): there it bites, or the test would prove nothing.
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <tuple>
#include <unistd.h>

#include "server/formats/world_codec.h"
#include "server/store/recorder.h"
#include "server/work/limits.h"
#include "server/world/island_stage.h"
#include "server/world/limits.h"
#include "server/world/refracture_stage.h"
#include "server/world/spawn.h"
#include "server/world/world_snapshot.h"
#include "shared/field/field.h"
#include "tests/support/flat_world.h"
#include "tests/support/verify_recording.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

constexpr uint64_t honest = 1;
constexpr uint64_t first_attacker = 2;
constexpr Tick second = 60;

WorldConfig flat_world_by(uint32_t rules, WorldConfig config = flat_world()) {
  config.rules = rules;
  return config;
}

Command pour(uint64_t session, const Shape& shape) {
  return {session, 1, FillRequest{shape}};
}

/// One piece from the cut itself; it stays where it is.
Command undercut(uint64_t session, const Shape& shape) {
  CarveRequest request;
  request.shape = shape;
  request.seeds = 1;
  request.impact_m = centre_of(shape);
  request.blast_speed_m_s = 0.0F;
  return {session, 2, request};
}

/// The honest client's tower at the origin, and the cut that makes it fall.
Command tower() {
  return pour(honest, box({0.0F, 4.0F, 0.0F}, {1.5F, 6.0F, 1.5F}));
}
Command cut_of_the_tower() {
  return undercut(honest, box({0.0F, 0.75F, 0.0F}, {2.0F, 0.5F, 2.0F}));
}

bool is_near_the_origin(VoxelCoord voxel) {
  return std::max(std::abs(voxel.x), std::abs(voxel.z)) < 100;
}

bool tower_fell(const TickDelta& delta) {
  return std::ranges::any_of(delta.operations, [](const AppliedOperation& applied) {
    const auto* island = std::get_if<IslandOperation>(&applied.operation);
    return island != nullptr && island->box.size().y > 16 && is_near_the_origin(island->start);
  });
}

/// Clients that fill thin plates in the air far from everybody, each thirty a second.
class PlateFillers {
 public:
  explicit PlateFillers(uint64_t clients, glm::vec3 half_m = {3.95F, 0.15F, 3.95F})
      : clients_(clients), half_m_(half_m) {}

  std::vector<Command> at(Tick tick) {
    std::vector<Command> commands;
    if (tick % 2 != 0) return commands;
    for (uint64_t client = 0; client < clients_; ++client, ++plates_) {
      const glm::vec3 pitch_m = 2.0F * half_m_ + 2.5F;
      const glm::vec3 at{600.0F + static_cast<float>(plates_ % 20) * pitch_m.x,
                         150.0F + static_cast<float>(plates_ / 400) * pitch_m.y,
                         600.0F + static_cast<float>(plates_ / 20 % 20) * pitch_m.z};
      commands.push_back(pour(first_attacker + client, box(at, half_m_)));
    }
    return commands;
  }

 private:
  uint64_t clients_;
  glm::vec3 half_m_;
  uint32_t plates_ = 0;
};

struct Played {
  Tick fell_after = 0;  ///< ticks from the honest cut to the fall; 0: it did not fall
  size_t refused = 0;   ///< of the attackers' requests, as falls_waiting
  size_t waiting = 0;   ///< islands, at most
  bool honest_refused = false;
};

void tally(const TickDelta& delta, Played& played) {
  played.waiting = std::max<size_t>(played.waiting, delta.work.islands_put_off);
  for (const Reply& reply : delta.replies) {
    if (reply.session == honest) played.honest_refused |= !reply.refusal.empty();
    if (reply.session != honest && reply.reason == Refusal::falls_waiting) ++played.refused;
  }
}

/// So long an attack; then the honest client cuts its tower, and the attack goes on for that many ticks more.
Played play(World& world, PlateFillers attackers, Tick attack, Tick more) {
  Played played;
  step(world, {tower()});
  for (Tick tick = 0; tick < attack; ++tick) tally(*step(world, attackers.at(tick)), played);
  for (Tick tick = 0; tick < more && played.fell_after == 0; ++tick) {
    std::vector<Command> commands = attackers.at(attack + tick);
    if (tick == 0) commands.push_back(cut_of_the_tower());
    const auto delta = step(world, commands);
    tally(*delta, played);
    EXPECT_EQ(delta->ledger.error(), 0);
    if (tower_fell(*delta)) played.fell_after = tick + 1;
  }
  return played;
}

TEST(fairness, plates_filled_in_the_air_do_not_keep_anothers_tower_from_falling) {
  using Attack = std::tuple<uint64_t, glm::vec3, Tick>;
  for (const auto& [clients, half_m, seconds] :
       {Attack(4, {3.95F, 0.15F, 3.95F}, 6), Attack(1, {7.0F, 7.0F, 7.0F}, 2)}) {
    SCOPED_TRACE(clients);
    World before(flat_world_by(rules::as_they_come)), now(flat_world());
    const PlateFillers attackers(clients, half_m);
    const Played bitten = play(before, attackers, seconds * second, 2 * second);
    EXPECT_EQ(bitten.fell_after, 0U) << "this is no attack";
    const Played fair = play(now, attackers, seconds * second, 2 * second);
    EXPECT_GT(fair.fell_after, 0U);
    EXPECT_LE(fair.fell_after, second / 2);
    EXPECT_FALSE(fair.honest_refused);
    EXPECT_GT(fair.refused, 0U) << "what would wait too long is refused";
    EXPECT_LE(static_cast<float>(fair.waiting), 1.5F * limits::falls_wait_max_s / limits::island_rest_s);
  }
}

/// A table whose leg the honest client carves until it cannot carry the slab.
TEST(fairness, support_is_searched_though_others_islands_wait) {
  const auto broke_after = [](uint32_t rules) {
    WorldConfig config = flat_world_by(rules, rock_world());  // soil would give way
    config.methods.support = true;
    World world(config);
    PlateFillers attackers(4);
    const Tick attack = 3 * second;
    for (Tick tick = 0; tick < attack + 3 * second; ++tick) {
      std::vector<Command> commands = attackers.at(tick);
      if (tick == 0) commands.push_back(pour(honest, box({0.0F, 2.0F, 0.0F}, {1.0F, 3.0F, 1.0F})));
      if (tick == 1) commands.push_back(pour(honest, box({0.0F, 5.5F, 0.0F}, {6.0F, 0.75F, 6.0F})));
      if (tick == attack) commands.push_back(undercut(honest, box({2.375F, 2.5F, 0.0F}, {3.0F, 0.5F, 2.0F})));
      const auto delta = step(world, commands);
      for (const AppliedOperation& applied : delta->operations) {
        const auto* island = std::get_if<IslandOperation>(&applied.operation);
        if (island != nullptr && is_near_the_origin(island->start) && island->box.size().x > 20)
          return tick - attack + 1;
      }
    }
    return Tick{0};
  };
  EXPECT_EQ(broke_after(rules::as_they_come), 0U) << "this is no attack";
  const Tick after = broke_after(rules::newest);
  EXPECT_GT(after, 0U);
  EXPECT_LE(after, second);
}

/// Ticks until the small island's search has ended, which began behind three searches of a bar of 6,000
/// bricks.
Tick searched_after(uint64_t small_ones, uint64_t large_ones) {
  MapField field(flat_terrain);
  PieceTable pieces;
  for (int i = 0; i < 12; ++i)
    apply(FillOperation{box({300.0F + 15.0F * static_cast<float>(i), 60.0F, 0.0F}, glm::vec3(7.9F))}, field,
          pieces);
  const Applied small = apply(FillOperation{box({0.0F, 30.0F, 0.0F}, glm::vec3(0.5F))}, field, pieces);
  IslandQueue queue;
  for (int i = 0; i < 3; ++i) queue.push(large_ones, {brick_of(VoxelCoord{1200, 240, 0})});
  queue.push(small_ones, small.changed);
  for (Tick tick = 1; tick < 200; ++tick) {
    queue.begin_tick();
    SearchAllowance allowance{.bricks = limits::island_bricks_per_tick_min};
    while (queue.search(field, allowance)) {
    }
    const std::vector<LooseningEdit> waiting = queue.value();
    if (std::ranges::find(waiting, small.changed, &LooseningEdit::bricks) == waiting.end()) return tick;
  }
  return 0;
}

TEST(fairness, searches_of_large_islands_do_not_hold_up_that_of_a_small_one) {
  EXPECT_GT(searched_after(0, 0), 8U) << "this is no attack";
  const Tick after = searched_after(honest, first_attacker);
  EXPECT_GT(after, 0U);
  EXPECT_LE(after, 2U);
}

/// Blocks of the same height that are cut loose at once: nine heavy ones far away, and a light one. Ticks
/// until the light one breaks at the ground; 0: it does not.
Tick broke_after(uint32_t rules) {
  WorldConfig config = flat_world_by(rules);
  config.methods.dents = false;
  config.tick_rate_hz = 10;  // all fall in one tick, and strike in one
  World world(config);
  std::vector<Command> blocks;
  for (int i = 0; i < 9; ++i)
    blocks.push_back(
        pour(first_attacker, box({200.0F + 12.0F * static_cast<float>(i), 40.0F, 0.0F}, glm::vec3(2.5F))));
  blocks.push_back(pour(honest, box({0.0F, 40.0F - 2.5F + 1.5F, 0.0F}, glm::vec3(1.5F))));
  step(world, {{0, 0, SettingsRequest{{{"islands", "false"}}}}});
  for (const Command& block : blocks) step(world, {block});
  for (int tick = 0; tick < 20; ++tick) step(world);
  step(world, {{0, 0, SettingsRequest{{{"islands", "true"}}}}});
  for (Tick tick = 1; tick < 100; ++tick) {
    const TickDelta before = world.outline();
    const auto delta = step(world);
    for (const AppliedOperation& applied : delta->operations) {
      const auto* shatter = std::get_if<ShatterOperation>(&applied.operation);
      if (shatter == nullptr) continue;
      const auto piece = std::ranges::find(before.pieces, shatter->piece, &PieceState::id);
      if (piece != before.pieces.end() && glm::length(dequantise(piece->pose).position_m) < 60.0F)
        return tick;
    }
  }
  return 0;
}

TEST(fairness, heavy_blocks_that_strike_do_not_keep_anothers_from_breaking) {
  EXPECT_EQ(broke_after(rules::as_they_come), 0U) << "this is no attack";
  EXPECT_GT(broke_after(rules::newest), 0U);
}

CarveRequest ball(glm::vec3 centre_m, float radius_m, uint32_t seeds) {
  CarveRequest carve;
  carve.shape = sphere(centre_m, radius_m);
  carve.pattern = SeedPattern::radial;
  carve.seeds = seeds;
  carve.impact_m = centre_m + glm::vec3(0.0F, radius_m, 0.0F);
  carve.blast_speed_m_s = 0.0F;
  return carve;
}

/// Ticks until all pieces of a small carve are cut that wait behind those of a large one.
Tick cut_after(uint32_t rules) {
  World::State state(flat_world_by(rules), 1);
  TickDelta delta;
  const auto carve = [&](uint64_t party, const CarveRequest& request, uint32_t at_once) {
    const CarveOperation operation{request.shape,    SeedPattern::uniform, at_once, 1,
                                   request.impact_m, state.next_piece};
    const Applied applied = state.apply_and_record(operation, party, delta);
    const auto where_it_was = [&](PieceId, const Volume& volume) {
      Newborn born;
      born.body.pose.position_m = volume.centre_voxels * flat_terrain.voxel_size_m;
      born.traits.owner = party;
      return born;
    };
    spawn(state, applied, where_it_was, delta);
    queue_refractures(state, applied, request, BlowSide::outside, party, request.seeds, false);
  };
  carve(first_attacker, ball({200.0F, -2.0F, 0.0F}, 8.0F, 1500), 60);
  carve(honest, ball({0.0F, 0.0F, 0.0F}, 2.5F, 64), 8);
  const auto waits = [&] {
    for (const auto& [party, line] : state.refractures.lines())
      for (const WaitingRefracture& waiting : line.items)
        if (glm::length(waiting.pending.impact_m) < 50.0F) return true;
    return false;
  };
  EXPECT_TRUE(waits());
  Tick ticks = 0;
  for (; ticks < 300 && waits(); ++ticks) {
    ++state.tick;
    state.work.begin(state.bodies);
    refracture_pieces(state, delta);
  }
  return ticks;
}

TEST(fairness, cuts_of_a_large_carve_do_not_hold_up_those_of_a_small_one) {
  const Tick before = cut_after(rules::as_they_come), now = cut_after(rules::newest);
  EXPECT_LT(2 * now, before) << now << " ticks, before " << before;
}

/// Where few pieces merge in a tick, those that lie deepest do not come first.
TEST(fairness, pieces_in_a_pit_do_not_keep_anothers_from_merging) {
  const auto merged_after = [](uint32_t rules) {
    WorldConfig config = flat_world_by(rules);
    config.merges_per_tick_max = 1;
    config.methods.impacts = config.methods.dents = false;
    World world(config);
    std::vector<Command> commands;
    for (uint32_t i = 0; i < 10; ++i)
      commands.push_back(
          {first_attacker, i, ball({200.0F + static_cast<float>(i) * 6.0F, -4.0F, 0.0F}, 2.5F, 40)});
    step(world, commands);
    auto delta = step(world, {{honest, 1, ball({0.0F, 0.5F, 0.0F}, 1.0F, 6)}});
    size_t merged = 0;
    for (Tick tick = 1; tick < 20 * second; ++tick) {
      for (const AppliedOperation& applied : delta->operations) {
        const auto* stamp = std::get_if<StampOperation>(&applied.operation);
        if (stamp != nullptr && glm::length(dequantise(stamp->pose).position_m) < 20.0F) ++merged;
      }
      if (merged == 6) return tick;
      delta = step(world);
    }
    return Tick{0};
  };
  const Tick before = merged_after(rules::as_they_come), now = merged_after(rules::newest);
  EXPECT_GT(now, 0U);
  EXPECT_TRUE(before == 0 || now < before);
}

/// Towers, undercut and blown up by one client, with all that follows from it.
std::vector<Command> lone_builder(Tick tick) {
  const float x = static_cast<float>(tick / 20 % 12) * 6.0F - 36.0F;
  if (tick % 20 == 0) return {pour(honest, box({x, 4.0F, 0.0F}, {1.5F, 6.0F, 1.5F}))};
  if (tick % 20 == 10) return {undercut(honest, box({x, 0.75F, 0.0F}, {2.0F, 0.5F, 2.0F}))};
  if (tick % 20 == 15) return {{honest, 3, ball({x, 1.0F, 3.0F}, 2.0F, 60)}};
  return {};
}

TEST(fairness, a_client_that_is_alone_is_served_as_it_always_was) {
  for (const bool support : {false, true}) {
    WorldConfig old = flat_world_by(rules::as_they_come), fair = flat_world_by(rules::by_party);
    old.methods.support = fair.methods.support = support;
    World one(old), other(fair);
    for (Tick tick = 0; tick < 5 * second; ++tick) {
      const auto a = step(one, lone_builder(tick)), b = step(other, lone_builder(tick));
      ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << tick;
      ASSERT_EQ(a->work.estimate_us, b->work.estimate_us) << "tick " << tick;
    }
  }
}

TEST(fairness, whose_work_waits_survives_a_restart) {
  World world(flat_world());
  play(world, PlateFillers(4), 3 * second, 0);
  const WorldSnapshot value = world.snapshot();
  std::set<uint64_t> parties;
  for (const LooseningEdit& search : value.moment.islands) parties.insert(search.party);
  EXPECT_TRUE(parties.contains(first_attacker) && parties.contains(first_attacker + 1));
  EXPECT_GT(first_free_session(value.moment), first_attacker + 1);
  const auto decoded = decode_world(encode(value));
  ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
  EXPECT_EQ(encode(*decoded), encode(value));
  const auto restored = World::restore(*decoded);
  ASSERT_TRUE(restored.has_value()) << restored.error().message;
  EXPECT_EQ(encode((*restored)->snapshot()), encode(value));
  world.renew();
  Tick fell_after = 0;
  CarveRequest blow = ball({0.0F, 1.0F, 0.0F}, 2.6F, 12);  // whose pieces fly away
  blow.blast_speed_m_s = 10.0F;
  Tick cut_at = 0;
  for (Tick tick = 1; tick < 3 * second && fell_after == 0; ++tick) {
    const std::vector<Command> commands =
        tick == 1 ? std::vector{Command{honest, 1, blow}} : std::vector<Command>();
    const auto a = step(world, commands), b = step(**restored, commands);
    ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << tick;
    for (const Reply& reply : b->replies) {
      if (reply.session != honest) continue;
      EXPECT_EQ(reply.refusal, "");
      cut_at = tick;
    }
    if (tower_fell(*b)) fell_after = tick - cut_at + 1;
  }
  EXPECT_GT(fell_after, 0U);
  EXPECT_LE(fell_after, second);
}

TEST(fairness, a_recording_verifies_by_the_rules_that_it_was_made_by) {
  uint64_t last_hash = 0;
  for (const uint32_t rules : {rules::as_they_come, rules::by_party}) {
    const auto path =
        std::filesystem::temp_directory_path() / ("scree_fairness_" + std::to_string(::getpid()) + ".scree");
    World world(flat_world_by(rules));
    PlateFillers attackers(4);
    uint64_t hash = 0;
    {
      auto recorder = Recorder::create(path.string(), {"test", world.config()});
      ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
      for (Tick tick = 0; tick < 4 * second; ++tick) {
        std::vector<Command> commands = attackers.at(tick);
        if (tick == 0) commands.push_back(tower());
        if (tick == 3 * second) commands.push_back(cut_of_the_tower());
        const auto delta = step(world, commands);
        hash = delta->state_hash;
        (*recorder)->push(delta, commands);
      }
      ASSERT_TRUE((*recorder)->finish().has_value());
    }
    EXPECT_NE(hash, last_hash) << "both rules did the same";
    last_hash = hash;
    expect_verifies(path);
  }
}

}  // namespace
}  // namespace scree
