// Living pieces that are carved, and bodies of terrain that are kept: masses, motions, threads, mirrors,
// snapshots, recordings, and refusals.
#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "bench/support/scenes.h"
#include "server/formats/world_codec.h"
#include "server/store/recorder.h"
#include "shared/base/limits.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_follower.h"
#include "tests/support/prop_world.h"
#include "tests/support/test_folder.h"
#include "tests/support/verify_recording.h"

namespace scree {
namespace {

/// A pillar on the ground, and a shape that cuts its upper part out.
const Shape pillar = box({0.0F, 3.0F, 0.0F}, {0.6F, 3.2F, 0.6F});
const Shape upper = box({0.0F, 4.0F, 0.0F}, {1.2F, 3.0F, 1.2F});

CarveRequest piece_carve(PieceId piece, const Shape& shape, uint32_t seeds) {
  CarveRequest carve{.shape = shape, .seeds = seeds, .random_seed = 5};
  carve.impact_m = centre_of(shape);
  carve.blast_speed_m_s = 0.0F;
  carve.piece = piece;
  return carve;
}

/// A slab that cuts the upper part of the pillar in two.
CarveRequest cut_in_two(PieceId piece) {
  return piece_carve(piece, box({0.0F, 4.0F, 0.0F}, {2.0F, 0.3F, 2.0F}), 6);
}

PieceId stand_pillar(PropWorld& world) {
  EXPECT_EQ(world.ask(FillRequest{pillar}).refusal, "");
  const Reply reply = world.ask(CutOutRequest{upper});
  EXPECT_EQ(reply.refusal, "");
  EXPECT_EQ(reply.pieces, 1U);
  return reply.prop.value_or(0);
}

const PieceState* find(const PropWorld& world, PieceId id) {
  const auto& pieces = world.last().pieces;
  const auto found = std::ranges::find(pieces, id, &PieceState::id);
  return found == pieces.end() ? nullptr : &*found;
}

MassUnits mass_of(const TickDelta& delta, PieceId id) {
  for (const SpawnedPiece& one : delta.spawned)
    if (one.id == id) return one.volume->mass;
  return 0;
}

const ShatterOperation* shatter_in(const TickDelta& delta) {
  for (const AppliedOperation& one : delta.operations)
    if (const auto* shatter = std::get_if<ShatterOperation>(&one.operation)) return shatter;
  return nullptr;
}

TEST(CarvedPiece, a_pillar_that_is_cut_in_two_goes_on_as_two_and_its_mass_is_exact) {
  PropWorld world(rock_world());
  const PieceId id = stand_pillar(world);
  const MassUnits pieces = world.last().ledger.pieces, dust = world.last().ledger.dust;
  ASSERT_EQ(world.last().pieces.size(), 1U);
  const Reply reply = world.ask(cut_in_two(id));
  ASSERT_EQ(reply.refusal, "");
  EXPECT_EQ(find(world, id), nullptr);
  ASSERT_GE(world.last().pieces.size(), 3U) << "fragments and two rests";
  ASSERT_NE(shatter_in(world.last()), nullptr);
  EXPECT_TRUE(shatter_in(world.last())->cut.has_value());
  MassUnits sum = 0;
  for (const SpawnedPiece& one : world.last().spawned) sum += one.volume->mass;
  EXPECT_EQ(sum + world.last().ledger.dust - dust, pieces);
  EXPECT_EQ(world.last().ledger.pieces, sum);
  const PieceId last = world.last().spawned.back().id;
  EXPECT_GT(mass_of(world.last(), last) + mass_of(world.last(), last - 1), pieces / 2);
  const float high_m = std::max(dequantise(find(world, last)->pose).position_m.y,
                                dequantise(find(world, last - 1)->pose).position_m.y);
  world.steps(90);
  ASSERT_TRUE(find(world, last) && find(world, last - 1)) << "both are kept, as the pillar was";
  EXPECT_LT(std::max(dequantise(find(world, last)->pose).position_m.y,
                     dequantise(find(world, last - 1)->pose).position_m.y),
            high_m - 0.1F)
      << "the upper one fell on what broke between them";
}

TEST(CarvedPiece, a_part_moves_as_its_place_of_the_parent_moved) {
  PropWorld world(rock_world());
  const PieceId id = stand_pillar(world);
  const glm::vec3 at_m = dequantise(find(world, id)->pose).position_m;
  world.ask(PushRequest{id, {20000.0F, 90000.0F, 0.0F}, at_m});
  world.steps(10);
  const glm::vec3 before_m = dequantise(find(world, id)->pose).position_m;
  world.step();
  const glm::vec3 way_m = dequantise(find(world, id)->pose).position_m - before_m;
  CarveRequest corner = piece_carve(id, sphere(before_m + glm::vec3(0.0F, 2.6F, 0.0F), 0.8F), 2);
  ASSERT_EQ(world.ask(corner).refusal, "");
  const PieceId rest = world.last().spawned.back().id;
  const glm::vec3 there_m = dequantise(find(world, rest)->pose).position_m;
  world.step();
  const glm::vec3 on_m = dequantise(find(world, rest)->pose).position_m - there_m;
  EXPECT_LT(glm::distance(on_m, way_m), 0.3F * glm::length(way_m) + 0.01F);
}

TEST(CarvedPiece, goes_the_same_way_by_any_number_of_threads) {
  std::vector<std::vector<uint64_t>> hashes;
  for (const size_t threads : {1, 2, 4}) {
    PropWorld world(rock_world(), threads);
    std::vector<uint64_t>& of_ticks = hashes.emplace_back();
    world.ask(cut_in_two(stand_pillar(world)));
    for (int i = 0; i < 120; ++i) of_ticks.push_back(world.step().state_hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(CarvedPiece, a_mirror_follows_by_operations_to_the_same_volumes) {
  for (const bool has_kernels : {true, false}) {
    PropWorld world(rock_world());
    world.step();
    Follower client(world.world(), {0.0F, 3.0F, 4.0F}, has_kernels);
    std::map<PieceId, std::shared_ptr<const Volume>> volumes;
    const auto ask = [&](const Request& request) {
      const Reply reply = world.ask(request);
      EXPECT_EQ(reply.refusal, "");
      client.follow(world.last());
      for (const SpawnedPiece& one : world.last().spawned) volumes[one.id] = one.volume;
      return reply.prop.value_or(0);
    };
    ask(FillRequest{pillar});
    const PieceId id = ask(CutOutRequest{upper});
    CarveRequest cut = cut_in_two(id);
    cut.pattern = SeedPattern::natural;
    cut.blast_speed_m_s = 3.0F;
    ask(cut);
    for (int i = 0; i < 6; ++i) client.follow(world.step());
    EXPECT_EQ(client.mirror().mismatches(), 0U);
    ASSERT_EQ(client.mirror().pieces().size(), world.last().pieces.size());
    for (const auto& [piece, motion] : client.mirror().pieces()) {
      EXPECT_EQ(motion.volume->window.codes, volumes.at(piece)->window.codes) << piece;
      EXPECT_EQ(motion.volume->window.box, volumes.at(piece)->window.box) << piece;
      EXPECT_EQ(motion.volume->mass, volumes.at(piece)->mass) << piece;
    }
  }
}

TEST(KeptPiece, rests_for_a_minute_beside_one_that_merges_and_merges_when_it_is_released) {
  PropWorld world(rock_world());
  const PieceId id = stand_pillar(world);
  world.ask(blow_at(world.world().config().terrain, 5.0F, 0.0F, 1.0F, 4, 5));
  EXPECT_GT(world.last().pieces.size(), 1U);
  world.steps(60 * 60);
  ASSERT_EQ(world.last().pieces.size(), 1U) << "the others are terrain";
  EXPECT_EQ(world.last().pieces.front().id, id);
  ASSERT_EQ(world.ask(ReleaseRequest{id}).refusal, "");
  EXPECT_EQ(refusal_name(world.ask(ReleaseRequest{id})), "body_not_kept");
  for (int i = 0; i < 1200 && !world.last().pieces.empty(); ++i) world.step();
  EXPECT_TRUE(world.last().pieces.empty());
}

TEST(KeptPiece, is_not_buried_by_a_fill_and_its_fragments_are_kept_no_more) {
  PropWorld world(rock_world());
  const PieceId id = stand_pillar(world);
  world.ask(FillRequest{box({0.0F, 4.0F, 0.0F}, {1.5F, 3.5F, 1.5F})});
  world.steps(60);
  EXPECT_NE(find(world, id), nullptr);
  const Reply reply = world.ask(BreakRequest{id, {0.0F, 4.0F, 0.0F}, 6, 9});
  ASSERT_GE(reply.pieces, 2U);
  EXPECT_EQ(refusal_name(world.ask(ReleaseRequest{world.last().pieces.front().id})), "body_not_kept");
}

TEST(KeptPiece, of_rock_that_is_not_connected_there_are_several) {
  PropWorld world(rock_world());
  for (const float x_m : {-2.0F, 2.0F}) world.ask(FillRequest{box({x_m, 2.0F, 0.0F}, {0.6F, 2.2F, 0.6F})});
  const Reply reply = world.ask(CutOutRequest{box({0.0F, 3.0F, 0.0F}, {4.0F, 2.0F, 1.5F})});
  EXPECT_EQ(reply.refusal, "");
  EXPECT_EQ(reply.pieces, 2U);
  EXPECT_EQ(world.last().pieces.size(), 2U);
  for (const PieceState& piece : std::vector(world.last().pieces))
    EXPECT_EQ(world.ask(ReleaseRequest{piece.id}).refusal, "") << "each is kept";
}

TEST(KeptPiece, a_snapshot_keeps_it_and_the_state_hash_tells) {
  PropWorld world(rock_world());
  const PieceId id = stand_pillar(world);
  world.steps(30);
  const std::vector<uint8_t> bytes = encode(world.world().snapshot());
  std::vector<uint64_t> ends;
  for (const bool released : {false, false, true}) {
    const auto value = decode_world(bytes);
    ASSERT_TRUE(value) << value.error().message;
    auto restored = World::restore(*value);
    ASSERT_TRUE(restored) << restored.error().message;
    EXPECT_EQ(encode((*restored)->snapshot()), bytes);
    std::vector<Command> commands;
    if (released) commands.push_back({0, 1, ReleaseRequest{id}});
    auto delta = (*restored)->step(commands);
    for (const Reply& reply : delta->replies) EXPECT_EQ(reply.refusal, "");
    ends.push_back(delta->state_hash);
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_NE(ends[0], ends[2]);
}

TEST(KeptPiece, a_recording_is_verified) {
  const TestFolder folder;
  const std::string path = folder / "kept.scree";
  const WorldConfig config = rock_world();
  World world(config);
  auto recorder = Recorder::create(path, {"test", config});
  ASSERT_TRUE(recorder) << recorder.error().message;
  PieceId kept = 0;
  for (Tick tick = 1; tick <= 240; ++tick) {
    std::vector<Command> commands;
    if (tick == 5) commands.push_back({0, 1, FillRequest{pillar}});
    if (tick == 10) commands.push_back({0, 2, CutOutRequest{upper}});
    if (tick == 60) commands.push_back({0, 3, cut_in_two(kept)});
    if (tick == 120) commands.push_back({0, 4, ReleaseRequest{kept}});
    auto delta = world.step(commands);
    for (const Reply& reply : delta->replies) EXPECT_EQ(reply.refusal, "") << tick;
    for (const Reply& reply : delta->replies) kept = reply.prop.value_or(kept);
    if (tick == 60) kept = delta->spawned.back().id;
    (*recorder)->push(std::move(delta), std::move(commands));
  }
  const auto finished = (*recorder)->finish();
  ASSERT_TRUE(finished) << finished.error().message;
  expect_verifies(path);
}

TEST(CarvedPiece, attacks_are_refused_by_name) {
  PropWorld world(rock_world());
  const PieceId id = stand_pillar(world);
  const auto refused = [&](const Request& request) { return refusal_name(world.ask(request)); };
  const Shape near = sphere({0.0F, 4.0F, 0.0F}, 0.5F);
  const auto with = [&](auto&& change) {
    CarveRequest carve = piece_carve(id, near, 4);
    change(carve);
    return refused(carve);
  };
  EXPECT_EQ(refused(piece_carve(id + 1000, near, 4)), "body_missing");
  EXPECT_EQ(refused(piece_carve(id, sphere({9.0F, 4.0F, 0.0F}, 0.5F), 4)), "shape_misses");
  EXPECT_EQ(with([](CarveRequest& carve) { carve.seeds = 0; }), "carve_invalid");
  EXPECT_EQ(with([](CarveRequest& carve) { carve.seeds = limits::seeds_max + 1; }), "carve_invalid");
  EXPECT_EQ(with([](CarveRequest& carve) { carve.shape.radius_m = 100.0F; }), "carve_invalid");
  EXPECT_EQ(with([](CarveRequest& carve) { carve.impact_m.x = std::numeric_limits<float>::quiet_NaN(); }),
            "carve_invalid");
  EXPECT_EQ(with([](CarveRequest& carve) { carve.blast_speed_m_s = 1e6F; }), "blast_speed");
  EXPECT_EQ(with([](CarveRequest& carve) {
              carve.pattern = SeedPattern::authored;
              carve.authored_m.resize(4);
            }),
            "carve_invalid");
  const PieceId prop = world.add(crate(), {6.0F, 0.5F, 0.0F});
  EXPECT_EQ(refused(piece_carve(prop, near, 4)), "body_missing");
  EXPECT_EQ(refused(ReleaseRequest{prop}), "body_missing");
  EXPECT_EQ(refused(CutOutRequest{sphere({0.0F, 40.0F, 0.0F}, 1.0F)}), "shape_misses");
  EXPECT_EQ(refused(CutOutRequest{sphere({0.0F, 0.0F, 0.0F}, 100.0F)}), "carve_invalid");
  EXPECT_NE(find(world, id), nullptr);
}

}  // namespace
}  // namespace scree
