// What a host's rules do in a world by RulesRequest: values that are kept, signs, notices, teams and paces.
// They are a part of its state, of saved worlds and of recordings, and nobody but the server may do it.
#include <gtest/gtest.h>

#include "server/formats/world_codec.h"
#include "server/replay/replay_source.h"
#include "server/store/recorder.h"
#include "server/world/published_state.h"
#include "server/world/world.h"
#include "server/world/world_snapshot.h"
#include "tests/support/flat_world.h"
#include "tests/support/test_folder.h"
#include "tests/support/verify_recording.h"

namespace scree {
namespace {

Command of_rules(RulesAct act) {
  return {.request = 7, .body = RulesRequest{std::move(act)}, .asker = {Role::admin, "rules test", {}}};
}

Sign line(const std::string& name, Tick until = 0) {
  return {.name = name, .text = "round " + name, .until = until, .counts = until != 0};
}

class GameWorld {
 public:
  std::shared_ptr<const TickDelta> act(RulesAct done) {
    const Command command = of_rules(std::move(done));
    return world.step({&command, 1});
  }
  std::string refusal(RulesAct done) {
    const auto delta = act(std::move(done));
    return delta->replies.empty() ? "" : refusal_name(delta->replies.front());
  }

  World world{flat_world()};
};

TEST(GameState, values_are_kept_and_forgotten) {
  GameWorld game;
  EXPECT_EQ(game.refusal(KeepValue{{"demo/score", "3"}}), "");
  EXPECT_EQ(game.refusal(KeepValue{{"demo/round", "1"}}), "");
  const auto before = game.world.step({})->state_hash;
  EXPECT_EQ(game.refusal(KeepValue{{"demo/score", "4"}}), "");
  ASSERT_EQ(game.world.game().kept->size(), 2U);
  EXPECT_EQ(game.world.game().kept->front(), (KeptValue{"demo/round", "1"}));
  EXPECT_EQ(game.world.game().kept->back(), (KeptValue{"demo/score", "4"}));
  EXPECT_EQ(game.refusal(ForgetValue{"demo/score"}), "");
  EXPECT_EQ(game.refusal(ForgetValue{"demo/none"}), "");
  EXPECT_EQ(game.world.game().kept->size(), 1U);
  EXPECT_NE(game.world.step({})->state_hash, before);
}

TEST(GameState, more_than_a_world_has_room_for_is_refused) {
  GameWorld game;
  const std::string long_value(limits::kept_value_bytes_max, 'x');
  size_t kept = 0;
  while (game.refusal(KeepValue{{"k" + std::to_string(kept), long_value}}).empty()) ++kept;
  EXPECT_EQ(kept, limits::kept_bytes_max / (limits::kept_value_bytes_max + 3));
  EXPECT_EQ(game.refusal(KeepValue{{"k0", "short"}}), "");
  EXPECT_EQ(game.refusal(KeepValue{{"", "x"}}), "rules_invalid");
  EXPECT_EQ(game.refusal(KeepValue{{"k", long_value + "x"}}), "rules_invalid");
  EXPECT_EQ(game.refusal(ShowSign{{.name = "a", .text = std::string(200, 'x')}}), "rules_invalid");
  EXPECT_EQ(game.refusal(ShowSign{{.name = "a", .counts = true}}), "rules_invalid");
  EXPECT_EQ(game.refusal(SetPlayer{.session = 3, .pace = 9.0F}), "rules_invalid");
  EXPECT_EQ(game.refusal(SetPlayer{.session = 0}), "rules_invalid");
  EXPECT_EQ(game.refusal(Notice{{}, NoticeLine{""}}), "rules_invalid");
  for (size_t i = 0; i < limits::signs_max; ++i) game.act(ShowSign{line(std::to_string(i))});
  EXPECT_EQ(game.refusal(ShowSign{line("one more")}), "rules_invalid");
}

TEST(GameState, no_session_may_do_what_rules_do) {
  GameWorld game;
  Command command = of_rules(KeepValue{{"k", "v"}});
  command.session = 4;
  const auto delta = game.world.step({&command, 1});
  ASSERT_EQ(delta->replies.size(), 1U);
  EXPECT_EQ(refusal_name(delta->replies.front()), "rules_invalid");
  EXPECT_TRUE(game.world.game().kept->empty());
}

TEST(GameState, signs_are_published_and_end_by_themselves) {
  GameWorld game;
  auto delta = game.act(ShowSign{line("1", 5)});
  ASSERT_NE(delta->signs, nullptr);
  EXPECT_EQ(delta->signs->size(), 1U);
  game.act(ShowSign{line("2")});
  for (Tick tick = 3; tick <= 5; ++tick) EXPECT_EQ(game.world.step({})->signs, nullptr);
  delta = game.world.step({});
  ASSERT_NE(delta->signs, nullptr);
  ASSERT_EQ(delta->signs->size(), 1U);
  EXPECT_EQ(delta->signs->front().name, "2");
  EXPECT_NE(game.act(RemoveSign{{}, "2"})->signs, nullptr);
  EXPECT_TRUE(game.world.game().signs->empty());
}

TEST(GameState, a_team_of_the_rules_edits_where_its_team_may_until_the_session_ends) {
  GameWorld game;
  SetRegionRequest set;
  set.region = {.name = "red land",
                .form = RegionForm::sphere,
                .half_m = glm::vec3(20.0F),
                .forbids = forbids::edits,
                .editors = RegionEditors::persons,
                .teams = {"red"}};
  const Command region{.body = set};
  game.world.step({&region, 1});
  const auto dig = [&](uint64_t session) {
    const Command command{session, 1, DigRequest{sphere({0.0F, 0.0F, 0.0F}, 1.0F)}};
    return refusal_name(game.world.step({&command, 1})->replies.front());
  };
  EXPECT_EQ(dig(5), "in_region");
  EXPECT_NE(game.act(SetPlayer{.session = 5, .team = "red"})->players, nullptr);
  EXPECT_EQ(dig(5), "");
  EXPECT_EQ(dig(6), "in_region");
  const Command leaves{5, 0, LeaveRequest{}};
  EXPECT_NE(game.world.step({&leaves, 1})->players, nullptr);
  EXPECT_TRUE(game.world.game().players->empty());
  EXPECT_EQ(dig(5), "in_region");
}

TEST(GameState, rules_put_persons_on_foot_and_make_them_faster) {
  WorldConfig config = flat_world();
  config.service.persons = Persons::walk;
  World world(config);
  const auto way_of = [&](float pace) {
    const Command put =
        of_rules(SetPlayer{.session = 9, .pace = pace, .place_m = glm::vec3(0.0F, 0.5F, 0.0F)});
    world.step({&put, 1});
    static uint32_t number = 0;
    for (int i = 0; i < 90; ++i) {
      const Command walk{9, ++number, WalkRequest{{.go = {1.0F, 0.0F, 0.0F}}, {1.0F, 0.0F, 0.0F}}};
      world.step({&walk, 1});
    }
    return world.persons().front().walker.feet_m.x;
  };
  const float usual_m = way_of(1.0F), fast_m = way_of(2.0F);
  EXPECT_GT(usual_m, 4.0F);
  EXPECT_NEAR(fast_m / usual_m, 2.0F, 0.2F);
  EXPECT_EQ(way_of(0.0F), 0.0F);
}

TEST(GameState, saved_worlds_have_it) {
  GameWorld game;
  game.act(KeepValue{{"demo/score", std::string("\0\xFF bytes", 8)}});
  game.act(ShowSign{line("1")});
  game.act(ShowSign{{.name = "goal", .to = {AudienceKind::team, 0, "red"}, .kind = SignKind::marker}});
  game.act(SetPlayer{.session = 12, .team = "red", .pace = 1.5F});
  const WorldSnapshot value = game.world.snapshot();
  const auto decoded = decode_world(encode(value));
  ASSERT_TRUE(decoded) << decoded.error().message;
  const auto again = World::restore(*decoded);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*(*again)->game().kept, *game.world.game().kept);
  EXPECT_EQ(*(*again)->game().signs, *game.world.game().signs);
  EXPECT_EQ(*(*again)->game().players, *game.world.game().players);
  EXPECT_EQ(first_free_session(decoded->moment), 13U);
  EXPECT_EQ((*again)->step({})->state_hash, game.world.step({})->state_hash);
  WorldSnapshot other = value;
  other.moment.game.kept = std::make_shared<const std::vector<KeptValue>>(2, KeptValue{"a", "b"});
  EXPECT_FALSE(World::restore(other).has_value());
}

TEST(GameState, recordings_show_signs_and_notices_and_verify) {
  TestFolder folder;
  const std::string path = folder / "game.scree";
  {
    World world(flat_world());
    auto recorder = Recorder::create(path, {"test", flat_world()});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    for (Tick tick = 1; tick <= 120; ++tick) {
      std::vector<Command> commands;
      if (tick == 10) commands.push_back(of_rules(ShowSign{line("1", 90)}));
      if (tick == 20) commands.push_back(of_rules(KeepValue{{"demo/score", "1"}}));
      if (tick == 30) commands.push_back(of_rules(Notice{{}, NoticeLine{"go"}}));
      if (tick == 31) commands.push_back(of_rules(Notice{{}, ChannelData{"ping", {0, 1, 255}}}));
      if (tick == 32) commands.push_back(of_rules(Notice{{}, Cue{.kind = CueKind::ring}}));
      auto delta = world.step(commands);
      (*recorder)->push(std::move(delta), std::move(commands));
    }
    ASSERT_TRUE((*recorder)->finish().has_value());
  }
  auto source = ReplaySource::open(path);
  ASSERT_TRUE(source.has_value()) << source.error().message;
  PublishedState state;
  std::vector<Notice> told;
  for (Tick tick = 1; tick <= 120; ++tick) {
    const auto delta = (*source)->next();
    ASSERT_TRUE(delta.has_value() && *delta != nullptr);
    state.apply(**delta);
    told.insert(told.end(), (*delta)->notices.begin(), (*delta)->notices.end());
    EXPECT_EQ(state.signs()->size(), tick >= 10 && tick <= 90 ? 1U : 0U) << tick;
  }
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(told[0], (Notice{{}, NoticeLine{"go"}}));
  EXPECT_EQ(told[1], (Notice{{}, ChannelData{"ping", {0, 1, 255}}}));
  EXPECT_EQ(std::get<Cue>(told[2].what).kind, CueKind::ring);
  ASSERT_TRUE((*source)->seek(50).has_value());
  const auto whole = (*source)->next();
  ASSERT_TRUE(whole.has_value() && *whole != nullptr);
  PublishedState there;
  there.apply(**whole);
  EXPECT_EQ(there.signs()->size(), 1U);
  expect_verifies(path);
}

}  // namespace
}  // namespace scree
