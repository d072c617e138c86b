// scree-world and scree-export as programs, and the files of this version, which later versions must open.
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/support/server_process.h"
#include "server/app/chunk_text.h"
#include "server/app/ground_giver.h"
#include "server/formats/world_codec.h"
#include "server/replay/replay_source.h"
#include "server/store/database.h"
#include "server/store/world_file.h"
#include "shared/base/regular_file.h"
#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr const char* ground_hash = "3789ee47b86fbddc90db3458edcca89ed71a599d2959dd6b7cded9ace17916bc";

class WorldProgramTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"hills.ground", "hills.world", "hills.scree", "hills_cut.scree"})
      fs::copy_file(fs::path(SCREE_SOURCE_DIR) / "tests/data/format_5" / name, folder / name);
    ::setenv("XDG_DATA_HOME", (folder / "data").c_str(), 1);
  }
  void TearDown() override { ::unsetenv("XDG_DATA_HOME"); }

  /// Runs scree-world with these arguments, and --json. What it prints is null unless it is JSON.
  struct Ran {
    int code = 0;
    std::string said;
    nlohmann::json json;
  };
  Ran run(const std::string& arguments) const {
    auto [code, said] = run_program(std::string(SCREE_WORLD_PROGRAM) + " " + arguments + " --json");
    auto json = nlohmann::json::parse(said, nullptr, false);
    return {code, said, json.is_discarded() ? nlohmann::json() : json};
  }
  void expect_whole(const std::string& path) const {
    const Ran ran = run("check " + path);
    EXPECT_EQ(ran.code, 0) << ran.said;
    EXPECT_EQ(ran.json.value("whole", false), true) << ran.said;
  }
  void spoil(const std::string& sql) const {
    auto database = Database::open(world);
    ASSERT_TRUE(database && database->execute(sql).has_value());
  }

  TestFolder folder;
  std::string world = folder / "hills.world", recording = folder / "hills.scree";
};

TEST_F(WorldProgramTest, recordings_of_this_version_play_verify_and_compare) {
  const std::string cut = folder / "hills_cut.scree", program = SCREE_REPLAY_PROGRAM;
  const auto [code, said] = run_program(program + " verify " + cut);
  EXPECT_EQ(code, 0) << said;
  auto source = ReplaySource::open(cut, 100, ground_giver(cut, WorldConfig()));
  ASSERT_TRUE(source.has_value()) << source.error().message;
  EXPECT_EQ((*source)->first_tick(), 60U);
  const auto jumped = (*source)->jump(61);
  EXPECT_TRUE(jumped.has_value()) << jumped.error().message;
  const auto [differs, text] = run_program(program + " diff " + recording + " " + cut);
  EXPECT_EQ(differs, 1) << text;
  EXPECT_NE(text.find("has the ticks 1 to 179, the other 61 to 179"), std::string::npos) << text;
  EXPECT_EQ(run_program(program + " diff " + cut + " " + cut).first, 0);
  EXPECT_EQ(run_program(program + " diff " + cut + " " + world).first, 2) << "no recording";
  EXPECT_EQ(run_program(program + " cut " + recording + " " + cut).first, 1) << "it exists";
}

TEST_F(WorldProgramTest, what_is_exported_never_takes_the_place_of_its_source) {
  const std::string program = std::string(SCREE_REPLAY_PROGRAM) + " export ", csv = folder / "old.csv";
  const auto bytes = fs::file_size(recording);
  for (const std::string& out : {recording, recording + "-wal", (folder / "./hills.scree")}) {
    const auto [code, said] = run_program(program + recording + " --events " + out);
    EXPECT_EQ(code, 1) << said;
    EXPECT_NE(said.find("are one file"), std::string::npos) << said;
  }
  EXPECT_EQ(run_program(program + recording + " --events " + csv + " --ticks " + csv).first, 1);
  EXPECT_EQ(fs::file_size(recording), bytes);
  std::ofstream(csv) << "before";
  EXPECT_EQ(run_program(program + "missing.scree --events " + csv).first, 1);
  EXPECT_EQ(fs::file_size(csv), 6U) << "what failed leaves what was there";
  EXPECT_EQ(run_program(program + recording + " --events " + csv).first, 0);
  EXPECT_GT(fs::file_size(csv), 6U);
  fs::copy_file(recording, folder / "same.ply");
  const auto [code, said] = run_program(std::string(SCREE_EXPORT_PROGRAM) + " " + (folder / "same.ply") +
                                        " --tick 100 -o " + (folder / "same.ply"));
  EXPECT_NE(said.find("are one file"), std::string::npos) << said;
  EXPECT_EQ(fs::file_size(folder / "same.ply"), bytes);
}

TEST_F(WorldProgramTest, files_of_this_version_are_opened_and_go_on) {
  expect_whole(world);
  const Ran before = run("info " + world);
  ASSERT_EQ(before.code, 0) << before.said;
  EXPECT_EQ(before.json.at("format"), world_format);
  EXPECT_EQ(before.json.at("terrain"), std::string("ground ") + ground_hash);
  EXPECT_EQ(before.json.at("ledger_error"), 0);
  EXPECT_GT(before.json.at("chunks_edited"), 0);
  EXPECT_GT(before.json.at("pieces_alive"), 0);
  auto source = ReplaySource::open(recording, 0, ground_giver(recording, WorldConfig()));
  ASSERT_TRUE(source.has_value()) << source.error().message;
  Tick last = 0;
  for (auto tick = (*source)->next(); tick && *tick; tick = (*source)->next()) last = (*tick)->tick;
  EXPECT_EQ(last, before.json.at("tick"));
  EXPECT_EQ(last, (*source)->last_tick());
  {
    ServerProcess server(SCREE_SERVER_PROGRAM, {"--world", world, "--ticks", "20"});
    EXPECT_NE(server.port(), 0);
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  expect_whole(world);
  EXPECT_GE(run("info " + world).json.at("tick"), last);
}

TEST_F(WorldProgramTest, a_chunk_is_dumped_as_text) {
  const std::string program = std::string(SCREE_WORLD_PROGRAM) + " dump-chunk " + world + " ";
  const auto file = WorldFile::open(world);
  ASSERT_TRUE(file) << file.error().message;
  std::optional<WorldChunk> edited;
  ASSERT_TRUE((*file)->each_chunk([&](const WorldChunk& chunk) -> Result<void> {
    if (!edited) edited = chunk;
    return {};
  }));
  ASSERT_TRUE(edited);
  const auto [x, y, z] = edited->chunk;
  const auto [code, said] = run_program(fmt::format("{} {},{},{}", program, x, y, z));
  EXPECT_EQ(code, 0) << said;
  EXPECT_EQ(said, chunk_text(edited->chunk, edited->bricks));
  const auto [untouched, none] = run_program(program + "1000,-1000,1000");
  EXPECT_EQ(untouched, 0) << none;
  EXPECT_EQ(none, "chunk (1000, -1000, 1000): 0 edited bricks; all others are the ground's\n");
  for (const char* wrong : {"1,2", "1,2,3,4", "1,2,x", ""})
    EXPECT_EQ(run_program(program + wrong).first, 2) << wrong;
}

TEST_F(WorldProgramTest, a_ground_elsewhere_is_given_and_a_missing_one_is_named) {
  fs::create_directories(folder / "elsewhere");
  const std::string ground = folder / "elsewhere/hills.ground";
  fs::rename(folder / "hills.ground", ground);
  EXPECT_EQ(run("info " + world).code, 0) << "what it holds is said without the ground";
  const Ran missing = run("check " + world);
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.said.find(ground_hash), std::string::npos) << missing.said;
  EXPECT_EQ(run("check " + world + " --ground " + ground).code, 0);
  EXPECT_EQ(run("check " + world + " --ground " + world).code, 1) << "that is no ground";
}

TEST_F(WorldProgramTest, damage_is_named_and_repair_keeps_the_rest) {
  spoil("UPDATE chunks SET checksum = checksum + 1 WHERE key = (SELECT min(key) FROM chunks)");
  const Ran damaged = run("check " + world);
  EXPECT_EQ(damaged.code, 1);
  EXPECT_EQ(damaged.json.value("whole", true), false) << damaged.said;
  EXPECT_NE(damaged.json.value("damage", "").find("chunks"), std::string::npos) << damaged.said;
  const std::string repaired = folder / "repaired.world";
  const Ran ran = run("repair " + world + " " + repaired);
  ASSERT_EQ(ran.code, 0) << ran.said;
  EXPECT_EQ(ran.json.at("lost").size(), 1U);
  EXPECT_GT(ran.json.at("chunks_kept"), 0);
  expect_whole(repaired);
  EXPECT_EQ(run("repair " + world + " " + repaired).code, 1) << "it exists already";
  const Ran foreign = run("repair " + recording + " " + (folder / "again.world"));
  EXPECT_EQ(foreign.code, 1);
  EXPECT_NE(foreign.said.find(recording), std::string::npos) << foreign.said;
  EXPECT_EQ(foreign.said.find("-copy"), std::string::npos) << "the user's file is named: " << foreign.said;
}

TEST_F(WorldProgramTest, backup_and_compact_leave_the_world_as_it_is) {
  const auto hash = run("info " + world).json.at("state_hash");
  const std::string copy = folder / "copy.world";
  const Ran copied = run("backup " + world + " " + copy);
  EXPECT_EQ(copied.code, 0) << copied.said;
  EXPECT_EQ(run("info " + copy).json.at("state_hash"), hash);
  spoil("CREATE TABLE room (data BLOB); INSERT INTO room VALUES (zeroblob(200000)); DROP TABLE room");
  const Ran compacted = run("compact " + world);
  ASSERT_EQ(compacted.code, 0) << compacted.said;
  EXPECT_LT(compacted.json.at("bytes"), compacted.json.at("bytes_before"));
  EXPECT_EQ(run("info " + world).json.at("state_hash"), hash);
}

TEST_F(WorldProgramTest, a_world_is_rolled_back_and_made_anew_by_its_recording) {
  const std::string other = folder / "other.world";
  const Ran made = run("new " + other + " --from " + recording + " --to 20");
  ASSERT_EQ(made.code, 0) << made.said;
  EXPECT_EQ(made.json.at("tick"), 20);
  expect_whole(other);
  EXPECT_EQ(run("rollback " + world + " --from " + recording).code, 2) << "without --to";
  const Ran rolled = run("rollback " + world + " --from " + recording + " --to 20");
  ASSERT_EQ(rolled.code, 0) << rolled.said;
  expect_whole(world);
  expect_whole(rolled.json.at("before"));
  EXPECT_EQ(run("info " + world).json.at("state_hash"), run("info " + other).json.at("state_hash"));
}

TEST_F(WorldProgramTest, a_kept_world_is_exported_with_its_ground_and_not_without) {
  const auto exported = [&](const std::string& arguments) {
    return run_program(std::string(SCREE_EXPORT_PROGRAM) + " " + world + " " + arguments);
  };
  const std::string mesh = folder / "hills.ply", volume = folder / "hills.vdb";
  const auto [code, said] = exported("-o " + mesh);
  ASSERT_EQ(code, 0) << said;
  EXPECT_GT(nlohmann::json::parse(said).at("triangles"), 0) << said;
  EXPECT_GT(fs::file_size(mesh), 0U);
  EXPECT_EQ(exported("-o " + volume + " --box 0,-8,0,16,8,16").first, 0);
  EXPECT_GT(fs::file_size(volume), 0U);
  EXPECT_EQ(exported("-o " + (folder / "hills.tiff")).first, 1) << "a kind that cannot be written";
  EXPECT_EQ(exported("").first, 2);
  fs::rename(folder / "hills.ground", folder / "ground.moved");
  const auto without = exported("-o " + mesh);
  EXPECT_EQ(without.first, 1);
  EXPECT_NE(without.second.find(ground_hash), std::string::npos) << without.second;
  EXPECT_EQ(exported("-o " + mesh + " --ground " + (folder / "ground.moved")).first, 0);
}

TEST_F(WorldProgramTest, the_terrain_of_a_tick_of_a_recording_is_exported) {
  const auto exported = [&](const std::string& arguments) {
    return run_program(std::string(SCREE_EXPORT_PROGRAM) + " " + recording + " " + arguments);
  };
  const std::string volume = folder / "hills.vdb", early = folder / "early.vdb";
  const auto [code, said] = exported("--tick 20 -o " + volume);
  ASSERT_EQ(code, 0) << said;
  EXPECT_EQ(nlohmann::json::parse(said).at("tick"), 20) << said;
  ASSERT_EQ(exported("--tick 0 -o " + early).first, 0);
  const auto content = [](const std::string& file) { return read_bytes_of(file, size_t{16} << 20U).value(); };
  EXPECT_NE(content(volume), content(early)) << "something was edited in between";
  const auto beyond = exported("--tick 100000 -o " + early);
  EXPECT_EQ(beyond.first, 1);
  EXPECT_NE(beyond.second.find("there is no tick 100000"), std::string::npos) << beyond.second;
  EXPECT_EQ(exported("-o " + early).first, 1) << "without a tick it is no world";
}

TEST_F(WorldProgramTest, what_cannot_be_printed_is_an_error) {
  for (const std::string& program :
       {SCREE_WORLD_PROGRAM " info " + world, SCREE_REPLAY_PROGRAM " info " + recording,
        SCREE_REPLAY_PROGRAM " events " + recording}) {
    const auto [code, said] = run_program("sh -c '" + program + " > /dev/full'");
    EXPECT_EQ(code, 1) << program;
    EXPECT_NE(said.find("cannot be written"), std::string::npos) << said;
  }
}

TEST_F(WorldProgramTest, a_world_that_cannot_be_read_for_want_of_room_is_not_called_damaged) {
  // SQLite keeps 32 KiB beside a file that it opens.
  const auto [code, said] =
      run_program("sh -c 'ulimit -f 8; " SCREE_WORLD_PROGRAM " check " + world + " --json'");
  EXPECT_EQ(code, 1) << said;
  EXPECT_NE(said.find("File too large"), std::string::npos) << said;
  EXPECT_EQ(said.find("whole"), std::string::npos) << said;
  expect_whole(world);
}

TEST_F(WorldProgramTest, an_empty_argument_is_wrong_usage) {
  const std::string cut =
      std::string(SCREE_REPLAY_PROGRAM) + " cut " + recording + " " + (folder / "cut.scree");
  EXPECT_EQ(run_program(cut + " --from ''").first, 2);
  EXPECT_EQ(run("check ''").code, 2);
  EXPECT_FALSE(fs::exists(folder / "cut.scree"));
}

TEST_F(WorldProgramTest, a_recording_and_its_cut_are_the_same_where_both_have_ticks) {
  const auto [code, said] = run_program(std::string(SCREE_REPLAY_PROGRAM) + " diff " + recording + " " +
                                        (folder / "hills_cut.scree"));
  EXPECT_EQ(code, 1) << said;
  EXPECT_NE(said.find("which both have, are the same"), std::string::npos) << said;
}

TEST_F(WorldProgramTest, wrong_usage_is_2_and_what_is_no_world_is_1) {
  EXPECT_EQ(run("").code, 2);
  EXPECT_EQ(run("mend " + world).code, 2);
  EXPECT_EQ(run("info").code, 2);
  EXPECT_EQ(run("--help").code, 0);
  for (const char* command : {"info ", "check ", "compact "}) {
    EXPECT_EQ(run(command + (folder / "none")).code, 1) << command;
    EXPECT_EQ(run(command + recording).code, 1) << command;
  }
  EXPECT_FALSE(fs::exists(folder / "none"));
}

}  // namespace
}  // namespace scree
