// What a server keeps for its administrators line by line: what they did, its log, its figures, its settings.
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "client/admin/admin.h"
#include "server/app/audit_trail.h"
#include "server/app/figure_hour.h"
#include "server/app/limits.h"
#include "server/app/live_server.h"
#include "server/log/limits.h"
#include "server/log/log.h"
#include "server/log/log_config.h"
#include "server/log/recent_lines.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* token = "the-admin-token";

std::string file_text(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(AuditTrail, goes_on_where_its_file_ends_and_the_file_is_its_owner_s_alone) {
  const TestFolder folder;
  const std::string path = folder / "hill.world.audit";
  {
    auto trail = AuditTrail::open(path);
    ASSERT_TRUE(trail) << trail.error().message;
    trail->add("session 3 (Ann)", "kicks session 4: \"no\"\n\xff");
  }
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  auto trail = AuditTrail::open(path);
  ASSERT_TRUE(trail);
  trail->add("session 5", "sets gravity=1");
  ASSERT_EQ(trail->lines().size(), 2U);
  const Json first = Json::parse(trail->lines().front());
  EXPECT_EQ(first["who"], "session 3 (Ann)");
  EXPECT_TRUE(holds(first["act"].get<std::string>(), "kicks session 4: \"no\"\n"));
  EXPECT_EQ(file_text(path), trail->lines()[0] + "\n" + trail->lines()[1] + "\n");
}

TEST(AuditTrail, a_torn_line_and_foreign_ones_are_left_and_not_shown) {
  const TestFolder folder;
  const std::string path = folder / "hill.world.audit";
  std::ofstream(path) << "{\"act\":\"a\"}\nscribble\n{\"act\":\"to";
  auto trail = AuditTrail::open(path);
  ASSERT_TRUE(trail);
  trail->add("x", "b");
  ASSERT_EQ(trail->lines().size(), 2U);
  EXPECT_TRUE(holds(file_text(path), "scribble\n{\"act\":\"to\n{\"time\""));
}

TEST(AuditTrail, a_long_file_is_put_aside_once) {
  const TestFolder folder;
  const std::string path = folder / "hill.world.audit";
  std::ofstream(path) << std::string(limits::audit_bytes_max + 1, ' ') << "\n";
  auto trail = AuditTrail::open(path);
  ASSERT_TRUE(trail);
  trail->add("x", "b");
  EXPECT_EQ(fs::file_size(path + ".1"), limits::audit_bytes_max + 2);
  EXPECT_EQ(file_text(path), trail->lines().back() + "\n");
}

TEST(AuditTrail, memory_keeps_the_newest_and_a_folder_in_its_place_takes_none) {
  const TestFolder folder;
  auto trail = AuditTrail::open("");
  ASSERT_TRUE(trail);
  for (int i = 0; i < 2000; ++i) trail->add("somebody", "act " + std::to_string(i));
  size_t bytes = 0;
  for (const std::string& line : trail->lines()) bytes += line.size();
  EXPECT_LE(bytes, limits::audit_kept_bytes);
  EXPECT_EQ(Json::parse(trail->lines().back())["act"], "act 1999");
  fs::create_directory(folder / "taken");
  EXPECT_FALSE(AuditTrail::open(folder / "taken"));
}

TEST(RecentLines, are_the_newest_and_a_long_message_is_cut) {
  begin_log({}, "test");
  for (int i = 0; i < 1000; ++i) log_of(LogPart::chat, 7).info("line {} {}", i, std::string(200, 'x'));
  log_of(LogPart::net).info("{}", std::string(limits::recent_message_bytes_max + 100, 'y'));
  const std::vector<std::string> lines = recent_lines();
  size_t bytes = 0;
  for (const std::string& line : lines) bytes += line.size();
  EXPECT_LE(bytes, limits::recent_bytes_max);
  EXPECT_GT(lines.size(), 100U);
  EXPECT_EQ(Json::parse(lines.back())["message"].get<std::string>().size(), limits::recent_message_bytes_max);
  const Json before = Json::parse(lines[lines.size() - 2]);
  EXPECT_EQ(before["session"], 7);
  EXPECT_EQ(before["part"], "chat");
  EXPECT_TRUE(holds(before["message"].get<std::string>(), "line 999 "));
}

TEST(FigureHour, a_sample_is_what_happened_since_the_one_before) {
  FigureHour hour;
  EXPECT_TRUE(hour.is_due(5.0));
  ServerReport report;
  report.seconds = 2.0;
  hour.sample(5.0, report, 0.0);
  EXPECT_FALSE(hour.is_due(5.0 + limits::figure_sample_s - 0.1));
  report.seconds = 12.0;
  report.ticks = 600;
  report.late_ticks = 3;
  report.net.bytes_out = 10'000;
  for (int i = 0; i < 600; ++i) report.whole_tick.add(2.0);
  hour.sample(15.0, report, 7.5);
  const auto lines = hour.lines();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(Json::parse(lines[0])["tick_ms"].is_null()) << lines[0];
  const Json second = Json::parse(lines[1]);
  EXPECT_EQ(second["tick_ms"], 2.0);
  EXPECT_EQ(second["tick_ms_max"], 7.5);
  EXPECT_EQ(second["late"], 3);
  EXPECT_EQ(second["sent_bytes_s"], 1000.0);
  for (size_t i = 0; i < limits::figure_samples_max; ++i) hour.sample(20.0, report, 0.0);
  EXPECT_EQ(hour.lines().size(), limits::figure_samples_max);
}

class AdminRecords : public ::testing::Test {
 protected:
  void start(const std::string& world = {}) {
    server.reset();
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.sim_threads = 1;
    config.world_path = world;
    config.net.admin_token = token;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server = std::move(*started);
    target.port = server->port();
    target.token = token;
  }
  std::vector<Json> read(LinesOf of, uint32_t most = 0) {
    const auto text = list_lines(target, {of, most});
    EXPECT_TRUE(text) << text.error().message;
    const auto json = text ? lines_json(*text) : Result<std::string>("[]");
    EXPECT_TRUE(json);
    return Json::parse(json.value_or("[]")).get<std::vector<Json>>();
  }

  const TestFolder folder;
  std::unique_ptr<LiveServer> server;
  AdminServer target;
};

TEST_F(AdminRecords, acts_of_administrators_are_kept_over_a_restart) {
  start(folder / "hill.world");
  ASSERT_TRUE(change_settings(target, {{"air-drag", "5"}}));
  EXPECT_FALSE(change_settings(target, {{"air-drag", "-1"}})) << "refused: not noted";
  EXPECT_FALSE(kick_session(target, {12345, "no"})) << "nobody is there: not noted";
  ASSERT_TRUE(ban_address(target, {.address = "192.0.2.7", .minutes = 5, .reason = "griefing"}));
  ASSERT_TRUE(lift_ban(target, {"192.0.2.7"}));
  static_cast<void>(ask_history(target, UndoRequest{.mode = UndoMode::preview, .by = "Ann"}));  // a look
  EXPECT_FALSE(ask_history(target, UndoRequest{.mode = UndoMode::keep_others, .by = "Ann"})) << "not noted";
  EXPECT_FALSE(ask_history(target, UndoRequest{.mode = UndoMode::stop})) << "not noted";
  ASSERT_TRUE(ask_world(target, CarveRequest{.shape = sphere({0.0F, 0.0F, 0.0F}, 1.5F)}));
  const auto undone = ask_history(
      target,
      UndoRequest{
          .mode = UndoMode::over_others, .to_tick = 1, .lo_m = glm::vec3(-20.0F), .hi_m = glm::vec3(20.0F)});
  ASSERT_TRUE(undone) << undone.error().message;
  start(folder / "hill.world");
  std::vector<std::string> acts;
  for (const Json& act : read(LinesOf::audit)) {
    acts.push_back(act["act"]);
    EXPECT_TRUE(holds(act["who"].get<std::string>(), "session ")) << act;
    EXPECT_TRUE(holds(act["who"].get<std::string>(), "from 127.0.0.1")) << act;
  }
  ASSERT_EQ(acts.size(), 4U) << Json(acts).dump(1);
  EXPECT_EQ(acts[0], "sets air-drag=5");
  EXPECT_TRUE(acts[1].starts_with("bans 192.0.2.7 until ") && acts[1].ends_with(": griefing")) << acts[1];
  EXPECT_EQ(acts[2], "lifts the ban of 192.0.2.7");
  EXPECT_TRUE(acts[3].starts_with("takes back edits, to tick 1 in the box -20,-20,-20 to 20,20,20") &&
              holds(acts[3], ": undo 1 takes back "))
      << acts[3];
  EXPECT_EQ(read(LinesOf::audit, 1).size(), 1U);
  const auto text = lines_text(*list_lines(target, {LinesOf::audit, 1}), LinesOf::audit);
  EXPECT_TRUE(text && holds(*text, "undo 1 takes back"));
}

TEST_F(AdminRecords, regions_are_noted_once_the_world_has_them) {
  start();
  SetRegionRequest set;
  set.region.name = "gate";
  const auto done = ask_world(target, set);
  ASSERT_TRUE(done) << done.error().message;
  ASSERT_TRUE(ask_world(target, RemoveRegionRequest{"gate"}));
  static_cast<void>(ask_world(target, RemoveRegionRequest{"gate"}));  // refused: there is none
  const std::vector<Json> acts = read(LinesOf::audit);
  ASSERT_EQ(acts.size(), 2U);
  EXPECT_EQ(acts[0]["act"], "sets the region gate");
  EXPECT_EQ(acts[1]["act"], "removes the region gate");
}

TEST_F(AdminRecords, a_server_that_cannot_keep_them_leaves_no_files) {
  fs::create_directory(folder / "hill.world.audit");
  LiveConfig config;
  config.world.terrain = flat_terrain;
  config.world_path = folder / "hill.world";
  const auto started = LiveServer::start(config);
  ASSERT_FALSE(started);
  EXPECT_TRUE(holds(started.error().message, "hill.world.audit: it is a folder"));
  EXPECT_FALSE(fs::exists(folder / "hill.world"));
  EXPECT_FALSE(fs::exists(folder / "hill.world.history"));
}

TEST_F(AdminRecords, settings_have_bounds_choices_and_help) {
  start();
  bool has_choice = false, has_number = false, has_text = false;
  for (const Json& setting : read(LinesOf::settings)) {
    EXPECT_FALSE(setting["help"].get<std::string>().empty());
    EXPECT_TRUE(setting.contains("value")) << setting;
    if (setting["name"] == "collider") has_choice = setting["choices"].size() > 1;
    if (setting["name"] == "pieces-max") has_number = setting["least"] < setting["greatest"];
    if (setting["name"] == "spawn") has_text = setting.contains("may_be");
  }
  EXPECT_TRUE(has_choice && has_number && has_text);
  const auto text = lines_text(*list_lines(target, {LinesOf::settings, 0}), LinesOf::settings);
  EXPECT_TRUE(text && holds(*text, "pieces-max"));
}

TEST_F(AdminRecords, figures_come_by_themselves) {
  start();
  std::vector<Json> samples;
  for (const Within within(60.0); samples.empty() && !within.over(); wait_a_moment())
    samples = read(LinesOf::figures);
  ASSERT_FALSE(samples.empty());
  EXPECT_TRUE(samples[0].contains("memory_mb"));
  const auto text = lines_text(*list_lines(target, {LinesOf::figures, 0}), LinesOf::figures);
  EXPECT_TRUE(text && holds(*text, "tick ms"));
}

TEST_F(AdminRecords, nobody_else_reads_them) {
  start();
  target.token.clear();
  for (const LinesOf of : all_kinds<LinesOf>) EXPECT_FALSE(list_lines(target, {of, 0})) << name_of(of);
}

TEST(AdminLines, a_servers_lines_are_not_trusted) {
  EXPECT_FALSE(lines_json("[1]\n"));
  EXPECT_FALSE(lines_text("{\"time\":\n", LinesOf::log));
  const auto text = lines_text("{\"time\":7,\"who\":\"\\u001b[2J\",\"act\":[1]}\n", LinesOf::audit);
  ASSERT_TRUE(text);
  EXPECT_EQ(text->find('\x1b'), std::string::npos) << *text;
}

}  // namespace
}  // namespace scree
