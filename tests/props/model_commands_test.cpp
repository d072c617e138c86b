// scree-admin names the model of a prop by its file or by its hash.
#include <fstream>
#include <gtest/gtest.h>
#include <string>

#include "crypto/sha256.h"
#include "server/app/live_server.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

TEST(ModelCommands, add_prop_names_a_file_or_its_hash) {
  const TestFolder folder;
  const std::vector<uint8_t> bytes{'a', 'n', 'y'};
  std::ofstream(folder / "any.glb", std::ios::binary) << "any";
  LiveConfig config;
  config.world = rock_world();
  config.sim_threads = 1;
  config.net.admin_token = "the-admin-token";
  config.models = std::make_shared<const ContentFiles>(ContentFiles{{sha256(bytes), bytes}});
  auto server = LiveServer::start(config);
  ASSERT_TRUE(server.has_value()) << server.error().message;
  const auto add = [&](const std::string& model) {
    return run_program(std::string(SCREE_ADMIN_PROGRAM) + " add-prop box 1 1 1 --at 0 3 0 --model " + model +
                       " --host 127.0.0.1 --token the-admin-token --port " +
                       std::to_string((*server)->port()));
  };
  EXPECT_EQ(add(folder / "any.glb").second, "prop 1 is added\n");
  EXPECT_EQ(add(hex_of(sha256(bytes))).second, "prop 2 is added\n");
  EXPECT_TRUE(holds(add(folder / "none.glb").second, "none.glb"));
  const std::string strange = hex_of(Digest{7});
  const auto [code, said] = add(strange);
  EXPECT_EQ(code, 1);
  EXPECT_TRUE(holds(said, strange) && holds(said, "--models")) << said;
}

}  // namespace
}  // namespace scree
