// The folder of models on the command line of scree-server.
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>

#include "crypto/sha256.h"
#include "server/app/server_options.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_glb.h"

namespace scree {
namespace {

TEST(ModelOptions, a_folder_is_read_and_a_bad_file_ends_it_with_its_name) {
  const TestFolder folder;
  const std::string path = folder / "";
  const std::vector<uint8_t> box = box_glb({1, 0, 0}, {0.5F, 0.5F, 0.5F});
  std::ofstream(folder / "box.glb", std::ios::binary)
      .write(reinterpret_cast<const char*>(box.data()), static_cast<std::streamsize>(box.size()));
  const auto parse = [](std::vector<const char*> arguments) {
    return parse_server_options(static_cast<int>(arguments.size()), arguments.data());
  };
  const auto parsed = parse({"scree-server", "--models", path.c_str()});
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parsed));
  const auto& options = std::get<ServerOptions>(parsed);
  ASSERT_EQ(options.models.size(), 1U);
  EXPECT_EQ(options.models[0].name, "box.glb");
  ASSERT_NE(options.live.models, nullptr);
  EXPECT_EQ(options.live.models->at(sha256(box)), box);

  setenv("SCREE_MODELS", path.c_str(), 1);
  const auto by_variable = parse({"scree-server"});
  unsetenv("SCREE_MODELS");
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(by_variable));
  EXPECT_EQ(std::get<ServerOptions>(by_variable).models.size(), 1U);

  std::ofstream(folder / "cut.glb") << "glTF";
  testing::internal::CaptureStderr();
  const auto refused = parse({"scree-server", "--models", path.c_str()});
  const std::string said = testing::internal::GetCapturedStderr();
  ASSERT_TRUE(std::holds_alternative<int>(refused));
  EXPECT_EQ(std::get<int>(refused), 2);
  EXPECT_TRUE(holds(said, "cut.glb: it is no binary glTF")) << said;
}

}  // namespace
}  // namespace scree
