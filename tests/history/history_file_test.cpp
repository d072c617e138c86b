// What is remembered, across restarts, with little room, and beside files of others.
#include <fstream>

#include "tests/history/history_world.h"

namespace scree {
namespace {

FillRequest block(float x) {
  return {box({x, 1.0F, 0.0F}, {1.0F, 1.0F, 1.0F})};
}

TEST(HistoryFile, names_who_edited_where) {
  HistoryWorld hill;
  hill.join(1, "Ann", "192.0.2.1");
  hill.join(2, "Bea", "192.0.2.1");
  hill.ask_world(1, block(0.0F));
  hill.ask_world(2, block(20.0F));
  const auto all = hill.ask(HistoryRequest{.as_json = true});
  ASSERT_TRUE(all.has_value());
  EXPECT_NE(all->find("\"name\":\"Ann\""), std::string::npos) << *all;
  EXPECT_NE(all->find("\"name\":\"Bea\""), std::string::npos) << *all;
  const auto near = hill.ask(HistoryRequest{.at_m = glm::vec3(20.0F, 1.0F, 0.0F), .radius_m = 2.0F});
  ASSERT_TRUE(near.has_value());
  EXPECT_EQ(near->find("Ann"), std::string::npos) << *near;
  EXPECT_NE(near->find("Bea (session 2)"), std::string::npos) << *near;
  EXPECT_NE(hill.ask(HistoryRequest{.by = "ANN"})->find("Ann"), std::string::npos);
  EXPECT_FALSE(hill.ask(HistoryRequest{.by = "Carl"}).has_value());
  // One address gives one hash, which is not the address.
  const size_t hash = all->find("\"address\":\"");
  ASSERT_NE(hash, std::string::npos);
  EXPECT_NE(all->find(all->substr(hash, 27), hash + 1), std::string::npos) << *all;
  EXPECT_EQ(all->find("192.0.2.1"), std::string::npos);
}

TEST(HistoryFile, goes_on_after_a_restart) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.ask_world(1, block(0.0F));
  hill.settle();
  hill.open();
  const auto begun = hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "Ann"});
  ASSERT_TRUE(begun.has_value()) << begun.error().message;
  hill.finish_undo();
  EXPECT_EQ(hill.world.ledger().terrain, 0);
  EXPECT_EQ(hill.world.ledger().poured, 0);
}

TEST(HistoryFile, forgets_ticks_that_the_world_lost) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.ask_world(1, block(0.0F));
  hill.catch_up();
  hill.history.reset();
  const auto opened = EditHistory::open({.path = hill.folder / "hill.world.history", .world = 1, .tick = 0});
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  hill.history = std::move(const_cast<std::unique_ptr<EditHistory>&>(*opened));
  EXPECT_NE(hill.ask(HistoryRequest{})->find("nobody edited there"), std::string::npos);
}

TEST(HistoryFile, of_another_world_is_put_aside) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.ask_world(1, block(0.0F));
  hill.catch_up();
  hill.open(2);
  EXPECT_NE(hill.ask(HistoryRequest{})->find("nobody edited there"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(hill.folder / "hill.world.history.old"));
}

TEST(HistoryFile, of_a_stranger_is_refused_and_stays) {
  TestFolder folder;
  const std::string path = folder / "hill.world.history";
  std::ofstream(path) << "a letter to my mother, which is no history of a world";
  const auto opened = EditHistory::open({.path = path, .world = 1});
  ASSERT_FALSE(opened.has_value());
  EXPECT_NE(opened.error().message.find(path), std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(path), 53U);
}

TEST(HistoryFile, forgets_the_oldest_where_there_is_little_room) {
  HistoryWorld hill(1);
  hill.join(1, "Ann");
  for (int i = 0; i < 400; ++i) {
    CarveRequest carve;
    carve.shape = sphere(
        {static_cast<float>(i % 20) * 6.0F - 60.0F, 0.0F, static_cast<float>(i / 20) * 6.0F - 60.0F}, 2.0F);
    carve.seeds = 1;
    hill.ask_world(1, carve);
    if (i % 20 == 0) hill.catch_up();
  }
  hill.catch_up();
  EXPECT_LE(hill.history->status().bytes, 2U << 20U);
  EXPECT_NE(hill.ask(HistoryRequest{})->find("are forgotten"), std::string::npos);
}

TEST(HistoryFile, an_undo_leaves_what_it_does_not_know) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.ask_world(1, block(0.0F));
  hill.catch_up();
  // A tick that the history does not get: somebody paints the block.
  const Command paint{2, 1,
                      PaintRequest{box({0.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 1.0F}), static_cast<Material>(1)}};
  hill.world.step({&paint, 1});
  const auto before = hash_of(hill.brick_at({0.5F, 1.0F, 0.5F}));
  ASSERT_TRUE(hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "Ann"}).has_value());
  hill.finish_undo();
  EXPECT_EQ(hash_of(hill.brick_at({0.5F, 1.0F, 0.5F})), before);
  const auto said = hill.ask(UndoRequest{.mode = UndoMode::progress});
  EXPECT_NE(said->find("stay: somebody changed them meanwhile"), std::string::npos) << *said;
}

}  // namespace
}  // namespace scree
