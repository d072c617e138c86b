// Settings: one table for everything, changed while running, recorded, and replayed to the same hashes; over
// the wire only for those who know the token.
#include "server/world/settings.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <unistd.h>

#include "client/admin/admin.h"
#include "server/app/live_server.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/recorder.h"
#include "server/work/limits.h"
#include "shared/base/limits.h"
#include "shared/base/token.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

const std::string good_token = "a-token-of-some-length";

Command change(const SettingValues& settings) {
  return {1, 7, SettingsRequest{settings}};
}

/// A table of rock that stands on one leg, and the cut through the leg.
Command fill(const Shape& shape) {
  return {1, 1, FillRequest{shape}};
}
std::vector<Command> table_on_a_leg(float x_m) {
  return {fill(box({x_m, 1.0F, 0.0F}, {0.5F, 1.2F, 0.5F})), fill(box({x_m, 2.5F, 0.0F}, {1.5F, 0.5F, 1.5F}))};
}
Command cut_leg(float x_m) {
  CarveRequest carve;
  carve.shape = sphere({x_m, 1.0F, 0.0F}, 0.9F);
  carve.seeds = 4;
  carve.impact_m = {x_m, 1.0F, 1.0F};
  return {1, 2, carve};
}

int64_t islands_in(const TickDelta& delta) {
  return std::ranges::count_if(delta.operations, [](const AppliedOperation& applied) {
    return std::holds_alternative<IslandOperation>(applied.operation);
  });
}

TEST(settings, every_one_prints_what_it_was_set_to_and_says_what_it_may_be) {
  std::set<std::string_view> names;
  for (const Setting& setting : settings()) {
    SCOPED_TRACE(setting.name);
    EXPECT_TRUE(names.insert(setting.name).second);
    EXPECT_LE(setting.name.size(), limits::setting_name_bytes_max);
    EXPECT_FALSE(setting.help.empty());
    WorldConfig config;
    EXPECT_TRUE(setting.parse(setting.print(WorldConfig{}), config));
    EXPECT_EQ(config, WorldConfig{});
    EXPECT_NE(setting.choices.size(), 1U);
    for (const std::string_view value : setting.tried) {
      WorldConfig other;
      ASSERT_TRUE(setting.parse(value, other));
      EXPECT_EQ(setting.print(other), value);
    }
    const Result<void> refused = set(config, {std::string(setting.name), "sideways"});
    ASSERT_FALSE(refused);
    EXPECT_TRUE(holds(refused.error().message, std::string(setting.name) + " is "))
        << refused.error().message;
    EXPECT_EQ(config, WorldConfig{});
  }
  EXPECT_LE(settings().size(), limits::settings_max);
  EXPECT_EQ(print(WorldConfig{}).size(), settings().size());
}

TEST(settings, are_changed_all_or_none) {
  WorldConfig config;
  const auto refusal = [&](const SettingValues& values) {
    const Result<void> done = set_all(config, values);
    return done ? "" : done.error().message;
  };
  EXPECT_TRUE(holds(refusal({{"impacts", "false"}, {"gravity", "1"}}),
                    "no setting 'gravity'; there are collider, impacts"));
  EXPECT_TRUE(holds(refusal({{"impacts", "false"}, {"dents", "no"}}), "dents is false or true, not 'no'"));
  EXPECT_TRUE(holds(refusal({{"dents", "false"}, {"dents", "true"}}), "dents is set twice"));
  EXPECT_TRUE(holds(refusal(SettingValues(limits::settings_max + 1)), "limits.settings_max"));
  EXPECT_EQ(config, WorldConfig{});
  EXPECT_EQ(refusal({{"dents", "false"}, {"impacts", "false"}}), "");
  EXPECT_EQ(config.methods.dents, false);
  EXPECT_EQ(config.methods.impacts, false);
  EXPECT_EQ(config.methods.islands, true);
}

TEST(settings, a_number_out_of_its_bounds_is_refused_naming_them) {
  WorldConfig config;
  const auto refusal = [&](const char* name, const char* value) {
    const Result<void> done = set(config, {name, value});
    return done ? "" : done.error().message;
  };
  for (const char* value : {"0", "20001", "-3", "1.5", "", "12x", " 12", "nan", "inf", "1e99"}) {
    const std::string wanted = "pieces-max is 1 to 20000 pieces, whole, not '" + std::string(value) + "'";
    EXPECT_EQ(refusal("pieces-max", value), wanted);
  }
  EXPECT_TRUE(holds(refusal("requests-per-second", "0.09"), "is 0.1 to 1000000 requests a second"));
  EXPECT_EQ(config, WorldConfig{});
  for (const char* value : {"1", "20000"}) {
    EXPECT_EQ(refusal("pieces-max", value), "");
    EXPECT_EQ(std::to_string(config.pieces_max), value);
  }
  EXPECT_EQ(refusal("requests-per-second", "0.1"), "");
  EXPECT_EQ(config.service.requests_per_second, 0.1);
}

TEST(settings, support_without_islands_is_refused_whichever_is_set) {
  WorldConfig config;
  const auto refusal = [&](const SettingValues& values) {
    const Result<void> done = set_all(config, values);
    return done ? "" : done.error().message;
  };
  EXPECT_TRUE(holds(refusal({{"support", "true"}, {"islands", "false"}}), "support needs islands"));
  EXPECT_TRUE(holds(refusal({{"islands", "false"}, {"support", "true"}}), "support needs islands"));
  EXPECT_EQ(config, WorldConfig{});
  EXPECT_EQ(refusal({{"support", "true"}}), "");
  EXPECT_TRUE(holds(refusal({{"islands", "false"}}), "support needs islands"));
  EXPECT_TRUE(config.methods.islands);
  EXPECT_EQ(refusal({{"islands", "false"}, {"support", "false"}}), "") << "as a whole it makes sense";
  EXPECT_TRUE(holds(refusal({{"support", "true"}}), "support needs islands"));
  EXPECT_EQ(refusal({{"support", "true"}, {"islands", "true"}}), "");
}

TEST(settings, a_lower_limit_of_pieces_holds_from_the_next_request_on) {
  World world(flat_world());
  const auto carving = [](float x_m) {
    Command command = cut_leg(x_m);
    std::get<CarveRequest>(command.body).shape = sphere({x_m, 0.0F, 0.0F}, 0.9F);
    return std::vector<Command>{command};
  };
  EXPECT_EQ(world.step(carving(0.0F))->replies.front().refusal, "");
  const std::vector<Command> lower{change({{"pieces-max", "5"}})};
  EXPECT_EQ(world.step(lower)->replies.front().refusal, "");
  EXPECT_TRUE(holds(world.step(carving(5.0F))->replies.front().refusal, "limit is 5"));
  const std::vector<Command> higher{change({{"pieces-max", "50"}})};
  world.step(higher);
  EXPECT_EQ(world.step(carving(5.0F))->replies.front().refusal, "");
}

TEST(settings, what_clients_are_granted_is_published_and_changes_no_hash) {
  World one(flat_world()), other(flat_world());
  EXPECT_EQ(one.step({})->service, ServiceLimits{});
  other.step({});
  const std::vector<Command> fewer{change({{"requests-per-second", "2.5"}, {"sessions-max", "3"}})};
  const std::vector<Command> nothing{change({})};
  const auto changed = one.step(fewer), same = other.step(nothing);
  EXPECT_EQ(changed->service, (ServiceLimits{3, 2.5}));
  EXPECT_EQ(changed->settings, print(one.config()));
  EXPECT_FALSE(same->service.has_value());
  EXPECT_EQ(changed->state_hash, same->state_hash);
}

TEST(settings, a_world_publishes_them_at_first_and_when_they_change) {
  World world(flat_world());
  EXPECT_EQ(world.step({})->settings, print(WorldConfig{}));
  EXPECT_TRUE(world.step({})->settings.empty());
  const std::vector<Command> same{change({{"dents", "true"}})};
  EXPECT_TRUE(world.step(same)->settings.empty());
  const std::vector<Command> other{change({{"dents", "false"}})};
  const auto delta = world.step(other);
  EXPECT_EQ(delta->settings, print(world.config()));
  EXPECT_EQ(delta->replies.front().refusal, "");
  EXPECT_FALSE(world.config().methods.dents);
  const std::vector<Command> wrong{change({{"dents", "true"}, {"impacts", "maybe"}})};
  EXPECT_TRUE(holds(world.step(wrong)->replies.front().refusal, "impacts is false or true"));
  EXPECT_FALSE(world.config().methods.dents);
}

TEST(settings, what_was_cut_off_while_islands_were_off_falls_when_they_are_switched_on) {
  WorldConfig config = flat_world();
  config.methods.islands = false;
  World world(config);
  for (const float x_m : {0.0F, 20.0F}) {
    world.step(table_on_a_leg(x_m));
    const std::vector<Command> cut{cut_leg(x_m)};
    world.step(cut);
    for (int i = 0; i < 60; ++i) ASSERT_EQ(islands_in(*world.step({})), 0);
  }
  const std::vector<Command> on{change({{"islands", "true"}})};
  int64_t fell = islands_in(*world.step(on));
  for (int i = 0; i < 10; ++i) fell += islands_in(*world.step({}));
  EXPECT_GE(fell, 2);
}

class SettingsSession : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() /
             ("scree_settings_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  std::string file(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name) << content;
    return (folder / name).string();
  }
  fs::path folder;
};

TEST_F(SettingsSession, a_recording_verifies_though_settings_changed_in_the_middle) {
  const std::string path = (folder / "session.scree").string();
  WorldConfig config = flat_world();
  config.methods.islands = false;
  const std::map<Tick, std::vector<Command>> script{
      {2, table_on_a_leg(0.0F)},
      {4, {cut_leg(0.0F)}},
      {60, {change({{"islands", "true"}, {"impacts", "false"}, {"collider", "mesh"}, {"pieces-max", "6"}})}},
      {90, {change({{"impacts", "no"}})}},
      {130, {change({{"impacts", "true"}, {"collider", "rays"}}), cut_leg(3.0F)}},
  };
  auto recorder = Recorder::create(path, {"test", config});
  ASSERT_TRUE(recorder) << recorder.error().message;
  World world(config);
  uint64_t state_hash = 0;
  for (Tick tick = 1; tick <= 200; ++tick) {
    const auto commands = script.find(tick);
    const auto delta = world.step(commands == script.end() ? std::vector<Command>{} : commands->second);
    state_hash = delta->state_hash;
    (*recorder)->push(delta, commands == script.end() ? std::vector<Command>{} : commands->second);
  }
  ASSERT_TRUE((*recorder)->finish());
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ((*reader)->header().world, config);
  const auto report = verify(**reader);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->agrees()) << report->difference;
  EXPECT_EQ(report->commands, 7U);
  EXPECT_EQ(report->state_hash, state_hash);
  // A replay that starts in the middle knows them, too.
  auto source = ReplaySource::open(path, 100);
  ASSERT_TRUE(source) << source.error().message;
  const auto keyframe = (*source)->next();
  ASSERT_TRUE(keyframe && *keyframe);
  WorldConfig then = config;
  then.methods.islands = true;
  then.methods.impacts = false;
  then.methods.collider = TerrainColliderKind::mesh;
  then.pieces_max = 6;
  EXPECT_EQ((*keyframe)->settings, print(then));
}

TEST_F(SettingsSession, tokens_come_from_the_first_line_of_a_file_and_are_checked) {
  const auto refusal = [&](const std::string& content) {
    const auto read = read_token(file("token", content));
    return read ? "" : read.error().message;
  };
  EXPECT_EQ(*read_token(file("token", good_token + "\r\nmore\n")), good_token);
  EXPECT_TRUE(holds(refusal("short\n"), "limits.token_bytes_min"));
  for (const size_t more : {1, 40})
    EXPECT_TRUE(holds(refusal(std::string(limits::token_bytes_max + more, 'x')), "8 to 128 characters"));
  EXPECT_TRUE(holds(refusal("with spaces in it"), "printable"));
  EXPECT_FALSE(read_token((folder / "none").string()));
}

TEST(settings, tokens_are_the_same_only_when_they_are) {
  EXPECT_TRUE(same_token("abcdefgh", "abcdefgh"));
  for (const char* wrong : {"", "abcdefg", "abcdefgi", "abcdefghh", "abcdefghabcdefgh", "bbcdefgh"})
    EXPECT_FALSE(same_token(wrong, "abcdefgh")) << wrong;
}

class AdminSession : public SettingsSession {
 protected:
  void start(const std::string& token) {
    LiveConfig config;
    config.world = flat_world();
    config.net.admin_token = token;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server = std::move(*started);
    target.port = server->port();
    target.within = std::chrono::seconds(60);
  }
  AdminServer as(const std::string& token) const {
    AdminServer bearer = target;
    bearer.token = token;
    return bearer;
  }
  std::string refusal(const std::string& token, const SettingValues& changes) const {
    const auto changed = change_settings(as(token), changes);
    return changed ? "" : changed.error().message;
  }
  std::unique_ptr<LiveServer> server;
  AdminServer target;
};

TEST_F(AdminSession, whoever_knows_the_token_changes_settings_and_everybody_sees_them) {
  start(good_token);
  WorldConfig wanted;
  ASSERT_EQ(read_settings(target).value(), print(wanted));
  wanted.methods.dents = wanted.methods.islands = false;
  const auto changed = change_settings(as(good_token), {{"dents", "false"}, {"islands", "false"}});
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(*changed, print(wanted));
  EXPECT_EQ(read_settings(target).value(), print(wanted));
  EXPECT_TRUE(holds(refusal(good_token, {{"dents", "5"}}), "dents is false or true"));
  EXPECT_TRUE(holds(refusal(good_token, {{"colour", "red"}}), "no setting 'colour'"));
  ASSERT_TRUE(server->stop());
  EXPECT_EQ(server->report().settings, print(wanted));
  EXPECT_TRUE(holds(to_json(server->report()), "\"dents\": \"false\""));
}

TEST_F(AdminSession, numbers_are_changed_like_choices_and_support_is_refused_without_islands) {
  start(good_token);
  WorldConfig wanted;
  wanted.pieces_max = 300;
  wanted.service.requests_per_second = 7.5;
  const auto changed =
      change_settings(as(good_token), {{"pieces-max", "300"}, {"requests-per-second", "7.5"}});
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(*changed, print(wanted));
  EXPECT_TRUE(holds(refusal(good_token, {{"pieces-max", "0"}}), "pieces-max is 1 to 20000 pieces"));
  EXPECT_TRUE(
      holds(refusal(good_token, {{"support", "true"}, {"islands", "false"}}), "support needs islands"));
  EXPECT_EQ(read_settings(target).value(), print(wanted));
}

TEST_F(AdminSession, status_says_what_the_ticks_had_to_do) {
  start("");
  const auto status = read_status(target);
  ASSERT_TRUE(status) << status.error().message;
  const auto budget_us = static_cast<uint32_t>(0.01F * limits::work_percent_max * 1e6F / 60.0F);
  EXPECT_EQ(status->work.budget_us, budget_us);
  EXPECT_EQ(status->clients, 0U) << "who asks does not count itself";
  EXPECT_TRUE(holds(status_json(*status), "\"budget_us\": " + std::to_string(budget_us)));
  EXPECT_TRUE(holds(status_lines(*status), "work.budget_us             " + std::to_string(budget_us) + "\n"));
  StatusMessage told = *status;
  told.latency.worst.sending_us = 1234;
  EXPECT_TRUE(holds(status_lines(told), "request_ms.sending_worst   1.234\n"));
  const int64_t most = std::numeric_limits<int64_t>::max();
  const std::string digits = std::to_string(most);
  told.materials = MaterialLedger({{most, most, most, most, -most}, {1, 2, 3, 4, 5}});
  EXPECT_TRUE(holds(status_lines(told, {std::string(32, 'x'), "clay"}),
                    "materials." + std::string(32, 'x') + " terrain=" + digits + " pieces=" + digits +
                        " dust=" + digits + " poured=" + digits + " converted=-" + digits +
                        "\nmaterials.clay             terrain=1 pieces=2 dust=3 poured=4 converted=5\n"))
      << status_lines(told);
}

TEST_F(AdminSession, whoever_does_not_is_refused) {
  start(good_token);
  EXPECT_TRUE(holds(refusal("another-token-of-length", {{"dents", "false"}}),
                    "the server refused: this server does not know the token"));
  EXPECT_TRUE(holds(refusal(good_token, {{"dents", "false"}}), "the server checks the next one in"))
      << "who guesses waits, and so does who knows it, at that address";
  EXPECT_TRUE(holds(refusal("", {{"dents", "false"}}), "takes the role admin: this session is a builder"));
  EXPECT_EQ(read_settings(target).value(), print(WorldConfig{}));
}

TEST_F(AdminSession, a_server_without_a_token_refuses_everybody) {
  start("");
  for (const std::string& token : {good_token, std::string()})
    EXPECT_TRUE(holds(refusal(token, {{"dents", "false"}}), "started without an admin token"));
  EXPECT_EQ(read_settings(target).value(), print(WorldConfig{}));
}

}  // namespace
}  // namespace scree
