// The commands of scree-admin about stores, run against a server.
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

constexpr int exit_refused = 1, exit_misused = 2;

TEST(StoreCommands, rock_is_dug_listed_transferred_and_placed) {
  LiveConfig config;
  config.world = rock_world();
  config.sim_threads = 1;
  config.net.admin_token = "the-admin-token";
  auto server = LiveServer::start(config);
  ASSERT_TRUE(server.has_value()) << server.error().message;
  const auto run = [&](const std::string& act) {
    return run_program(std::string(SCREE_ADMIN_PROGRAM) + " " + act +
                       " --host 127.0.0.1 --token the-admin-token --port " +
                       std::to_string((*server)->port()));
  };
  EXPECT_EQ(run("stores").second, "nothing is stored\n");
  const auto [code, said] = run("dig --at 0,-1,0 --radius 1.5 --store red");
  EXPECT_EQ(code, 0) << said;
  EXPECT_TRUE(holds(said, " m³"));
  EXPECT_TRUE(holds(run("stores").second, "the store red: "));
  EXPECT_TRUE(holds(run("stores").second, " m³ of rock"));
  EXPECT_EQ(run("transfer --from red --to world --material rock --volume 2").second, "done, 2.000 m³\n");
  const auto json = nlohmann::json::parse(run("stores --json").second, nullptr, false);
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["kind"], "world");
  EXPECT_EQ(json[0]["units"]["rock"], 2 * 64 * 254);
  EXPECT_EQ(json[1]["name"], "red");
  EXPECT_EQ(run("place --at 9,0.5,0 --half 0.5,0.5,0.5 --material rock").first, 0);
  EXPECT_TRUE(holds(run("place --at 9,3,0 --half 3,3,3 --material rock").second, "the world's store has "));
  EXPECT_EQ(run("place --at 9,3,0 --radius 1 --material ice").first, exit_refused);
  EXPECT_EQ(run("transfer --from blue --to world").first, exit_refused);
  EXPECT_EQ(run("dig --at 0,0,0 --store token:xyz").first, exit_misused);
  EXPECT_EQ(run("dig --at 0,-4,0 --store own").first, 0);
  EXPECT_FALSE(holds(run("stores").second, "session")) << "who left has given it to the world";
}

}  // namespace
}  // namespace scree
