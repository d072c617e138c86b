// scree-admin console, as a script and on a terminal, beside a server of this process.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "client/admin/admin.h"
#include "server/app/live_server.h"
#include "tests/support/background_program.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/run_program.h"
#include "tests/support/terminal_program.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

constexpr const char* admin_secret = "the-admin-secret";
constexpr const char* up = "\x1B[A";
constexpr const char* tab = "\t";
constexpr const char* ctrl_c = "\x03";
constexpr const char* ctrl_d = "\x04";

class ConsoleTest : public ::testing::Test {
 protected:
  void SetUp() override {
    LiveConfig config;
    config.world = flat_world();
    config.sim_threads = 1;
    config.net.admin_token = admin_secret;
    config.net.admin_socket = socket;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started.has_value()) << started.error().message;
    server = std::move(*started);
  }
  /// Runs lines as a script.
  std::pair<int, std::string> run(const std::string& lines, const std::string& options = "") {
    std::ofstream(folder / "script") << lines;
    return run_program(std::string(SCREE_ADMIN_PROGRAM) + " console " + options +
                       (options.find("--port") == std::string::npos ? " --socket " + socket : "") + " <" +
                       (folder / "script"));
  }
  TerminalProgram terminal() const {
    return TerminalProgram({SCREE_ADMIN_PROGRAM, "--socket", socket, "console"},
                           {{"XDG_STATE_HOME", folder / "state"}, {"TERM", "xterm"}, {"HOME", folder / ""}});
  }
  std::string prompt() const { return socket + "> "; }
  std::string kept_lines() const {
    std::ifstream file(folder / "state/scree/admin_history");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const TestFolder folder;
  const std::string socket = folder / "s";
  std::unique_ptr<LiveServer> server;
};

TEST_F(ConsoleTest, a_script_runs_line_by_line_without_a_prompt) {
  const auto [status, said] =
      run("set impacts=false dents=true\n\n# a comment\nbans\n  --json bans\nquit\nbans x\n");
  EXPECT_EQ(status, 0) << said;
  EXPECT_TRUE(holds(said, "impacts                    false")) << said;
  EXPECT_FALSE(holds(said, "> "));
  EXPECT_TRUE(holds(said, "[]"));
}

TEST_F(ConsoleTest, a_line_that_fails_is_named_and_the_rest_is_run) {
  const auto [status, said] =
      run("kick\nkick 99 --reason 'not here'\nset 'impacts\nnonsense\nset dents=false");
  EXPECT_EQ(status, 1);
  for (const char* const part :
       {"line 1 failed", "SESSION is required", "line 2 failed", "there is no session 99", "line 3 failed",
        "a quote is not closed", "line 4 failed", "'nonsense'", "dents                      false"})
    EXPECT_TRUE(holds(said, part)) << part << " in " << said;
  EXPECT_FALSE(holds(said, "line 5 failed"));
  EXPECT_EQ(run("").first, 0);
  EXPECT_EQ(run("console\n").first, 1) << "there is no console in a console";
  EXPECT_EQ(run("bans --host 127.0.0.1\n").first, 1) << "the console says where the server is";
}

TEST_F(ConsoleTest, help_is_a_line_too) {
  const auto [status, said] = run("help\nhelp kick\nhelp region add\n");
  EXPECT_EQ(status, 0) << said;
  for (const char* const part :
       {"list-bodies", "quit and exit", "reason, which the client is shown", "--forbid"})
    EXPECT_TRUE(holds(said, part)) << part << " in " << said;
}

TEST_F(ConsoleTest, help_with_what_there_is_not_is_an_error) {
  for (const char* const words : {"nonsense", "kick nonsense", "region nonsense"}) {
    const auto [status, said] = run("help " + std::string(words) + "\n");
    EXPECT_EQ(status, 1) << words;
    EXPECT_TRUE(holds(said, "there is no subcommand nonsense")) << said;
  }
}

TEST_F(ConsoleTest, comes_by_a_token_as_other_subcommands_do) {
  const std::string port = "--host 127.0.0.1 --port " + std::to_string(server->port());
  EXPECT_EQ(run("set impacts=false\n", port + " --token " + admin_secret).first, 0);
  const auto [status, said] = run("set impacts=false\n", port);
  EXPECT_EQ(status, 1);
  EXPECT_TRUE(holds(said, "role admin")) << said;
}

TEST_F(ConsoleTest, options_before_it_hold_for_each_line) {
  const auto [status, said] = run("sessions\nbans\n", "--json");
  EXPECT_EQ(status, 0);
  EXPECT_EQ(said.find('['), 0U) << said;
  EXPECT_TRUE(holds(said, "\"unix:uid=")) << said;
}

TEST_F(ConsoleTest, a_person_types_at_a_prompt_that_names_the_server) {
  TerminalProgram console = terminal();
  ASSERT_TRUE(console.shows("at " + socket + ": help lists")) << console.said();
  ASSERT_TRUE(console.prompts(prompt())) << console.said();
  console.type("sessions\n");
  EXPECT_TRUE(console.shows("unix:uid=")) << console.said();
  EXPECT_TRUE(console.prompts(prompt())) << console.said();
  console.type("kick 99\n");
  EXPECT_TRUE(console.shows("there is no session 99")) << console.said();
  EXPECT_TRUE(console.prompts(prompt())) << "it goes on";
  console.type(ctrl_d);
  EXPECT_EQ(console.ends(), 0);
}

TEST_F(ConsoleTest, ctrl_c_drops_the_line_and_ends_what_runs) {
  TerminalProgram console = terminal();
  ASSERT_TRUE(console.prompts(prompt())) << console.said();
  console.type("kick 99");
  ASSERT_TRUE(console.shows("kick 99"));
  console.type(ctrl_c);
  ASSERT_TRUE(console.prompts(prompt())) << console.said();
  console.type("bans --json\n");
  EXPECT_TRUE(console.shows("[]")) << console.said();
  EXPECT_FALSE(holds(console.said(), "there is no session 99"));
  ASSERT_TRUE(console.prompts(prompt()));
  console.type("top\n");
  ASSERT_TRUE(console.shows("\x1B[H\x1B[2J")) << console.said();
  console.type(ctrl_c);
  ASSERT_TRUE(console.prompts(prompt())) << console.said();
  console.type("quit\n");
  EXPECT_EQ(console.ends(), 0);
  EXPECT_EQ(kept_lines(), "bans --json\ntop\nquit\n");
}

TEST_F(ConsoleTest, tab_completes_subcommands_options_and_settings) {
  TerminalProgram console = terminal();
  ASSERT_TRUE(console.prompts(prompt())) << console.said();
  console.type(std::string("sess") + tab + "\n");
  EXPECT_TRUE(console.shows("unix:uid=")) << console.said();
  ASSERT_TRUE(console.prompts(prompt()));
  console.type(std::string("kick 99 --rea") + tab + "x\n");
  EXPECT_TRUE(console.shows("there is no session 99")) << console.said();
  ASSERT_TRUE(console.prompts(prompt()));
  console.type(std::string("set impa") + tab + "false\n");
  EXPECT_TRUE(console.shows("impacts                    false")) << console.said();
  ASSERT_TRUE(console.prompts(prompt()));
  console.type(std::string("region ") + tab);
  EXPECT_TRUE(console.shows("add")) << console.said();
  EXPECT_TRUE(console.shows("remove")) << console.said();
  console.type(std::string("ma") + tab);
  EXPECT_TRUE(console.shows("ss ")) << console.said();
  console.type(ctrl_c);
  ASSERT_TRUE(console.prompts(prompt()));
  console.type(std::string("help ki") + tab + "\n");
  EXPECT_TRUE(console.shows("reason, which the client is shown")) << console.said();
  ASSERT_TRUE(console.prompts(prompt()));
  console.type("exit\n");
  EXPECT_EQ(console.ends(), 0);
}

TEST_F(ConsoleTest, earlier_lines_come_back_also_in_the_next_console_but_none_with_a_token) {
  {
    TerminalProgram console = terminal();
    ASSERT_TRUE(console.prompts(prompt()));
    console.type("kick 98 --reason 'Jörg, go'\n");
    ASSERT_TRUE(console.shows("there is no session 98")) << console.said();
    ASSERT_TRUE(console.prompts(prompt()));
    console.type("bans --token abcdefgh\n");
    ASSERT_TRUE(console.shows("--token")) << console.said();
    ASSERT_TRUE(console.prompts(prompt())) << console.said();
    console.type(std::string(up) + "\n");
    ASSERT_TRUE(console.shows("there is no session 98")) << console.said();
    ASSERT_TRUE(console.prompts(prompt())) << console.said();
    console.type(ctrl_d);
    EXPECT_EQ(console.ends(), 0);
  }
  EXPECT_EQ(kept_lines(), "kick 98 --reason 'Jörg, go'\n");
  struct stat there {};
  ASSERT_EQ(::stat((folder / "state/scree/admin_history").c_str(), &there), 0);
  EXPECT_EQ(there.st_mode & 07777, 0600U);
  TerminalProgram console = terminal();
  ASSERT_TRUE(console.prompts(prompt()));
  console.type(std::string(up) + "\n");
  EXPECT_TRUE(console.shows("there is no session 98")) << console.said();
  ASSERT_TRUE(console.prompts(prompt()));
  console.type(ctrl_d);
  EXPECT_EQ(console.ends(), 0);
}

TEST_F(ConsoleTest, outlives_its_server) {
  TerminalProgram console = terminal();
  ASSERT_TRUE(console.prompts(prompt()));
  server->stop();
  console.type("sessions\n");
  EXPECT_TRUE(console.shows("cannot connect")) << console.said();
  EXPECT_TRUE(console.prompts(prompt()));
  console.type(std::string("set x") + tab + ctrl_c);
  ASSERT_TRUE(console.prompts(prompt()));
  console.type(ctrl_d);
  EXPECT_EQ(console.ends(), 0);
}

TEST(OwnerOfAnotherUser, root_comes_in_beside_the_servers_user) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  const TestFolder folder;
  const std::string socket = folder / "s";
  ASSERT_EQ(::chown((folder / "").c_str(), 65534, 65534), 0);
  const BackgroundProgram server({"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "env",
                                  "XDG_CACHE_HOME=" + (folder / ""), SCREE_SERVER_PROGRAM, "--port", "0",
                                  "--web", "off", "--terrain", "flat", "--admin-socket", socket},
                                 folder / "log");
  AdminServer owner;
  owner.socket = socket;
  owner.within = std::chrono::seconds(2);
  const auto end = std::chrono::steady_clock::now() + patience;
  auto sessions = list_sessions(owner);
  while (!sessions && std::chrono::steady_clock::now() < end) {
    wait_a_moment();
    sessions = list_sessions(owner);
  }
  ASSERT_TRUE(sessions) << sessions.error().message;
  ASSERT_EQ(sessions->size(), 1U);
  EXPECT_EQ(sessions->front().address, "unix:uid=0");
  EXPECT_EQ(sessions->front().role, Role::admin);
}

}  // namespace
}  // namespace scree
