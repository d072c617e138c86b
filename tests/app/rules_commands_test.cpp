// The commands of scree-admin about rules, run against a server whose host answers them.
#include <gtest/gtest.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/admin/admin.h"
#include "server/app/live_server.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/run_program.h"

namespace scree {
namespace {

constexpr int exit_failed = 1, exit_misused = 2;

class RulesCommands : public ::testing::Test {
 protected:
  void start(bool has_rules) {
    LiveConfig config;
    config.world = flat_world();
    config.sim_threads = 1;
    config.net.admin_token = "the-admin-token";
    if (has_rules) {
      config.hooks.started = [this](const HostActs& acts) { acts_ = acts; };
      config.hooks.controlled = [this](uint64_t session, uint32_t request, const ControlRulesRequest& wish) {
        const std::scoped_lock lock(mutex_);
        wishes_.push_back(wish);
        acts_.send(session, AdminListMessage{.request = request, .text = answer_});
      };
    }
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server.has_value()) << server.error().message;
    server_ = std::move(*server);
  }
  std::pair<int, std::string> run(const std::string& act, const std::string& token = "the-admin-token") {
    return run_program(std::string(SCREE_ADMIN_PROGRAM) + " " + act + " --host 127.0.0.1 --token " + token +
                       " --port " + std::to_string(server_->port()));
  }
  ControlRulesRequest last_wish() {
    const std::scoped_lock lock(mutex_);
    return wishes_.empty() ? ControlRulesRequest{} : wishes_.back();
  }

  std::mutex mutex_;
  HostActs acts_;
  std::vector<ControlRulesRequest> wishes_;
  std::string answer_ = "demolition: 9 handlers\n";
  std::unique_ptr<LiveServer> server_;
};

TEST_F(RulesCommands, each_act_comes_to_the_rules_and_their_answer_is_printed) {
  start(true);
  EXPECT_EQ(run("rules list"), (std::pair<int, std::string>{0, "demolition: 9 handlers\n"}));
  EXPECT_EQ(last_wish().control, RulesControl::list);
  EXPECT_EQ(run("rules reload").first, 0);
  EXPECT_EQ(last_wish().control, RulesControl::reload);
  answer_ = "2";
  EXPECT_EQ(run("rules console 'return 1 + 1' --rules demolition").second, "2\n");
  EXPECT_EQ(last_wish().control, RulesControl::console);
  EXPECT_EQ(last_wish().line, "return 1 + 1");
  EXPECT_EQ(last_wish().rules, "demolition");
  const auto json = nlohmann::json::parse(run("--json rules console x").second, nullptr, false);
  EXPECT_EQ(json["text"], "2");
  EXPECT_TRUE(last_wish().rules.empty());
}

TEST_F(RulesCommands, control_characters_of_an_answer_do_not_come_to_the_terminal) {
  start(true);
  answer_ = "red \x1B[31m\ttab\\\nfine: Türme\n\xFF\n";
  EXPECT_EQ(run("rules console x").second, "red \\x1b[31m\\ttab\\\\\nfine: Türme\n\\xff\n");
}

TEST_F(RulesCommands, misuse_refusals_and_servers_without_rules_have_their_exit_codes) {
  start(false);
  const auto [code, said] = run("rules list");
  EXPECT_EQ(code, exit_failed);
  EXPECT_TRUE(holds(said, "runs no rules")) << said;
  EXPECT_EQ(run("rules list", "another-admin-token").first, exit_failed);
  EXPECT_EQ(run("rules").first, exit_misused);
  EXPECT_EQ(run("rules console").first, exit_misused);
  EXPECT_EQ(run("rules console ''").first, exit_misused);
  EXPECT_EQ(run("rules console x --rules " + std::string(40, 'y')).first, exit_misused);
  EXPECT_EQ(run("rules console " + std::string(4097, 'x')).first, exit_misused);
  const auto [status, help] = run_program(std::string(SCREE_ADMIN_PROGRAM) + " rules --help");
  EXPECT_EQ(status, 0);
  for (const char* const act : {"list", "reload", "console"}) EXPECT_TRUE(holds(help, act)) << help;
}

TEST(RulesText, of_clean_lines_nothing_changes) {
  EXPECT_EQ(rules_lines(""), "");
  EXPECT_EQ(rules_lines("a\\b"), "a\\b\n");
  EXPECT_EQ(rules_lines("a\n\nb\n"), "a\n\nb\n");
  EXPECT_EQ(rules_lines(std::string("nul \0 and dir \xE2\x80\xAE", 16)), "nul \\x00 and dir \\xe2\\x80\n")
      << "cut in the middle of a character";
  EXPECT_TRUE(nlohmann::json::accept(rules_json("\xFF\x1B")));
}

}  // namespace
}  // namespace scree
