// Rules as scripts: what they hear, decide and do, and what becomes of those that fail.
#include "server/rules/rules.h"

#include <gtest/gtest.h>

#include "server/formats/world_value.h"
#include "server/world/world_snapshot.h"
#include "tests/support/rules_world.h"

namespace scree {
namespace {

CarveRequest ruled_carve(float radius_m = 1.0F, float y_m = -0.5F) {
  CarveRequest carve;
  carve.shape = sphere({0.0F, y_m, 0.0F}, radius_m);
  carve.seeds = 6;
  carve.impact_m = {0.0F, 1.0F, 0.0F};
  return carve;
}

std::string kept(const RulesWorld& game, const std::string& key) {
  for (const KeptValue& one : *game.world->game().kept)
    if (one.key == key) return one.value;
  return "none";
}

TEST(Rules, they_hear_of_the_start_of_persons_and_of_ticks) {
  RulesWorld game(R"(
    on.start(function(e) store.set("start", e) end)
    on.join(function(e) store.set("joined", e.person:name()) end)
    on.leave(function(e) store.set("left", e.person:name()) end)
    on.tick(function(e) store.set("ticks", e.tick) end))");
  const uint64_t anna = game.join("anna");
  game.steps(3);
  EXPECT_EQ(kept(game, "first/start"), R"({"reloaded":false,"restarted":false})") << game.all_logged();
  EXPECT_EQ(kept(game, "first/joined"), R"("anna")");
  EXPECT_EQ(kept(game, "first/ticks"), "2");
  game.rules->leave(anna);
  game.steps(1);
  EXPECT_EQ(kept(game, "first/left"), R"("anna")");
}

TEST(Rules, a_request_is_refused_with_words_changed_or_let_through) {
  RulesWorld game(R"(
    on.request(function(r)
      if r.by:name() == "mallory" then return "not you" end
      if r.kind == "carve" and r.radius > 1 then return { radius = 0.5 } end
    end))");
  const uint64_t mallory = game.join("mallory"), anna = game.join("anna");
  game.step({{mallory, 1, ruled_carve()}});
  ASSERT_EQ(game.refused.size(), 1U) << game.all_logged();
  EXPECT_EQ(game.refused.front().refusal, "not you");
  EXPECT_EQ(refusal_name(game.refused.front()), "game:rules");
  game.step({{anna, 2, ruled_carve(2.0F)}});
  ASSERT_TRUE(game.refused.empty()) << game.all_logged();
  ASSERT_EQ(game.asked.size(), 1U);
  EXPECT_EQ(std::get<CarveRequest>(game.asked.front().body).shape.radius_m, 0.5F);
  EXPECT_EQ(std::get<CarveRequest>(game.asked.front().body).seeds, 6U);
}

TEST(Rules, what_happens_is_told_with_who_made_it_happen) {
  RulesWorld game(R"(
    on.carve(function(e) store.set("carve", { e.by:name(), e.volume > 0.5, e.mass > 500, e.count }) end)
    on.merge(function(e) store.set("merged", (store.get("merged", 0)) + e.count) end))");
  const uint64_t anna = game.join("anna");
  game.step({{anna, 1, ruled_carve(1.5F)}});
  game.steps(240);
  EXPECT_NE(kept(game, "first/carve").find(R"(["anna",true,true,)"), std::string::npos)
      << kept(game, "first/carve") << game.all_logged();
  EXPECT_NE(kept(game, "first/merged"), "none") << game.all_logged();
}

TEST(Rules, what_falls_is_told_with_who_caused_it) {
  RulesWorld game(R"(
    on.start(function()
      world.fill{ shape = "box", at = vec(0, 3, 0), half = vec(0.5, 3, 0.5), material = "rock" }
    end)
    on.fall(function(e)
      if e.by then store.set("felled", { e.by:name(), e.mass > 1000 }) end
    end))");
  const uint64_t anna = game.join("anna");
  game.steps(2);
  game.step({{anna, 1, ruled_carve(1.5F, 1.0F)}});
  game.steps(60);
  EXPECT_EQ(kept(game, "first/felled"), R"(["anna",true])") << game.all_logged();
}

/// Persons without access tokens share a party with others of their address. Its number is the session of one
/// who may have left.
TEST(Rules, who_is_of_a_party_with_others_is_told_apart_by_who_asked_last) {
  RulesWorld game(R"(
    on.start(function()
      world.fill{ shape = "box", at = vec(0, 3, 0), half = vec(0.5, 3, 0.5), material = "rock" }
      world.fill{ shape = "box", at = vec(20, 3, 0), half = vec(0.5, 3, 0.5), material = "rock" }
    end)
    on.carve(function(e) store.set("carved", e.by and e.by:name()) end)
    on.fall(function(e) store.set("felled", e.by and e.by:name()) end))");
  const uint64_t anna = game.join("anna"), ben = game.join("ben");
  game.steps(2);
  const auto fell = [&](uint64_t session, float x_m) {
    CarveRequest carve = ruled_carve(1.5F, 1.0F);
    carve.shape.a.x = carve.impact_m.x = x_m;
    Command command{session, 1, carve};
    command.party = 9000;
    game.step({command});
    game.steps(60);
  };
  fell(anna, 0.0F);
  EXPECT_EQ(kept(game, "first/carved"), R"("anna")") << game.all_logged();
  EXPECT_EQ(kept(game, "first/felled"), R"("anna")") << game.all_logged();
  fell(ben, 20.0F);
  EXPECT_EQ(kept(game, "first/carved"), R"("ben")") << game.all_logged();
  EXPECT_EQ(kept(game, "first/felled"), R"("ben")") << game.all_logged();
}

TEST(Rules, replies_come_to_the_function_that_waits) {
  RulesWorld game(R"(
    on.start(function()
      bodies.add({ box = vec(0.5, 0.5, 0.5), at = vec(0, 3, 0) }, function(r)
        store.set("added", { r.done, r.body ~= nil })
      end)
      world.carve({ at = vec(0, 0, 0), radius = 9000 }, function(r)
        store.set("refused", { r.done, r.reason })
      end)
    end))");
  game.steps(4);
  EXPECT_EQ(kept(game, "first/added"), "[true,true]") << game.all_logged();
  EXPECT_EQ(kept(game, "first/refused"), R"([false,"carve_invalid"])") << game.all_logged();
}

TEST(Rules, timers_run_once_or_again_and_are_taken_away) {
  RulesWorld game(R"(
    on.start(function()
      after(0.1, function() store.set("once", world.tick()) end)
      local n = 0
      local beat
      beat = every(0.05, function()
        n = n + 1
        store.set("beats", n)
        if n == 4 then cancel(beat) end
      end)
    end))");
  game.steps(60);
  EXPECT_EQ(kept(game, "first/once"), "6") << game.all_logged();
  EXPECT_EQ(kept(game, "first/beats"), "4");
}

TEST(Rules, several_mods_hear_in_their_order_and_keep_apart) {
  RulesWorld game(std::vector<std::string>{
      R"(on.request(function(r) store.set("n", 1); if r.kind == "paint" then return "first says no" end end))",
      R"(on.request(function(r) store.set("n", 2); return "second says no" end))"});
  const uint64_t anna = game.join("anna");
  game.step({{anna, 1, PaintRequest{sphere({0.0F, 0.0F, 0.0F}, 1.0F)}}});
  ASSERT_EQ(game.refused.size(), 1U) << game.all_logged();
  EXPECT_EQ(game.refused.front().refusal, "first says no");
  EXPECT_EQ(kept(game, "second/n"), "none");
  game.step({{anna, 2, ruled_carve()}});
  ASSERT_EQ(game.refused.size(), 1U);
  EXPECT_EQ(game.refused.front().refusal, "second says no");
  EXPECT_EQ(kept(game, "first/n"), "1");
  EXPECT_EQ(kept(game, "second/n"), "2");
}

TEST(Rules, persons_get_teams_paces_roles_and_words) {
  RulesWorld game(R"(
    on.join(function(e)
      e.person:set_team("red")
      e.person:set_role("viewer")
      e.person:say("welcome")
      if e.person:name() == "mallory" then e.person:kick("play fair") end
    end)
    every(0.1, function()
      for _, p in ipairs(persons.all()) do store.set(p:name(), { p:team(), p:role(), p:on_foot() }) end
    end))");
  const uint64_t anna = game.join("anna"), mallory = game.join("mallory");
  game.steps(20);
  EXPECT_EQ(kept(game, "first/anna"), R"(["red","builder",false])") << game.all_logged();
  EXPECT_EQ(game.roles.at(anna), Role::viewer);
  EXPECT_EQ(game.kicked.at(mallory), "play fair");
  EXPECT_EQ(game.world->game().players->size(), 2U);
}

TEST(Rules, a_line_is_passed_on_or_kept_back) {
  RulesWorld game(R"(on.say(function(e) if e.text:sub(1, 1) == "/" then return "no such command" end end))");
  const uint64_t anna = game.join("anna"), ben = game.join("ben");
  game.steps(1);
  EXPECT_FALSE(game.rules->hear_line({anna, "anna", "hello"}));
  EXPECT_FALSE(game.rules->hear_line({anna, "anna", "/fly"}));
  game.steps(1);
  size_t hello = 0, refused = 0;
  for (const auto& [session, message] : game.sent)
    if (const auto* const said = std::get_if<SaidMessage>(&message)) {
      if (said->text == "hello")
        hello += said->session == anna && (session == anna || session == ben) ? 1 : 9;
      if (said->text == "no such command") refused += said->session == 0 && session == anna ? 1 : 9;
    }
  EXPECT_EQ(hello, 2U) << game.all_logged();
  EXPECT_EQ(refused, 1U);
}

TEST(Rules, programs_and_rules_send_each_other_bytes) {
  RulesWorld game(R"(on.message(function(e) message.send("pong", e.channel .. e.bytes, e.by) end))");
  const uint64_t anna = game.join("anna");
  game.steps(1);
  game.rules->hear(anna, {"ping", {0, 255}});
  const auto delta = game.step();
  ASSERT_EQ(delta->notices.size(), 1U) << game.all_logged();
  EXPECT_EQ(delta->notices.front().to, (Audience{AudienceKind::session, anna, {}}));
  EXPECT_EQ(std::get<ChannelData>(delta->notices.front().what),
            (ChannelData{"pong", {'p', 'i', 'n', 'g', 0, 255}}));
}

TEST(Rules, a_handler_that_fails_rests_and_the_others_go_on) {
  RulesWorld game(R"(
    on.tick(function() error("broken") end)
    on.tick(function(e) store.set("ticks", e.tick) end))");
  game.steps(20);
  EXPECT_TRUE(game.has_logged("init.lua:2: broken")) << game.all_logged();
  EXPECT_TRUE(game.has_logged("on.tick failed 3 times in a row: it rests for 10 s")) << game.all_logged();
  EXPECT_EQ(game.rules->faults(), 3U);
  EXPECT_EQ(kept(game, "first/ticks"), "19");
  game.steps(60 * 10);
  EXPECT_EQ(game.rules->faults(), 4U);
}

TEST(Rules, requests_are_refused_while_a_rule_on_them_fails) {
  RulesWorld game("on.request(function() error('broken') end)");
  const uint64_t anna = game.join("anna");
  for (uint32_t i = 1; i < 6; ++i) {
    game.step({{anna, i, ruled_carve()}});
    ASSERT_EQ(game.refused.size(), 1U);
    EXPECT_EQ(refusal_name(game.refused.front()), "game:rules_failed");
  }
  EXPECT_EQ(game.rules->faults(), 3U);
}

TEST(Rules, they_are_read_again_without_losing_persons_or_what_is_kept) {
  RulesWorld game(R"(on.join(function(e) store.set("joined", e.person:name()) end))");
  game.join("anna");
  game.steps(2);
  write_mod(game.folder, "first", R"(
    on.start(function(e) store.set("again", { e.reloaded, store.get("joined"), #persons.all() }) end))");
  ASSERT_TRUE(game.rules->reload().has_value());
  game.steps(2);
  EXPECT_EQ(kept(game, "first/again"), R"([true,"anna",1])") << game.all_logged();
  write_mod(game.folder, "first", "on.start(function(e)");
  const auto failed = game.rules->reload();
  ASSERT_FALSE(failed.has_value());
  EXPECT_NE(failed.error().message.find("init.lua:1"), std::string::npos) << failed.error().message;
  game.steps(1);
  EXPECT_EQ(kept(game, "first/again"), R"([true,"anna",1])");
}

TEST(Rules, a_world_that_is_saved_goes_on_with_new_scripts_or_without_any) {
  RulesWorld game(R"(
    on.start(function(e) store.set("starts", store.get("starts", 0) + 1); store.set("restarted", e.restarted) end)
    on.tick(function(e) if e.tick == 3 then show.line("1", "round", { lasts = 60, counts = true }) end end))");
  game.steps(30);
  const WorldSnapshot value = game.world->snapshot();
  auto alone = World::restore(value);
  ASSERT_TRUE(alone.has_value()) << alone.error().message;
  EXPECT_EQ((*alone)->game().signs->size(), 1U);
  EXPECT_EQ((*alone)->step({})->ledger.error(), 0);
  auto restored = World::restore(value);
  ASSERT_TRUE(restored.has_value());
  game.world = std::move(*restored);
  game.load();
  game.steps(3);
  EXPECT_EQ(kept(game, "first/starts"), "2") << game.all_logged();
  EXPECT_EQ(kept(game, "first/restarted"), "true");
}

TEST(Rules, a_console_line_runs_in_a_mod_and_rules_are_listed) {
  RulesWorld game("score = 41");
  game.steps(1);
  game.rules->control(77, 5, {RulesControl::console, "", "score + 1"});
  game.rules->control(77, 6, {RulesControl::console, "nobody", "1"});
  game.rules->control(77, 7, {RulesControl::list, "", ""});
  game.steps(1);
  std::map<uint32_t, std::string> texts;
  for (const auto& [session, message] : game.sent)
    if (const auto* const list = std::get_if<AdminListMessage>(&message)) texts[list->request] = list->text;
  EXPECT_EQ(texts[5], "42");
  EXPECT_NE(texts[6].find("no rules of the name"), std::string::npos);
  EXPECT_NE(texts[7].find("first:"), std::string::npos);
}

TEST(Rules, a_mistake_in_a_file_names_its_line) {
  TestFolder folder;
  RulesOptions options;
  options.folders = {write_mod(folder, "broken", "local a = 1\nworld.tick()\n")};
  const auto loaded = Rules::load(options);
  ASSERT_FALSE(loaded.has_value());
  EXPECT_NE(loaded.error().message.find("init.lua:2"), std::string::npos) << loaded.error().message;
  EXPECT_NE(loaded.error().message.find("on.start"), std::string::npos) << loaded.error().message;
  options.folders = {folder / "nowhere"};
  EXPECT_FALSE(Rules::load(options).has_value());
}

}  // namespace
}  // namespace scree
