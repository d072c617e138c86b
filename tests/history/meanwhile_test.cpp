// An undo while the world moves: what changes after the plan is planned once more.
#include "tests/history/history_world.h"

namespace scree {
namespace {

TEST(UndoMeanwhile, pieces_that_merge_after_the_plan_are_taken_back_too) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  CarveRequest carve;
  carve.shape = sphere({0.0F, 0.0F, 0.0F}, 2.0F);
  carve.seeds = 40;
  hill.ask_world(1, carve);
  for (int i = 0; i < 1000 && hill.world.ledger().terrain == -hill.world.ledger().moved; ++i) hill.step();
  ASSERT_GT(hill.world.ledger().pieces, 0) << "all have merged already: the test shows nothing";
  ASSERT_TRUE(hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "Ann"}).has_value());
  // The plan is made; before the world gets any of it, more pieces merge.
  std::vector<Command> later;
  for (int i = 0; i < 200; ++i) {
    for (Command& command : hill.history->due()) later.push_back(std::move(command));
    const auto delta = hill.world.step({});
    hill.history->note(delta);
  }
  hill.catch_up();
  const auto delta = hill.world.step(later);
  hill.history->note(delta);
  hill.finish_undo();
  hill.settle();
  EXPECT_EQ(hill.world.ledger().terrain, 0);
  EXPECT_EQ(hill.world.ledger().pieces, 0);
  EXPECT_EQ(hill.world.ledger().error(), 0);
}

TEST(UndoMeanwhile, a_request_that_no_tick_gets_is_no_hanging_undo) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  hill.ask_world(1, FillRequest{box({0.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 1.0F})});
  hill.settle();
  ASSERT_TRUE(hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "Ann"}).has_value());
  std::vector<Reply> refused;
  for (const Command& command : hill.history->due())
    refused.push_back({command.session, command.request, "the terrain here cannot be read", 0});
  ASSERT_FALSE(refused.empty());
  hill.history->refused(refused);
  hill.finish_undo();
  EXPECT_EQ(hill.world.ledger().terrain, 0);  // it was asked for once more
  const auto said = hill.ask(UndoRequest{.mode = UndoMode::progress});
  EXPECT_NE(said->find("the world refused"), std::string::npos) << *said;
}

TEST(UndoMeanwhile, stops_when_it_is_told_to) {
  HistoryWorld hill;
  hill.join(1, "Ann");
  for (int i = 0; i < 30; ++i)
    hill.ask_world(
        1, FillRequest{box({static_cast<float>(i) * 16.0F - 240.0F, 1.0F, 0.0F}, {4.0F, 1.0F, 4.0F})});
  hill.settle();
  const MassUnits built = hill.world.ledger().terrain;
  ASSERT_TRUE(hill.ask(UndoRequest{.mode = UndoMode::refuse_conflicts, .by = "Ann"}).has_value());
  hill.step();
  ASSERT_TRUE(hill.ask(UndoRequest{.mode = UndoMode::stop}).has_value());
  hill.finish_undo();
  EXPECT_LT(hill.world.ledger().terrain, built);
  EXPECT_GT(hill.world.ledger().terrain, 0);
}

}  // namespace
}  // namespace scree
