// A bot and the rules of a game: what it says to them, what it hears and sees, and what its report has of it.
#include <gtest/gtest.h>
#include <mutex>
#include <nlohmann/json.hpp>

#include "client/bot/bot.h"
#include "client/bot/bot_options.h"
#include "client/bot/limits.h"
#include "server/app/live_server.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

using namespace std::chrono_literals;

/// Rules that answer each message, and show a bar and a marker.
class BotRules : public ::testing::Test {
 protected:
  void SetUp() override {
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.pacing = Pacing::by_hand;
    config.hooks.heard = [this](uint64_t session, const ChannelData& data) {
      std::string text(data.bytes.begin(), data.bytes.end());
      text = std::to_string(session) + " said " + text;
      EXPECT_TRUE(server_->push(rules(Notice{{.kind = AudienceKind::session, .session = session},
                                             ChannelData{data.channel, {text.begin(), text.end()}}})));
    };
    config.hooks.said = [this](const SaidMessage& line) {
      const std::scoped_lock lock(said_mutex_);
      said_.push_back(line.name + ": " + line.text);
      return true;
    };
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server_ = std::move(*started);
  }

  static Command rules(RulesAct act) { return {0, 0, RulesRequest{std::move(act)}}; }

  template <typename F>
  bool go_on_until(Bot& bot, F&& condition) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end || !server_->step_once()) return false;
      if (!bot.step(1ms)) return false;
    }
    return true;
  }

  std::mutex said_mutex_;  ///< lines come on the network's thread
  std::vector<std::string> said_;
  std::unique_ptr<LiveServer> server_;
};

TEST_F(BotRules, it_says_what_it_was_told_and_reports_what_it_hears_and_sees) {
  BotConfig config;
  config.port = server_->port();
  config.carves = 0;
  config.hears_s = 0.01;
  config.messages = {{"shop", {'b', 'u', 'y'}}};
  std::vector<std::string> log;
  Bot bot(config, [&](const std::string& line) { log.push_back(line); });
  ASSERT_TRUE(bot.join());
  Sign bar{.name = "score", .kind = SignKind::bar, .text = "12 of 40 t"};
  bar.share = 0.25F;
  Sign marker{.name = "tower", .kind = SignKind::marker, .text = "here"};
  marker.place_m = {1.0F, 2.0F, 3.0F};
  ASSERT_TRUE(server_->push(rules(ShowSign{bar})) && server_->push(rules(ShowSign{marker})));
  ASSERT_TRUE(server_->push(rules(Notice{{}, Cue{}})));
  ASSERT_TRUE(go_on_until(bot, [&] {
    const BotReport report = bot.report();
    return report.rules.messages > 0 && report.signs.size() == 2 && report.rules.cues > 0 && bot.finished();
  }));
  const auto json = nlohmann::json::parse(to_json(bot.report()))["rules"];
  EXPECT_EQ(json["heard"][0]["channel"], "shop");
  EXPECT_TRUE(std::string(json["heard"][0]["data"]).ends_with(" said buy")) << json;
  EXPECT_EQ(json["signs"][0]["text"], "12 of 40 t");
  EXPECT_EQ(json["signs"][0]["share"], 0.25);
  EXPECT_EQ(json["signs"][1]["kind"], "marker");
  EXPECT_EQ(json["signs"][1]["place_m"], (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(json["cues"], 1);
  EXPECT_EQ(json["messages"], 1);
  EXPECT_TRUE(std::ranges::any_of(log, [](const std::string& line) {
    return line.starts_with("shop: ") && line.ends_with(" said buy");
  }));
}

TEST_F(BotRules, its_lines_are_said_to_everybody) {
  BotConfig config;
  config.port = server_->port();
  config.carves = 0;
  config.name = "anna";
  config.lines = {"good morning", "/claim"};
  config.hears_s = 60.0;
  Bot bot(config);
  ASSERT_TRUE(bot.join());
  const auto said = [this] {
    const std::scoped_lock lock(said_mutex_);
    return said_;
  };
  ASSERT_TRUE(go_on_until(bot, [&] { return said().size() == 2; }));
  EXPECT_EQ(said(), (std::vector<std::string>{"anna: good morning", "anna: /claim"}));
}

TEST_F(BotRules, messages_beyond_those_of_a_report_are_counted_and_odd_bytes_harmless) {
  BotConfig config;
  config.port = server_->port();
  config.carves = 0;
  Bot bot(config);
  ASSERT_TRUE(bot.join());
  const size_t many = limits::bot_heard_max + 20;
  for (size_t i = 0; i < many; ++i) {
    ASSERT_TRUE(server_->push(rules(Notice{{}, ChannelData{"odd", {0xFF, 0, 0x1B, '['}}})));
    if (i % 200 == 199) {
      ASSERT_TRUE(server_->step_once());
    }
  }
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.report().rules.messages == many; }));
  EXPECT_EQ(bot.report().rules.heard.size(), limits::bot_heard_max);
  EXPECT_TRUE(nlohmann::json::accept(to_json(bot.report())));
}

std::variant<BotOptions, int> parsed(std::vector<std::string> words) {
  words.insert(words.begin(), "scree-bot");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return parse_bot_options(static_cast<int>(argv.size()), argv.data());
}

TEST(BotRulesOptions, messages_are_pairs_of_a_channel_and_a_text) {
  const auto options = parsed({"--message", "shop", "buy 1", "--message", "shop", "", "--hear", "2.5"});
  const auto* const bot = std::get_if<BotOptions>(&options);
  ASSERT_NE(bot, nullptr);
  ASSERT_EQ(bot->bot.messages.size(), 2U);
  EXPECT_EQ(bot->bot.messages[0], (ChannelData{"shop", {'b', 'u', 'y', ' ', '1'}}));
  EXPECT_TRUE(bot->bot.messages[1].bytes.empty());
  EXPECT_EQ(bot->bot.hears_s, 2.5);
  testing::internal::CaptureStderr();
  EXPECT_EQ(std::get<int>(parsed({"--message", "shop"})), 2);
  EXPECT_EQ(std::get<int>(parsed({"--message", std::string(40, 'x'), "text"})), 2);
  EXPECT_EQ(std::get<int>(parsed({"--message", "shop", std::string(5000, 'x')})), 2);
  EXPECT_EQ(std::get<int>(parsed({"--say", std::string(201, 'x')})), 2);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("--message"), std::string::npos);
}

}  // namespace
}  // namespace scree
