// The programs as people start them: a simulating server, and an edge that is killed and comes back.
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "client/cache/join_server.h"
#include "tests/bus/edge_client.h"
#include "tests/support/honest_client.h"

namespace scree {
namespace {

class EdgeProgramTest : public ::testing::Test {
 protected:
  std::unique_ptr<BackgroundProgram> run(const std::string& what, uint16_t port,
                                         std::vector<std::string> more) {
    std::vector<std::string> command{SCREE_SERVER_PROGRAM, "--nats",  nats.url(),
                                     "--world-name",       told_name, "--port",
                                     std::to_string(port), "--web",   "off"};
    command.insert(command.end(), more.begin(), more.end());
    return std::make_unique<BackgroundProgram>(command, folder / what);
  }
  std::string said(const std::string& what) const {
    std::ostringstream text;
    text << std::ifstream(folder / what).rdbuf();
    return text.str();
  }
  static bool answers(uint16_t port) { return RawClient(port).connected(); }

  const TestFolder folder;
  NatsProcess nats;
};

TEST_F(EdgeProgramTest, an_edge_that_was_killed_is_back_with_the_world) {
  const uint16_t port = free_port(), edge_port = free_port();
  const auto simulator = run("simulator", port, {"--terrain", "flat"});
  ASSERT_TRUE(comes([&] { return answers(port); })) << said("simulator");
  auto edge = run("edge", edge_port, {"--edge"});
  ASSERT_TRUE(comes([&] { return answers(edge_port); })) << said("edge");
  expect_carve_accepted(edge_port, said("edge"));
  edge.reset();  // by SIGKILL
  edge = run("edge again", edge_port, {"--edge"});
  ASSERT_TRUE(comes([&] { return answers(edge_port); })) << said("edge again");
  HonestClient direct(port), back(edge_port);
  ASSERT_TRUE(direct.joined() && back.joined());
  const auto hash = direct.hash_at(900);  // 15 s after the start: the pieces have come to rest
  ASSERT_TRUE(hash);
  EXPECT_TRUE(back.comes_to_hash(*hash));
}

TEST_F(EdgeProgramTest, an_edge_waits_for_its_world_and_ends_when_it_is_told_to) {
  auto edge = run("edge", free_port(), {"--edge"});
  ASSERT_TRUE(comes([&] { return said("edge").find("has no keyframe") != std::string::npos; }))
      << said("edge");
  ::kill(edge->number(), SIGTERM);
  int status = -1;
  ASSERT_TRUE(comes([&] { return ::waitpid(edge->number(), &status, WNOHANG) == edge->number(); }));
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << said("edge");
}

TEST_F(EdgeProgramTest, options_that_do_not_fit_an_edge_are_refused) {
  const auto refusal = [&](const std::vector<std::string>& options) {
    auto program = run("refused", 0, options);
    int status = 0;
    EXPECT_TRUE(comes([&] { return ::waitpid(program->number(), &status, WNOHANG) == program->number(); }));
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 2);
    return said("refused");
  };
  EXPECT_NE(refusal({"--edge", "--world", folder / "w"}).find("--world"), std::string::npos);
  EXPECT_NE(refusal({"--edge", "--edge-name", "A.B"}).find("--edge-name"), std::string::npos);
  EXPECT_NE(refusal({"--edge-name", "a"}).find("--edge"), std::string::npos);
}

}  // namespace
}  // namespace scree
