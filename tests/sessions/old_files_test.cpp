// Files of every format in tests/data open: grounds, worlds and recordings, with the hashes that they had
// when they were made (docs/compatibility.md).
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/support/server_process.h"
#include "server/app/ground_giver.h"
#include "server/formats/world_codec.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/world_upgrade.h"
#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

/// A ground, a world on it, and recordings of that world, by the names in their folder.
struct OldFiles {
  const char* folder;
  const char* name;
  const char* program;  ///< that made the world
  const char* ground_hash;
  std::vector<const char*> recordings;
  Tick tick;  ///< at which the world was saved, the last of the recordings
  uint64_t field_hash;
  uint64_t state_hash;
  bool has_log;   ///< of events, in each recording
  bool verifies;  ///< the simulation is still the one that recorded it
};

const std::vector<OldFiles>& old_files() {
  static const std::vector<OldFiles> all = {
      {"format_1",
       "hills",
       "scree-server 0.1.0",
       "02ef571e351c683da0bc4abe8a96636cc0744de9e0d035501d277dcd5556cae3",
       {"hills.scree", "hills_cut.scree"},
       119,
       0xF952F7D9DD608F1E,
       0x1A69C3DF94A34FD2,
       false,
       false},
      {"0.2.0",
       "dune",
       "scree-server 0.2.0",
       "83060714fba6d0d1f5234405700e89bd9f38ceb9f8d3b9451ace3057f118dbf3",
       {"dune.scree"},
       86,
       0xF5F11B4E3CEB51C5,
       0x301B0EFA3581E0D8,
       true,
       false},
      {"format_2",
       "hills",
       "scree-server 0.2.0",
       "d608d388e03637fb9130bd8f2850f723a5909c8e49968f9c0cc8447b50282cf4",
       {"hills.scree", "hills_cut.scree"},
       119,
       0x1378DFA96508E289,
       0xA0E74AC3003E4F87,
       true,
       false},
      {"format_3",
       "hills",
       "scree-server 0.2.0",
       "3789ee47b86fbddc90db3458edcca89ed71a599d2959dd6b7cded9ace17916bc",
       {"hills.scree", "hills_cut.scree"},
       119,
       0x61957F713B65D4BA,
       0x843344DF45FC3BF4,
       true,
       false},
      {"format_4",
       "hills",
       "scree-server 0.2.0",
       "3789ee47b86fbddc90db3458edcca89ed71a599d2959dd6b7cded9ace17916bc",
       {"hills.scree", "hills_cut.scree"},
       119,
       0xDF0232E5B71A991B,
       0x11BDC6786466E983,
       true,
       true},
      {"format_5",
       "hills",
       "scree-server 0.2.0",
       "3789ee47b86fbddc90db3458edcca89ed71a599d2959dd6b7cded9ace17916bc",
       {"hills.scree", "hills_cut.scree"},
       179,
       0xE7FF139BBA81A193,
       0x026F4F8376C84037,
       true,
       true}};
  return all;
}

class OldFilesTest : public ::testing::TestWithParam<OldFiles> {
 protected:
  void SetUp() override {
    fs::copy(source(), fs::path(folder / "files"), fs::copy_options::recursive);
    ::setenv("XDG_DATA_HOME", (folder / "data").c_str(), 1);
  }
  void TearDown() override { ::unsetenv("XDG_DATA_HOME"); }

  static fs::path source() { return fs::path(SCREE_SOURCE_DIR) / "tests/data" / GetParam().folder; }
  std::string file(const std::string& name) const { return folder / ("files/" + name); }
  std::string world() const { return file(std::string(GetParam().name) + ".world"); }
  /// Runs a program, which has to end well, and returns its report.
  nlohmann::json said(const std::string& program, const std::string& arguments) const {
    const auto [code, text] = run_program(program + " " + arguments + " --json");
    EXPECT_EQ(code, 0) << text;
    auto json = nlohmann::json::parse(text, nullptr, false);
    return json.is_discarded() ? nlohmann::json::object() : json;
  }

  TestFolder folder;
};

TEST_P(OldFilesTest, its_world_is_whole_and_a_server_goes_on_with_it) {
  const std::string program = SCREE_WORLD_PROGRAM;
  EXPECT_EQ(said(program, "check " + world()).value("whole", false), true);
  const auto info = said(program, "info " + world());
  EXPECT_EQ(info.at("made_by"), GetParam().program);
  EXPECT_EQ(info.at("terrain"), std::string("ground ") + GetParam().ground_hash);
  EXPECT_EQ(info.at("tick"), GetParam().tick);
  EXPECT_EQ(std::stoull(info.at("field_hash").get<std::string>(), nullptr, 16), GetParam().field_hash);
  EXPECT_EQ(std::stoull(info.at("state_hash").get<std::string>(), nullptr, 16), GetParam().state_hash);
  EXPECT_EQ(info.at("ledger_error"), 0);
  EXPECT_GT(info.at("pieces_alive"), 0);
  const std::string recording = file(GetParam().recordings.front());
  {
    ServerProcess server(SCREE_SERVER_PROGRAM, {"--world", world(), "--record", recording, "--ticks", "20"});
    EXPECT_NE(server.port(), 0);
    EXPECT_EQ(server.end(0, 60.0), 0);  // it ends by itself, after its ticks
  }
  EXPECT_GT(said(program, "info " + world()).at("tick"), GetParam().tick);
  EXPECT_EQ(said(program, "info " + world()).at("format"), world_format)
      << "what saves it brings it up to date";
  const std::string before = name_of_older(world());
  EXPECT_EQ(fs::exists(before), info.at("format") != world_format);
  if (fs::exists(before)) {
    const auto kept = said(program, "info " + before);
    EXPECT_EQ(kept.at("format"), info.at("format"));
    EXPECT_EQ(kept.at("state_hash"), info.at("state_hash"));
    EXPECT_EQ(said(program, "check " + before).value("whole", false), true);
  }
  if (!GetParam().verifies) return;
  const auto report = said(SCREE_REPLAY_PROGRAM, "verify " + recording);
  EXPECT_EQ(report.at("agrees"), true) << "the recording goes on, too";
  EXPECT_EQ(report.at("restarts"), 1);
}

TEST_P(OldFilesTest, its_recordings_play_to_the_same_hashes) {
  for (const std::string name : GetParam().recordings) {
    SCOPED_TRACE(name);
    const auto giver = ground_giver(file(name), WorldConfig());
    auto reader = RecordingReader::open(file(name));
    ASSERT_TRUE(reader.has_value()) << reader.error().message;
    EXPECT_EQ((*reader)->last_tick(), GetParam().tick);
    EXPECT_TRUE((*reader)->is_ended());
    EXPECT_TRUE(!GetParam().has_log || (*reader)->events_from().has_value());
    if (GetParam().verifies) {
      const auto report = verify(**reader, {}, giver);
      ASSERT_TRUE(report.has_value()) << report.error().message;
      EXPECT_TRUE(report->agrees()) << report->difference;
      EXPECT_EQ(report->field_hash, GetParam().field_hash);
      EXPECT_EQ(report->state_hash, GetParam().state_hash);
    }
    auto source = ReplaySource::open(file(name), (*reader)->first_tick(), giver);
    ASSERT_TRUE(source.has_value()) << source.error().message;
    uint64_t field_hash = 0, state_hash = 0;
    for (auto tick = (*source)->next(); tick && *tick; tick = (*source)->next()) {
      field_hash = (*tick)->field_hash;
      state_hash = (*tick)->state_hash;
    }
    EXPECT_EQ(field_hash, GetParam().field_hash);
    EXPECT_EQ(state_hash, GetParam().state_hash);
  }
}

INSTANTIATE_TEST_SUITE_P(Data, OldFilesTest, ::testing::ValuesIn(old_files()), [](const auto& info) {
  std::string name = info.param.folder;
  std::ranges::replace(name, '.', '_');
  return name;
});

/// A folder that nobody opens would be forgotten. tests/ground opens the two of other programs' files.
TEST(OldFiles, every_folder_of_tests_data_is_opened) {
  std::set<std::string> there, opened{"import", "rasters"};
  for (const auto& entry : fs::directory_iterator(fs::path(SCREE_SOURCE_DIR) / "tests/data"))
    if (entry.is_directory()) there.insert(entry.path().filename());
  for (const OldFiles& files : old_files()) opened.insert(files.folder);
  EXPECT_EQ(there, opened);
}

}  // namespace
}  // namespace scree
