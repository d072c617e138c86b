// The commands of scree-admin about bodies, joints and space, run against a server.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "server/app/live_server.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/run_program.h"

namespace scree {
namespace {

constexpr int refused = 1, misused = 2;

class BodyCommands : public ::testing::Test {
 protected:
  void SetUp() override {
    LiveConfig config;
    config.world = rock_world();
    config.sim_threads = 1;
    config.net.admin_token = "the-admin-token";
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server.has_value()) << server.error().message;
    server_ = std::move(*server);
  }

  std::pair<int, std::string> run(const std::string& act) const {
    return run_program(std::string(SCREE_ADMIN_PROGRAM) + " " + act +
                       " --host 127.0.0.1 --token the-admin-token --port " + std::to_string(server_->port()));
  }
  nlohmann::json json(const std::string& act) const {
    const auto [code, said] = run(act + " --json");
    EXPECT_EQ(code, 0) << said;
    return nlohmann::json::parse(said, nullptr, false);
  }

 private:
  std::unique_ptr<LiveServer> server_;
};

TEST_F(BodyCommands, a_door_is_hung_driven_and_taken_down) {
  EXPECT_EQ(run("add-prop box 1 1 1 --at 0,3,0 --motion fixed --tag 9").second, "prop 1 is added\n");
  EXPECT_EQ(run("add-prop box 1 2 0.2 --at 1.1 3 0 --mass 50").second, "prop 2 is added\n");
  EXPECT_EQ(run("add-joint hinge --a 1 --b 2 --at 0.55,3,0 --axis 0,1,0 --limits -1.5 1.5").second,
            "joint 3 is added\n");
  EXPECT_EQ(run("set-motor 3 2 500").second, "done\n");
  const nlohmann::json joints = json("list-joints --at 0.55 3 0 --radius 2");
  ASSERT_EQ(joints["joints"].size(), 1U);
  EXPECT_EQ(joints["joints"][0]["kind"], "hinge");
  EXPECT_EQ(joints["joints"][0]["motor"]["greatest"], 500.0);
  EXPECT_EQ(joints["joints"][0]["limits"][1], 1.5);
  const nlohmann::json bodies = json("list-bodies --lo -5 0 -5 --hi 5 9 5");
  ASSERT_EQ(bodies["bodies"].size(), 2U);
  EXPECT_EQ(bodies["bodies"][0]["tag"], 9U);
  EXPECT_EQ(bodies["bodies"][0]["motion"], "fixed");
  EXPECT_EQ(bodies["bodies"][1]["mass_kg"], 50.0);
  EXPECT_TRUE(holds(run("list-joints").second, "hinge     body 1 at (0.55, 0.00, 0.00) of it, body 2"));
  EXPECT_EQ(run("remove-joint 3").second, "done\n");
  EXPECT_TRUE(json("list-joints")["joints"].empty());
  EXPECT_TRUE(holds(run("remove-joint 3").second, "there is no joint 3"));
}

TEST_F(BodyCommands, joints_that_cannot_be_are_refused_in_words) {
  run("add-prop box 1 1 1 --at 0 3 0 --motion fixed");
  run("add-prop sphere 1 --at 6 3 0");
  EXPECT_TRUE(holds(run("add-joint rope --a 1 --b 2 --at 0 3 0 --to 6 3 0 --length 4").second,
                    "farther apart than the joint lets them be, and may be 1 m"));
  EXPECT_EQ(run("add-joint ball --a 1 --b 77 --at 0 3 0"),
            std::pair(refused, std::string("scree-admin: error: there is no body 77\n")));
  EXPECT_EQ(run("add-joint ball --a terrain --b 2 --at 6 3 0").first, refused) << "no rock is there";
  EXPECT_TRUE(holds(run("add-joint hinge --a 1 --b 2 --at 0 3 0 --motor 1 1e12").second,
                    "must lie from 0 to 100,000,000,000 N m"));
  EXPECT_EQ(run("add-joint ball --a 1 --b cellar --at 0 3 0").first, misused);
  EXPECT_EQ(run("add-joint bell --a 1 --b 2 --at 0 3 0").first, misused);
  EXPECT_EQ(run("list-bodies --lo 0 0 0").first, misused);
}

TEST_F(BodyCommands, space_is_asked_about) {
  run("add-prop box 2 2 2 --at 0 4 0 --motion fixed");
  const nlohmann::json hit = json("ask ray --from 0 20 0 --direction 0,-2,0 --most 50");
  EXPECT_EQ(hit["hit"]["kind"], "prop");
  EXPECT_NEAR(hit["hit"]["distance_m"].get<double>(), 15.0, 0.01);
  EXPECT_GT(hit["tick"].get<int>(), 0);
  EXPECT_EQ(json("ask ray --from 0 20 0 --direction 0 -1 0 --except 1")["hit"]["kind"], "terrain");
  EXPECT_EQ(json("ask ray --from 0 20 0 --direction 0 -1 0 --no-props --as-of -2")["hit"]["kind"], "terrain");
  EXPECT_TRUE(json("ask ray --from 0 20 0 --direction 0 1 0")["hit"].is_null());
  EXPECT_EQ(json("ask sphere --from 0 20 0 --direction 0 -1 0 --radius 1")["hit"]["id"], 1);
  EXPECT_EQ(json("ask capsule --from 0 20 0 --to 0 21 0 --direction 0 -1 0")["hit"]["id"], 1);
  EXPECT_EQ(json("ask overlap --at 0 4 0 --radius 1")["ids"][0], 1);
  EXPECT_EQ(json("ask overlap --lo -1 3 -1 --hi 1 5 1")["terrain"], false);
  EXPECT_EQ(json("ask nearest --at 0 6 0")["hit"]["id"], 1);
  EXPECT_EQ(json("ask solid --at 0 4 0")["solid"], true);
  EXPECT_NEAR(json("ask content --lo 0 -4 0 --hi 1 -3 1")["rock_m3"].get<double>(), 1.0, 0.01);
  EXPECT_EQ(json("ask bodies --lo -5 0 -5 --hi 5 9 5")["ids"].size(), 1U);
  EXPECT_TRUE(holds(run("ask solid --at 0 4 0").second, "solid (tick "));
  const auto [code, said] = run("ask ray --from 0 20 0 --direction 0 -1 0 --most 5000");
  EXPECT_EQ(code, misused);
  EXPECT_TRUE(holds(said, "the cast is longer than 1000 m")) << said;
  EXPECT_EQ(run("ask ray --from 0 20 0").first, misused) << "no direction";
  EXPECT_EQ(run("ask ray --from 0 20 0 --direction 0 0 0").first, misused);
  EXPECT_EQ(run("ask overlap").first, misused) << "no place";
  EXPECT_EQ(run("ask nearest --at 0 6 0 --most 50").first, misused);
}

TEST_F(BodyCommands, answers_name_materials_and_say_kilograms) {
  EXPECT_EQ(json("ask ray --from 0 20 0 --direction 0 -1 0")["hit"]["material"], "rock");
  const nlohmann::json content = json("ask content --lo 0 -4 0 --hi 1 -3 1");
  EXPECT_EQ(content["masses"][0]["material"], "rock");
  EXPECT_NEAR(content["masses"][0]["kg"].get<double>(), 2600.0, 30.0);
  EXPECT_TRUE(holds(run("ask content --lo 0 -4 0 --hi 1 -3 1").second, "rock: "));
}

TEST_F(BodyCommands, a_body_that_has_just_come_has_no_wild_speed) {
  for (int i = 0; i < 12; ++i) {
    run("add-prop box 1 1 1 --at 1000 " + std::to_string(20 + 2 * i) + " 1000");
    const nlohmann::json told = json("list-bodies");
    for (const nlohmann::json& body : told["bodies"])
      EXPECT_LT(body["speed_m_s"].get<double>(), 100.0) << body;
  }
}

TEST_F(BodyCommands, a_prop_is_turned_and_one_that_is_too_heavy_is_refused) {
  run("add-prop box 4 1 1 --at 0 9 0 --motion fixed --turn 0 0 90");
  EXPECT_EQ(json("ask solid --at 0 10.8 0")["solid"], true) << "it stands";
  EXPECT_EQ(json("ask solid --at 1.8 9 0")["solid"], false);
  run("move-prop 1 --turn 0 0 0");
  EXPECT_EQ(json("ask solid --at 1.8 9 0")["solid"], true) << "it lies";
  const auto [code, said] = run("add-prop sphere 30 --at 0 40 0");
  EXPECT_EQ(code, refused);
  EXPECT_TRUE(holds(said, "name its mass")) << said;
}

TEST_F(BodyCommands, words_that_would_do_nothing_are_refused) {
  run("add-prop box 1 1 1 --at 0 9 0 --motion fixed");
  for (const std::string act :
       {"move-prop 1", "list-bodies --at 0 0 0 --radius -4", "list-bodies --lo 5 0 0 --hi 0 1 1",
        "add-joint rope --a 1 --b terrain --at 0 9 0",
        "add-joint hinge --a 1 --b terrain --at 0 9 0 --to 0 0 0",
        "add-joint rope --a 1 --b terrain --at 0 9 0 --to 0 0 0 --axis 1 0 0",
        "add-joint ball --a foo --b 1 --at 0 9 0"}) {
    const auto [code, said] = run(act);
    EXPECT_EQ(code, misused) << act << ": " << said;
  }
  EXPECT_TRUE(holds(run("list-joints").second, "no joint"));
  EXPECT_TRUE(holds(run("release 1").second, "is a prop"));
}

TEST_F(BodyCommands, a_piece_is_broken_and_a_blow_far_from_the_origin_is_in_reach) {
  EXPECT_EQ(run("cut-out --at 300 0 0 --radius 2").second, "piece 1 is kept, the first of 1\n");
  EXPECT_TRUE(holds(run("list-bodies").second, "kept piece"));
  EXPECT_EQ(run("push 1 --at 300,0,0 --impulse 0,1000,0").second, "done\n");
  EXPECT_TRUE(holds(run("break 1 --at 300 0 0 --seeds 4").second, "done, "));
  EXPECT_TRUE(holds(run("break 1 --at 300 0 0").second, "there is no piece 1"));
}

}  // namespace
}  // namespace scree
