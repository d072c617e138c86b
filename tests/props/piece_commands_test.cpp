// The commands of scree-admin about pieces, run against a server.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

#include "server/app/live_server.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/run_program.h"

namespace scree {
namespace {

TEST(PieceCommands, cut_out_carve_and_release) {
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
  EXPECT_EQ(run("cut-out --at 0 0 0 --radius 1").second, "piece 1 is kept, the first of 1\n");
  const auto [code, said] = run("carve-piece 1 --at 0 -0.3 0 --radius 0.4 --seeds 3");
  EXPECT_EQ(code, 0);
  ASSERT_TRUE(holds(said, "done, ")) << said;
  const int made = std::stoi(said.substr(std::string("done, ").size()));
  EXPECT_GE(made, 2);
  EXPECT_TRUE(holds(run("carve-piece 1 --at 0 -0.3 0 --radius 0.4").second, "there is no piece 1"));
  EXPECT_EQ(run(fmt::format("release {}", made + 1)).second, "done\n");
  EXPECT_TRUE(holds(run(fmt::format("release {}", made + 1)).second, "is not kept"));
  EXPECT_TRUE(holds(run("cut-out --at 0 40 0 --half 1 1 1").second, "there is no rock in the shape"));
}

}  // namespace
}  // namespace scree
