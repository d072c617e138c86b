// The viewer as it runs without a window, against a whole server in this process.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "client/viewer/app.h"
#include "client/viewer/pictures/egl_context.h"
#include "client/viewer/pictures/png.h"
#include "server/app/live_server.h"
#include "tests/support/background_program.h"
#include "tests/support/loaded_libraries.h"
#include "tests/support/patience.h"
#include "tests/support/wave_samples.h"

namespace scree {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ViewerApp : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("scree_viewer_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    {
      const auto context = EglContext::create(false);
      ASSERT_TRUE(context) << context.error().message;
      pin_libraries();
    }
    LiveConfig config;
    config.net.port = 0;
    config.world.terrain.kind = TerrainKind::flat;
    auto server = LiveServer::start(config);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// Runs the viewer; its exit status, and the line of JSON that it said.
  std::pair<int, std::string> view(const std::map<std::string, std::string>& arguments) {
    std::map<std::string, std::string> values{{"--port", std::to_string(server_->port())},
                                              {"--size", "96x64"},
                                              {"--view-radius", "12"},
                                              {"--camera", "0,3,6,0,-25"},
                                              {"--offscreen", "true"},
                                              {"--gl-debug", "true"},
                                              {"--cache-mib", "0"}};
    for (const auto& [name, value] : arguments) values.insert_or_assign(name, value);
    std::vector<std::string> texts{"scree-viewer"};
    for (const auto& [name, value] : values) texts.push_back(name + "=" + value);
    std::vector<const char*> argv;
    for (const std::string& text : texts) argv.push_back(text.c_str());
    const auto parsed = parse_options(static_cast<int>(argv.size()), argv.data());
    if (const auto* exit_now = std::get_if<ExitNow>(&parsed)) return {exit_now->status, ""};
    testing::internal::CaptureStdout();
    const int status = run_offscreen(std::get<ViewerOptions>(parsed));
    const std::string said = testing::internal::GetCapturedStdout();
    // The server's log goes there, too, as this is one process.
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with('{')) return {status, line};
    return {status, ""};
  }

  std::string write_path() const {
    std::ofstream(file("path.json")) << R"({"keys": [{"time_s": 0, "camera": [0, 3, 6, 0, -25]},
                                                    {"time_s": 0.5, "camera": [2, 4, 6, 20, -25]}]})";
    return file("path.json");
  }

  fs::path folder_;
  std::unique_ptr<LiveServer> server_;
};

TEST_F(ViewerApp, screenshot_is_compared_with_its_reference) {
  ASSERT_EQ(view({{"--screenshot", file("a.png")}}).first, 0);
  const auto [status, said] = view({{"--screenshot", file("b.png")}, {"--reference", file("a.png")}});
  EXPECT_EQ(status, 0);
  EXPECT_EQ(json::parse(said)["difference"], 0.0) << said;
  EXPECT_TRUE(json::parse(said)["agrees"]) << said;

  const auto [other, said_then] =
      view({{"--camera", "0,3,6,0,60"}, {"--screenshot", file("c.png")}, {"--reference", file("a.png")}});
  EXPECT_EQ(other, 3);
  EXPECT_GT(json::parse(said_then)["difference"], 0.05) << said_then;
  EXPECT_EQ(view({{"--screenshot", file("d.png")}, {"--reference", file("none.png")}}).first, 1);
  EXPECT_EQ(
      view({{"--screenshot", file("e.png")}, {"--reference", file("a.png")}, {"--size", "64x64"}}).first, 1);
}

TEST_F(ViewerApp, flight_leaves_a_picture_of_every_frame) {
  testing::internal::CaptureStderr();
  const auto [status, _] = view({{"--path", write_path()}, {"--fps", "4"}, {"--frames", file("frames")}});
  const std::string told = testing::internal::GetCapturedStderr();
  ASSERT_EQ(status, 0);
  EXPECT_NE(told.find("wrote 3 frames"), std::string::npos) << told;
  for (const char* name : {"000000.png", "000001.png", "000002.png"}) {
    const Result<Image> image = read_png(file("frames/" + std::string(name)));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 96);
  }
  EXPECT_FALSE(fs::exists(file("frames/000003.png")));
}

TEST_F(ViewerApp, every_quality_draws_and_another_is_refused) {
  for (const char* quality : {"low", "medium", "high", "auto"}) {
    ASSERT_EQ(view({{"--quality", quality}, {"--screenshot", file("a.png")}}).first, 0) << quality;
    const Result<Image> image = read_png(file("a.png"));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 96);
  }
  EXPECT_EQ(view({{"--quality", "best"}, {"--screenshot", file("a.png")}}).first, 2);
}

TEST_F(ViewerApp, what_there_is_to_hear_is_written_to_a_file) {
  ASSERT_EQ(view({{"--sound-file", file("a.wav")}, {"--screenshot", file("a.png")}}).first, 0);
  EXPECT_GE(fs::file_size(file("a.wav")), 44U);
  EXPECT_EQ(view({{"--sound-file", "/no/such/folder/a.wav"}, {"--screenshot", file("a.png")}}).first, 2);
}

/// The program itself, ended in the middle.
TEST_F(ViewerApp, a_file_of_sound_is_whole_after_a_signal) {
  for (const int signal : {SIGTERM, SIGKILL}) {
    const std::string sound = file("ended.wav");
    fs::remove(sound);
    const BackgroundProgram viewer(
        {SCREE_VIEWER_PROGRAM, "--host=127.0.0.1", "--port=" + std::to_string(server_->port()), "--offscreen",
         "--size=96x64", "--view-radius=12", "--cache-mib=0", "--sound-file=" + sound,
         "--screenshot=" + file("never.png@pieces>=9999")},
        file("said"));
    constexpr uintmax_t enough = 100000;
    const auto deadline = std::chrono::steady_clock::now() + patience;
    // The options' check makes the file, too, and takes it away again.
    const auto is_long = [&] {
      std::error_code missing;
      const uintmax_t size = fs::file_size(sound, missing);
      return !missing && size >= enough;
    };
    while (!is_long()) ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "the viewer writes no sound";
    ::kill(viewer.number(), signal);
    siginfo_t ended{};
    ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(viewer.number()), &ended, WEXITED | WNOWAIT), 0);
    // The signal may come between samples and their header, which then tells of those before.
    EXPECT_GE(2 * samples_in(sound).size(), fs::file_size(sound) / 2) << signal;
  }
}

TEST_F(ViewerApp, time_demo_prints_a_line_of_frame_times) {
  const auto [status, said] = view({{"--path", write_path()}, {"--fps", "10"}, {"--timedemo", "true"}});
  EXPECT_EQ(status, 0);
  const json times = json::parse(said);
  EXPECT_EQ(times["frames"], 6);
  EXPECT_EQ(times["width"], 96);
  EXPECT_GT(times["draw_ms"]["median"], 0.0);
}

TEST_F(ViewerApp, options_that_need_others_say_so) {
  EXPECT_EQ(view({{"--timedemo", "true"}}).first, 2);
  EXPECT_EQ(view({{"--frames", file("frames")}}).first, 2);
  EXPECT_EQ(view({{"--reference", file("a.png")}}).first, 2);
  EXPECT_EQ(view({{"--path", file("none.json")}, {"--timedemo", "true"}}).first, 2);
  EXPECT_EQ(view({{"--path", write_path()}}).first, 2) << "shows nothing to anyone";
}

}  // namespace
}  // namespace scree
