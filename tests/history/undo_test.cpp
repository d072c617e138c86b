// Who did what, and taking it back: the vandal's edits go, the others' stay, and no mass is lost.
#include <algorithm>
#include <map>

#include "server/formats/world_value.h"
#include "shared/base/random.h"
#include "tests/history/history_world.h"

namespace scree {
namespace {

CarveRequest carve_at(glm::vec3 at_m, float radius_m = 1.0F, uint32_t seeds = 6) {
  CarveRequest carve;
  carve.shape = sphere(at_m, radius_m);
  carve.seeds = seeds;
  carve.impact_m = at_m;
  carve.blast_speed_m_s = 2.0F;
  return carve;
}

/// All edited bricks, by their hashes.
std::map<BrickCoord, uint64_t> bricks_of(const World& world) {
  std::map<BrickCoord, uint64_t> hashes;
  for (const ChunkCoord chunk : world.field().edited_chunks())
    for (const BrickCoord coord : world.field().edited_bricks(chunk)) {
      const Brick codes = world.field().brick(coord);
      hashes[coord] = brick_hash(coord, codes, world.field().materials(coord));
    }
  return hashes;
}

TEST(Undo, takes_back_a_carve_with_its_rubble) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  const auto before = hill.brick_at({0.5F, -0.5F, 0.5F});
  hill.ask_world(1, carve_at({0.0F, 0.0F, 0.0F}, 2.0F, 16));
  hill.settle();
  ASSERT_NE(hash_of(hill.brick_at({0.5F, -0.5F, 0.5F})), hash_of(before));
  const MassUnits dust = hill.world.ledger().dust;
  const auto begun = hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "ann"});
  ASSERT_TRUE(begun.has_value()) << begun.error().message;
  hill.finish_undo();
  hill.settle();
  for (const auto& [coord, hash] : bricks_of(hill.world)) {
    const Brick ground = hill.world.field().generated_brick(coord);
    EXPECT_EQ(hash, brick_hash(coord, ground, BrickMaterials()))
        << coord.x << " " << coord.y << " " << coord.z;
  }
  EXPECT_EQ(hill.world.ledger().error(), 0);
  EXPECT_EQ(hill.world.ledger().terrain, 0);
  EXPECT_EQ(hill.world.ledger().pieces, 0);
  EXPECT_EQ(hill.world.ledger().poured, dust);  // what became dust comes back as poured
  EXPECT_EQ(hill.world.measure_terrain(), 0);
}

TEST(Undo, takes_pieces_that_are_still_in_the_air) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.ask_world(1, carve_at({0.0F, 0.0F, 0.0F}, 2.0F, 16));
  for (int i = 0; i < 5; ++i) hill.step();
  ASSERT_GT(hill.world.ledger().pieces, 0);
  const auto preview = hill.ask(UndoRequest{.by = "session:1", .as_json = true});
  ASSERT_TRUE(preview.has_value()) << preview.error().message;
  EXPECT_EQ(preview->find("\"pieces\":0"), std::string::npos) << *preview;
  ASSERT_TRUE(hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "session:1"}).has_value());
  hill.finish_undo();
  EXPECT_EQ(hill.world.ledger().pieces, 0);
  EXPECT_EQ(hill.world.ledger().error(), 0);
  EXPECT_EQ(hill.world.measure_terrain(), hill.world.ledger().terrain);
}

/// A vandal and nine others edit a field, now apart, now over each other.
class Crowd : public HistoryWorld {
 public:
  static constexpr uint64_t vandal = 7, persons = 10;

  void edit(int count) {
    for (uint64_t session = 1; session <= persons; ++session)
      join(session, "person " + std::to_string(session), "192.0.2." + std::to_string(session));
    Random random(5);
    for (int i = 0; i < count; ++i) {
      const uint64_t session = 1 + i % persons;
      const auto spread = [&] { return static_cast<float>(random.below(320)) * 0.25F - 40.0F; };
      const glm::vec3 at{spread(), 0.0F, spread()};
      if (i % 3 == 0)
        ask_world(session, FillRequest{box(at + glm::vec3(0.0F, 1.0F, 0.0F), {1.0F, 1.0F, 1.0F})});
      else
        ask_world(session, carve_at(at, 1.0F, 4));
    }
    settle();
  }
};

TEST(Undo, leaves_what_others_did_last) {
  Crowd crowd;
  crowd.edit(300);
  const auto before = bricks_of(crowd.world);
  const std::string by = "person 7";
  const auto refused = crowd.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = by});
  ASSERT_FALSE(refused.has_value()) << "nobody edited over the vandal: the test shows nothing";
  EXPECT_NE(refused.error().message.find("--keep-others"), std::string::npos) << refused.error().message;
  const auto begun = crowd.ask(UndoRequest{.mode = UndoMode::keep_others, .by = by, .as_json = true});
  ASSERT_TRUE(begun.has_value()) << begun.error().message;
  crowd.finish_undo();
  crowd.settle();
  size_t changed = 0, stayed = 0;
  for (const auto& [coord, hash] : bricks_of(crowd.world)) ++(before.at(coord) == hash ? stayed : changed);
  EXPECT_GT(changed, 100U);
  EXPECT_GT(stayed, changed);
  EXPECT_EQ(crowd.world.ledger().error(), 0);
  EXPECT_EQ(crowd.world.measure_terrain(), crowd.world.ledger().terrain);
  const auto again = crowd.ask(UndoRequest{.by = by, .as_json = true});
  ASSERT_TRUE(again.has_value());
  EXPECT_NE(again->find("\"bricks\":0,"), std::string::npos)
      << *again;  // nothing of his is the last any more
}

TEST(Undo, is_part_of_what_a_recording_repeats) {
  Crowd crowd;
  crowd.edit(60);
  ASSERT_TRUE(crowd.ask(UndoRequest{.mode = UndoMode::over_others, .by = "person 7"}).has_value());
  crowd.finish_undo();
  crowd.settle();
  World again(flat_world());
  for (size_t i = 0; i < crowd.steps.size(); ++i)
    ASSERT_EQ(again.step(crowd.steps[i])->state_hash, crowd.hashes[i]) << "tick " << i + 1;
}

TEST(Undo, of_an_undo_brings_the_edits_back) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.ask_world(1, FillRequest{box({0.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 1.0F})});
  hill.settle();
  const auto built = bricks_of(hill.world);
  ASSERT_TRUE(hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "Ann"}).has_value());
  hill.finish_undo();
  EXPECT_NE(bricks_of(hill.world), built);
  const auto begun = hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "undo:1"});
  ASSERT_TRUE(begun.has_value()) << begun.error().message;
  hill.finish_undo();
  EXPECT_EQ(bricks_of(hill.world), built);
}

/// Lines of the history about the first undo, which takes back so many blocks.
ptrdiff_t lines_of_undo(int blocks) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  for (int i = 0; i < blocks; ++i)
    hill.ask_world(1, FillRequest{box({3.0F * static_cast<float>(i), 1.0F, 0.0F}, {1.0F, 1.0F, 1.0F})});
  hill.settle();
  EXPECT_TRUE(hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "Ann"}).has_value());
  hill.finish_undo();
  const auto said = hill.ask(HistoryRequest{.by = "undo:1"});
  EXPECT_TRUE(said.has_value()) << said.error().message;
  return said ? std::ranges::count(*said, '\n') : 0;
}

TEST(Undo, is_one_line_of_the_history_however_many_ticks_it_takes) {
  EXPECT_GT(lines_of_undo(1), 0);
  EXPECT_EQ(lines_of_undo(20), lines_of_undo(1));
}

TEST(Undo, takes_back_within_a_box_alone) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.ask_world(1, FillRequest{box({0.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 1.0F})});
  hill.ask_world(1, FillRequest{box({20.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 1.0F})});
  hill.settle();
  const auto far = hash_of(hill.brick_at({20.5F, 1.0F, 0.5F}));
  const auto near = hash_of(hill.brick_at({0.5F, 1.0F, 0.5F}));
  UndoRequest undo{.mode = UndoMode::refuse_conflicts, .by = "Ann"};
  undo.lo_m = glm::vec3(-8.0F, -8.0F, -8.0F);
  undo.hi_m = glm::vec3(8.0F, 8.0F, 8.0F);
  ASSERT_TRUE(hill.ask(undo).has_value());
  hill.finish_undo();
  EXPECT_EQ(hash_of(hill.brick_at({20.5F, 1.0F, 0.5F})), far);
  EXPECT_NE(hash_of(hill.brick_at({0.5F, 1.0F, 0.5F})), near);
}

TEST(Undo, what_stands_on_what_goes_falls) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.join(2, "Bea");
  hill.ask_world(1, FillRequest{box({0.0F, 3.0F, 0.0F}, {1.0F, 3.0F, 1.0F})});
  hill.ask_world(2, FillRequest{box({0.0F, 10.0F, 0.0F}, {2.0F, 4.0F, 2.0F})});
  hill.settle();
  ASSERT_TRUE(hill.ask(UndoRequest{.mode = UndoMode::keep_others, .by = "Ann"}).has_value());
  hill.finish_undo();
  bool falls = false;
  for (int i = 0; i < 300 && !falls; ++i) falls = !hill.step()->pieces.empty();
  EXPECT_TRUE(falls);
  EXPECT_EQ(hill.world.ledger().error(), 0);
}

TEST(Undo, a_preview_marks_its_places_on_a_screen) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.ask_world(1, FillRequest{box({8.0F, 1.0F, 8.0F}, {1.0F, 1.0F, 1.0F})});
  hill.ask_world(1, FillRequest{box({104.0F, 1.0F, 8.0F}, {1.0F, 1.0F, 1.0F})});
  hill.settle();
  const auto before = hill.world.field().hash();
  UndoRequest preview{.by = "Ann"};
  preview.show_session = 1;
  ASSERT_TRUE(hill.ask(preview).has_value());
  hill.step();
  const auto& signs = *hill.world.game().signs;
  ASSERT_EQ(signs.size(), 2U);
  EXPECT_EQ(signs[0].text, "8 bricks would go back");
  EXPECT_NEAR(signs[0].place_m.x + signs[1].place_m.x, 112.0F, 4.0F);
  EXPECT_EQ(signs[0].to, (Audience{.kind = AudienceKind::session, .session = 1}));
  EXPECT_EQ(hill.world.field().hash(), before);
}

TEST(Undo, says_what_is_wrong) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.catch_up();
  EXPECT_EQ(hill.ask(UndoRequest{.by = "Nobody"}).error().message,
            "Nobody has edited nothing here: say whose edits by name:NAME, session:NUMBER, token:ID, "
            "address:HASH or "
            "undo:NUMBER");
  EXPECT_FALSE(hill.ask(UndoRequest{}).has_value());
  EXPECT_FALSE(hill.ask(UndoRequest{.mode = UndoMode::stop}).has_value());
  EXPECT_EQ(hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "Ann"}).error().message,
            "there is nothing to take back");
}

TEST(RestoreRequest, is_the_servers_alone_and_is_checked) {
  World world(flat_world());
  const auto refusal = [&](uint64_t session, RestoreRequest request) {
    const Command command{session, 1, std::move(request)};
    const auto delta = world.step({&command, 1});
    return delta->replies.empty() ? "" : refusal_name(delta->replies.front());
  };
  EXPECT_EQ(refusal(3, {}), "restore_invalid");
  EXPECT_EQ(refusal(0, {}), "");
  auto apart = std::make_shared<std::vector<RestoreRequest::Brick>>();
  for (const int32_t x : {0, 100}) apart->push_back({{{x, 0, 0}, air_brick(), {}}, 0});
  EXPECT_EQ(refusal(0, {.bricks = apart}), "restore_invalid");
  auto outside = std::make_shared<std::vector<RestoreRequest::Brick>>();
  outside->push_back({{{100'000, 0, 0}, air_brick(), {}}, 0});
  EXPECT_EQ(refusal(0, {.bricks = outside}), "restore_invalid");
  EXPECT_EQ(refusal(0, {.pieces = {5, 9}}), "");  // they are gone: that is no fault
  EXPECT_EQ(world.ledger(), Ledger{});
}

}  // namespace
}  // namespace scree
