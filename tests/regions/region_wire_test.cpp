// Clients are told the regions, and scree-admin adds, lists and removes them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "server/app/live_server.h"
#include "shared/region/limits.h"
#include "tests/regions/some_regions.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/prop_follower.h"
#include "tests/support/prop_world.h"
#include "tests/support/run_program.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

TEST(RegionWire, a_client_has_the_regions_that_there_are) {
  PropWorld world(rock_world());
  ASSERT_EQ(world.ask(set_box(glm::vec3(0.0F), glm::vec3(2.0F), forbids::edits, "first")).refusal, "");
  Follower follower(world.world(), {0.0F, 2.0F, 0.0F});
  const auto steps = [&](int count) {
    for (int i = 0; i < count; ++i) follower.follow(world.step());
  };
  steps(3);
  ASSERT_EQ(follower.mirror().regions().size(), 1U) << "it was there when the client came";
  EXPECT_EQ(follower.mirror().regions().front(), world.world().keyframe().regions->front());
  for (int i = 0; i < 20; ++i) {
    world.ask(set_box(glm::vec3(static_cast<float>(i)), glm::vec3(2.0F), forbids::falls, "second"));
    follower.follow(world.last());
  }
  EXPECT_EQ(follower.mirror().regions().size(), 2U);
  steps(20);
  EXPECT_EQ(follower.mirror().regions().back().centre_m.x, 19.0F) << "the last of many changes";
  world.ask(RemoveRegionRequest{"first"});
  follower.follow(world.last());
  steps(20);
  ASSERT_EQ(follower.mirror().regions().size(), 1U);
  EXPECT_EQ(follower.mirror().regions().front().name, "second");
  world.ask(RemoveRegionRequest{"second"});
  follower.follow(world.last());
  steps(20);
  EXPECT_TRUE(follower.mirror().regions().empty());
}

TEST(RegionWire, regions_that_no_world_has_are_refused) {
  const auto is_refused = [](std::vector<Region> regions) {
    const std::vector<uint8_t> bytes = encode(ServerMessage(RegionsMessage{std::move(regions)}));
    return !decode_server(std::span(bytes).subspan(length_prefix_bytes)).has_value();
  };
  const Region good = samples::region();
  Region other = good;
  other.id += 1;
  EXPECT_FALSE(is_refused({good}));
  EXPECT_TRUE(is_refused({good, other})) << "the same name";
  other.name = "other";
  EXPECT_FALSE(is_refused({good, other}));
  EXPECT_TRUE(is_refused({other, good})) << "in the wrong order";
  other.half_m.x = 1e6F;
  EXPECT_TRUE(is_refused({other}));
  other = good;
  other.id = 0;
  EXPECT_TRUE(is_refused({other}));
}

class RegionCommands : public ::testing::Test {
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

 private:
  std::unique_ptr<LiveServer> server_;
};

TEST_F(RegionCommands, add_list_show_and_remove_regions_that_refuse_edits) {
  constexpr int refused = 1, misused = 2;
  EXPECT_EQ(run("region list").second, "");
  EXPECT_EQ(run("region add mill cylinder 8 20 --at 0 0 0 --forbid edits,falls --tells").second, "done\n");
  EXPECT_EQ(run("region add yard box 4 4 4 --at 30,0,0 --forbid edits --editors director --for 600").first,
            0);
  EXPECT_EQ(run("region list --at 0 5 0").second,
            "mill: cylinder of 8 m, 20 m high, at 0, 0, 0; forbids edits, falls; may edit: nobody; tells who "
            "enters and leaves\n");
  const auto shown = nlohmann::json::parse(run("region show yard --json").second, nullptr, false);
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_EQ(shown[0]["role"], "director");
  EXPECT_EQ(shown[0]["half_m"][1], 2.0);
  EXPECT_GT(shown[0]["until"], 600 * 50);
  const auto [code, said] = run("blast --at 0 0 0 --energy 4e6");
  EXPECT_EQ(code, refused);
  EXPECT_TRUE(holds(said, "this lies in the region 'mill': nobody may edit there")) << said;
  EXPECT_EQ(run("blast --at 30 0 0 --energy 4e6").first, 0) << "an administrator is above a director";
  EXPECT_EQ(run("region remove mill").second, "done\n");
  EXPECT_EQ(run("region remove mill").first, refused);
  EXPECT_EQ(run("region show mill").first, refused);
  EXPECT_EQ(run("blast --at 0 0 0 --energy 4e6").first, 0);
  EXPECT_EQ(run("region add bad box 1 2 --at 0 0 0").first, misused);
  EXPECT_EQ(run("region add bad box 1 2 3 --at 0 0 0 --forbid all").first, misused);
  EXPECT_EQ(run("region add bad box 9000 2 3 --at 0 0 0").first, misused);
  EXPECT_EQ(run("region add bad box 1 2 3 --at 0 0 0 --editors Ann").first, misused);
}

TEST_F(RegionCommands, mass_says_what_became_of_a_regions_rock) {
  constexpr int refused = 1;
  ASSERT_EQ(
      run("region add tower box 8 8 8 --at 0 0 0 --counts --editors team:red,name:Ann --forbid edits").first,
      0);
  ASSERT_EQ(run("region add yard box 8 8 8 --at 40 0 0").first, 0);
  EXPECT_TRUE(holds(run("region show tower").second, "may edit: Ann, team red; counts its rock"));
  EXPECT_TRUE(holds(run("blast --at 0 0 0 --energy 4e6").second, "only Ann, the team red may edit there"));
  EXPECT_EQ(run("region mass").second, "nothing was broken out of a region that counts\n");
  EXPECT_EQ(run("region mass yard").first, refused) << "it does not count";
  EXPECT_EQ(run("region mass mill").first, refused);
  ASSERT_EQ(run("region add tower box 8 8 8 --at 0 0 0 --counts").first, 0);
  ASSERT_EQ(run("dig --at 0 0 0 --radius 1 --store red").first, 0);
  const auto masses = nlohmann::json::parse(run("region mass tower --json").second, nullptr, false);
  ASSERT_EQ(masses.size(), 1U);
  EXPECT_EQ(masses[0]["region"], "tower");
  EXPECT_GT(masses[0]["carried"], 0);
  EXPECT_EQ(masses[0]["carried"], masses[0]["cut"]);
  EXPECT_TRUE(holds(run("region mass").second, "m³ of rock"));
}

}  // namespace
}  // namespace scree
