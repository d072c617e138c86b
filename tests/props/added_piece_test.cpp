// Bodies of voxels that requests bring: masses, places, motions, threads, mirrors, snapshots, recordings and
// refusals.
#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "proto/codec.h"
#include "server/formats/world_codec.h"
#include "server/store/recorder.h"
#include "shared/base/limits.h"
#include "shared/operation/added_piece_limits.h"
#include "tests/support/flat_world.h"
#include "tests/support/given_voxels.h"
#include "tests/support/prop_follower.h"
#include "tests/support/prop_world.h"
#include "tests/support/test_folder.h"
#include "tests/support/verify_recording.h"

namespace scree {
namespace {

const PieceState* alive(const PropWorld& world, PieceId id) {
  const auto& pieces = world.last().pieces;
  const auto found = std::ranges::find(pieces, id, &PieceState::id);
  return found == pieces.end() ? nullptr : &*found;
}

glm::vec3 middle_m(const PropWorld& world, PieceId id) {
  const PieceState* const piece = alive(world, id);
  EXPECT_NE(piece, nullptr) << id;
  return piece == nullptr ? glm::vec3(0.0F) : dequantise(piece->pose).position_m;
}

PieceId add(PropWorld& world, const AddPieceRequest& request, uint32_t pieces = 1) {
  const Reply reply = world.ask(request);
  EXPECT_EQ(reply.refusal, "");
  EXPECT_EQ(reply.pieces, pieces);
  return reply.prop.value_or(0);
}

/// 2 m of brick with a floor of ice.
Volume tower() {
  const Material brick = builtin_palette().named("brick").value();
  return given_voxels({4, 8, 4}, [=](VoxelCoord v) { return v.y == 0 ? material::ice : brick; });
}

TEST(AddedPiece, has_the_mass_of_its_voxels_and_the_ledger_has_it_as_poured_in) {
  PropWorld world(rock_world());
  const PieceId id = add(world, piece_of(tower(), {0.0F, 4.0F, 0.0F}));
  ASSERT_EQ(world.last().spawned.size(), 1U);
  const Volume& volume = *world.last().spawned[0].volume;
  // Faces lie half-way between full and empty voxels, and edges are a little round: 44 voxels are at one.
  EXPECT_NEAR(static_cast<double>(volume.mass) / units_per_voxel, 4 * 8 * 4, 8.0);
  EXPECT_EQ(world.last().ledger.pieces, volume.mass);
  EXPECT_EQ(world.last().ledger.poured, volume.mass);
  const MaterialMasses masses = masses_of(volume);
  ASSERT_EQ(masses.size(), 2U);
  const auto& rows = world.last().materials.rows();
  for (const MaterialMass& one : masses) {
    EXPECT_EQ(rows[row_number(one.material)].pieces, one.mass);
    EXPECT_EQ(rows[row_number(one.material)].poured, one.mass);
  }
  EXPECT_NEAR(static_cast<double>(mass_of(masses, material::ice)), volume.mass / 8.0, 0.02 * volume.mass);
  const glm::vec3 expected_m = glm::vec3(0.0F, 4.0F, 0.0F) + 0.25F * glm::vec3(1.5F, 3.5F, 1.5F);
  EXPECT_LT(glm::distance(middle_m(world, id), expected_m), 0.02F);
}

TEST(AddedPiece, turns_about_its_place_and_moves_as_it_was_told) {
  PropWorld world(rock_world());
  AddPieceRequest request = piece_of(given_block({8, 2, 2}), {1.0F, 30.0F, 2.0F});
  const float half = std::sqrt(0.5F);
  request.turn = {half, 0.0F, half, 0.0F};  // a quarter about y: x becomes -z
  request.velocity_m_s = {6.0F, 0.0F, 0.0F};
  const PieceId id = add(world, request);
  const glm::vec3 began_m = middle_m(world, id);
  EXPECT_LT(glm::distance(began_m, glm::vec3(1.125F, 30.125F, 2.0F - 0.875F)), 0.15F);
  world.steps(30);
  EXPECT_NEAR(middle_m(world, id).x - began_m.x, 3.0F, 0.2F);
  EXPECT_LT(middle_m(world, id).y, began_m.y - 1.0F);
}

TEST(AddedPiece, falls_rests_and_stays_until_it_is_released) {
  PropWorld world(rock_world());
  const PieceId id = add(world, piece_of(tower(), {0.0F, 0.5F, 0.0F}));
  world.steps(1200);
  ASSERT_NE(alive(world, id), nullptr) << "it is kept";
  EXPECT_NEAR(middle_m(world, id).y, 1.0F, 0.3F) << "it stands on the ground";
  const MassUnits terrain = world.last().ledger.terrain;
  ASSERT_EQ(world.ask(ReleaseRequest{id}).refusal, "");
  for (int i = 0; i < 1200 && !world.last().pieces.empty(); ++i) world.step();
  EXPECT_TRUE(world.last().pieces.empty());
  EXPECT_EQ(world.last().ledger.terrain - terrain, world.last().ledger.poured - world.last().ledger.dust);
  EXPECT_EQ(world.last().ledger.error(), 0);
}

TEST(AddedPiece, that_is_not_kept_becomes_terrain_by_itself) {
  PropWorld world(rock_world());
  AddPieceRequest request = piece_of(given_block({5, 5, 5}), {0.0F, 1.0F, 0.0F});
  request.kept = false;
  add(world, request);
  for (int i = 0; i < 1800 && !world.last().pieces.empty(); ++i) world.step();
  EXPECT_TRUE(world.last().pieces.empty());
  EXPECT_GT(world.last().ledger.terrain, 0);
}

TEST(AddedPiece, breaks_is_carved_and_is_struck) {
  PropWorld world(rock_world());
  const PieceId broken = add(world, piece_of(tower(), {0.0F, 3.0F, 0.0F}));
  EXPECT_GE(world.ask(BreakRequest{broken, middle_m(world, broken), 6, 3}).pieces, 2U);
  EXPECT_EQ(alive(world, broken), nullptr);
  const PieceId carved = add(world, piece_of(tower(), {5.0F, 3.0F, 0.0F}));
  CarveRequest carve{.shape = sphere(middle_m(world, carved), 0.6F), .seeds = 3, .random_seed = 5};
  carve.impact_m = centre_of(carve.shape);
  carve.piece = carved;
  EXPECT_EQ(world.ask(carve).refusal, "");
  EXPECT_EQ(alive(world, carved), nullptr);
  AddPieceRequest fast = piece_of(tower(), {-8.0F, 3.0F, 0.0F});
  fast.velocity_m_s = {0.0F, -60.0F, 0.0F};
  const PieceId struck = add(world, fast);
  world.steps(10);
  EXPECT_EQ(alive(world, struck), nullptr) << "at 60 m/s the ground breaks it";
}

TEST(AddedPiece, of_voxels_that_do_not_connect_there_are_several) {
  PropWorld world(rock_world());
  const Volume two = given_voxels({12, 3, 3}, [](VoxelCoord v) -> std::optional<Material> {
    if (v.x == 5 || v.x == 6) return std::nullopt;
    return material::rock;
  });
  const PieceId first = add(world, piece_of(two, {0.0F, 3.0F, 0.0F}), 2);
  ASSERT_EQ(world.last().pieces.size(), 2U);
  EXPECT_NEAR(middle_m(world, first).x, 0.25F * 2.0F, 0.02F);
  EXPECT_NEAR(middle_m(world, first + 1).x, 0.25F * 9.0F, 0.02F);
  for (const PieceState& piece : std::vector(world.last().pieces))
    EXPECT_EQ(world.ask(ReleaseRequest{piece.id}).refusal, "") << "each is kept";
}

TEST(AddedPiece, of_rubble_is_of_its_stones) {
  const WorldConfig config = rock_world();
  PropWorld world(config);
  const RubbleRows rows = rubble_rows(*world.world().config().palette);
  const auto row = std::ranges::find_if(world.world().config().palette->rows,
                                        [](const MaterialRow& one) { return one.rubble.has_value(); });
  if (row == world.world().config().palette->rows.end()) GTEST_SKIP() << "this palette has no rubble";
  const auto rubble = static_cast<Material>(row - world.world().config().palette->rows.begin());
  add(world, piece_of(given_block({4, 4, 4}, rubble), {0.0F, 3.0F, 0.0F}));
  EXPECT_EQ(world.last().spawned[0].volume->materials.all, rows.stones[row_number(rubble)]);
}

TEST(AddedPiece, goes_the_same_way_by_any_number_of_threads) {
  std::vector<std::vector<uint64_t>> hashes;
  for (const size_t threads : {1, 2}) {
    PropWorld world(rock_world(), threads);
    std::vector<uint64_t>& of_ticks = hashes.emplace_back();
    for (int i = 0; i < 6; ++i)
      add(world, piece_of(tower(), {0.4F * static_cast<float>(i % 2), 2.0F + 2.5F * i, 0.0F}));
    for (int i = 0; i < 180; ++i) of_ticks.push_back(world.step().state_hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(AddedPiece, a_mirror_gets_it_whole_and_follows_it_into_the_terrain) {
  for (const bool has_kernels : {true, false}) {
    PropWorld world(rock_world());
    world.step();
    Follower client(world.world(), {0.0F, 3.0F, 4.0F}, has_kernels);
    const PieceId id = add(world, piece_of(tower(), {0.0F, 2.0F, 0.0F}));
    const std::shared_ptr<const Volume> volume = world.last().spawned[0].volume;
    client.follow(world.last());
    for (int i = 0; i < 6; ++i) client.follow(world.step());
    ASSERT_TRUE(client.mirror().pieces().contains(id));
    EXPECT_EQ(client.mirror().pieces().at(id).volume->window.codes, volume->window.codes);
    EXPECT_EQ(client.mirror().pieces().at(id).volume->materials, volume->materials);
    world.ask(ReleaseRequest{id});
    client.follow(world.last());
    for (int i = 0; i < 1200 && !world.last().pieces.empty(); ++i) client.follow(world.step());
    EXPECT_TRUE(client.mirror().pieces().empty());
    EXPECT_EQ(client.mirror().mismatches(), 0U);
  }
}

TEST(AddedPiece, a_snapshot_keeps_it) {
  PropWorld world(rock_world());
  add(world, piece_of(tower(), {0.0F, 3.0F, 0.0F}));
  world.steps(30);
  const std::vector<uint8_t> bytes = encode(world.world().snapshot());
  std::vector<uint64_t> ends;
  for (int time = 0; time < 2; ++time) {
    const auto value = decode_world(bytes);
    ASSERT_TRUE(value) << value.error().message;
    auto restored = World::restore(*value);
    ASSERT_TRUE(restored) << restored.error().message;
    EXPECT_EQ(encode((*restored)->snapshot()), bytes);
    for (int i = 0; i < 60; ++i) ends.push_back((*restored)->step({})->state_hash);
  }
  EXPECT_TRUE(std::equal(ends.begin(), ends.begin() + 60, ends.begin() + 60));
}

TEST(AddedPiece, a_recording_is_verified) {
  const TestFolder folder;
  const std::string path = folder / "added.scree";
  const WorldConfig config = rock_world();
  World world(config);
  auto recorder = Recorder::create(path, {"test", config});
  ASSERT_TRUE(recorder) << recorder.error().message;
  AddPieceRequest fast = piece_of(tower(), {6.0F, 2.0F, 0.0F});
  fast.velocity_m_s = {0.0F, -60.0F, 0.0F};
  PieceId kept = 0;
  for (Tick tick = 1; tick <= 900; ++tick) {
    std::vector<Command> commands;
    if (tick == 5) commands.push_back({0, 1, piece_of(tower(), {0.0F, 1.0F, 0.0F})});
    if (tick == 9) commands.push_back({0, 2, fast});
    if (tick == 200) commands.push_back({0, 3, ReleaseRequest{kept}});
    auto delta = world.step(commands);
    for (const Reply& reply : delta->replies) EXPECT_EQ(reply.refusal, "") << tick;
    if (tick == 5) kept = delta->replies.at(0).prop.value_or(0);
    (*recorder)->push(std::move(delta), std::move(commands));
  }
  const auto finished = (*recorder)->finish();
  ASSERT_TRUE(finished) << finished.error().message;
  expect_verifies(path);
}

TEST(AddedPiece, what_is_wrong_is_refused_by_name) {
  PropWorld world(rock_world());
  const AddPieceRequest good = piece_of(tower(), {0.0F, 3.0F, 0.0F});
  const auto said = [&](auto&& change) {
    AddPieceRequest request = good;
    change(request);
    const Reply reply = world.ask(request);
    EXPECT_EQ(refusal_name(reply), "piece_invalid") << reply.refusal;
    return reply.refusal;
  };
  const auto of = [&](const Volume& volume) {
    return said([&](AddPieceRequest& request) { request.volume = std::make_shared<const Volume>(volume); });
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  said([](AddPieceRequest& request) { request.volume = nullptr; });
  said([](AddPieceRequest& request) { request.place_m.x = 5000.0F; });
  said([](AddPieceRequest& request) { request.place_m.y = nan; });
  said([](AddPieceRequest& request) { request.turn = {0.5F, 0.0F, 0.0F, 0.0F}; });
  said([](AddPieceRequest& request) { request.velocity_m_s.x = 300.0F; });
  said([](AddPieceRequest& request) { request.velocity_m_s.x = nan; });
  said([](AddPieceRequest& request) { request.spin_rad_s.x = 30.0F; });
  EXPECT_TRUE(of(given_block({113, 2, 2})).find("112 voxels along a side") != std::string::npos);
  EXPECT_TRUE(of(given_block({41, 41, 41})).find("65536 in all") != std::string::npos);
  EXPECT_TRUE(of(given_block({4, 4, 4}, Material{200})).find("palette") != std::string::npos);
  EXPECT_TRUE(of(given_voxels({4, 4, 4}, [](VoxelCoord) { return std::nullopt; })).find("no rock") !=
              std::string::npos);
  const Volume dust = given_voxels({9, 9, 9}, [](VoxelCoord v) -> std::optional<Material> {
    if (v.x % 2 != 0 || v.y % 2 != 0) return std::nullopt;
    return material::rock;
  });
  EXPECT_TRUE(of(dust).find("do not connect") != std::string::npos);
  EXPECT_TRUE(world.last().pieces.empty());
  EXPECT_EQ(world.last().ledger.poured, 0);
  WorldConfig crowded = rock_world();
  crowded.pieces_max = 1;
  PropWorld small(crowded);
  const Volume two = given_voxels({7, 3, 3}, [](VoxelCoord v) -> std::optional<Material> {
    if (v.x == 3) return std::nullopt;
    return material::rock;
  });
  EXPECT_EQ(refusal_name(small.ask(piece_of(two, {0.0F, 3.0F, 0.0F}))), "pieces_max");
  EXPECT_TRUE(small.last().pieces.empty());
}

// What cannot be read, or is too large, is not read: the world says so in its reply.
TEST(AddedPiece, comes_from_the_wire_within_its_limits) {
  const auto arrives = [](const Volume& volume) {
    const std::vector<uint8_t> bytes = encode(AddPieceMessage{piece_of(volume, {0.0F, 3.0F, 0.0F}), 7});
    const Result<ClientMessage> message = decode_client(std::span(bytes).subspan(4));
    return message && std::get<AddPieceMessage>(*message).volume != nullptr;
  };
  EXPECT_TRUE(arrives(given_block({112, 2, 2})));
  EXPECT_FALSE(arrives(given_block({113, 2, 2})));
  EXPECT_FALSE(arrives(given_block({41, 41, 41})));
}

}  // namespace
}  // namespace scree
