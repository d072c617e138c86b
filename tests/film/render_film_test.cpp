// Films of a small recording: what stands in their files, and what does not when they fail.
#include "tools/film/render_film.h"

#include <csignal>

#include "client/render/grid/grid_shape.h"
#include "client/viewer/base/camera_text.h"
#include "client/viewer/pictures/png.h"
#include "tests/support/loaded_libraries.h"
#include "tests/support/recording_fixture.h"
#include "tests/support/run_program.h"
#include "tests/support/wave_samples.h"
#include "tools/film/stop_signals.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

const Stopped never = [] { return false; };
const auto unseen = [](double) {};

bool has_partial(const fs::path& folder) {
  return std::ranges::any_of(fs::directory_iterator(folder),
                             [](const auto& entry) { return entry.path().extension() == ".partial"; });
}

/// A carve in front of a fixed camera.
class FilmPictures : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    pin_libraries();
    simulate(40);
    record();
  }
  /// Six frames about the carve of tick 10.
  FilmOptions options(const std::string& out) const {
    FilmOptions options{.recording = path};
    options.order = {.from = TickOrTime{8.0, false},
                     .to = TickOrTime{20.0, false},
                     .frames_per_s = 30.0,
                     .camera = *parse_camera("3,2,6,0,-20")};
    options.drawn = {
        .size = {64, 48}, .method = method_named("mesh"), .quality = Quality::low, .view_radius_m = 8.0F};
    options.format = {
        .file = (folder / out).string(), .width = 64, .height = 48, .frames_per_s = 30.0, .quality = 80};
    return options;
  }
  RenderedFilm rendered(const FilmOptions& options) const {
    auto film = render_film(options, never, unseen);
    EXPECT_TRUE(film.has_value()) << film.error().message;
    return film ? std::move(*film) : RenderedFilm();
  }
  std::vector<char> frame(const std::string& of, size_t number) const {
    return read_file(folder / of / ("00000" + std::to_string(number) + ".png"));
  }
  /// Nothing but the recording.
  bool left_nothing() const {
    return std::ranges::none_of(fs::directory_iterator(folder), [](const auto& entry) {
      return entry.path().filename().string().starts_with("film");
    });
  }
};

TEST_F(FilmPictures, two_films_have_the_same_frames) {
  EXPECT_EQ(rendered(options("a/")).plan.span.frames, 6U);
  // One that begins earlier has the same moments later.
  FilmOptions earlier = options("b/");
  earlier.order.from = TickOrTime{4.0, false};
  EXPECT_EQ(rendered(earlier).plan.span.frames, 8U);
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_FALSE(frame("a", i).empty());
    EXPECT_EQ(frame("a", i), frame("b", i + 2)) << i;
  }
  EXPECT_EQ(frame("a", 0), frame("b", 0)) << "nothing moves before the carve";
  EXPECT_NE(frame("a", 0), frame("a", 1)) << "tick 10 is shown as it was recorded";
  EXPECT_NE(frame("a", 2), frame("a", 3)) << "pieces fly";
}

TEST_F(FilmPictures, particles_can_be_left_out) {
  rendered(options("with/"));
  FilmOptions without = options("without/");
  without.drawn.particles = false;
  rendered(without);
  EXPECT_EQ(frame("with", 0), frame("without", 0));
  EXPECT_NE(frame("with", 5), frame("without", 5));
}

/// A recording in which a game shows a sign from tick 10 on, and makes a cue in tick 14.
void record_game(const std::string& path, bool for_all) {
  World world(small_world());
  auto recorder = Recorder::create(path, {"test", small_world()});
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  const Audience to = for_all ? Audience{} : Audience{.kind = AudienceKind::session, .session = 3};
  Sign bar{.name = "score", .to = to, .kind = SignKind::bar, .text = "12 t"};
  bar.share = 0.5F;
  bar.until = 18;
  for (Tick tick = 1; tick <= 30; ++tick) {
    std::vector<Command> commands;
    if (tick == 10) commands = {{0, 0, RulesRequest{ShowSign{bar}}}};
    if (tick == 14)
      commands = {{0, 0, RulesRequest{Notice{to, Cue{.place_m = {3.0F, 1.0F, 2.0F}, .energy_j = 1e5F}}}}};
    (*recorder)->push(world.step(commands), commands);
  }
  const auto finished = (*recorder)->finish();
  ASSERT_TRUE(finished.has_value()) << finished.error().message;
}

TEST_F(FilmPictures, a_film_shows_a_games_signs_as_long_as_they_last_and_its_cues_are_heard) {
  FilmOptions game = options("game/"), silent = options("silent/");
  game.recording = (folder / "game.scree").string();
  silent.recording = (folder / "silent.scree").string();
  record_game(game.recording, true);
  record_game(silent.recording, false);
  rendered(game);
  rendered(silent);
  // Frames of ticks 8, 10, 12, 14, 16 and 18.
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(frame("game", i) == frame("silent", i), i == 0 || i == 5) << i;
  const auto heard = [&](const char* of) {
    const std::vector<float> samples = samples_in((folder / of / "sound.wav").string());
    return std::ranges::find_if(samples, [](float sample) { return sample != 0.0F; }) - samples.begin();
  };
  EXPECT_GT(heard("game"), 3 * 1600 * 2);
  EXPECT_LT(heard("game"), 5 * 1600 * 2);
  EXPECT_EQ(heard("silent"), 6 * 1600 * 2) << "it was for somebody else";
}

TEST_F(FilmPictures, a_film_has_all_frames) {
  rendered(options("film.mp4"));
  EXPECT_FALSE(has_partial(folder));
  const auto [code, said] = run_program(
      "ffprobe -v error -count_frames -show_entries "
      "stream=width,height,nb_read_frames,r_frame_rate -of csv=p=0 " +
      (folder / "film.mp4").string());
  EXPECT_EQ(code, 0) << said;
  EXPECT_TRUE(said.starts_with("64,48,30/1,6\n")) << said;
}

std::string streams_of(const fs::path& film) {
  return run_program("ffprobe -v error -show_entries stream=codec_name,sample_rate,channels -of csv=p=0 " +
                     film.string())
      .second;
}

TEST_F(FilmPictures, a_film_sounds_as_its_pieces_break) {
  rendered(options("frames/"));
  const std::vector<float> samples = samples_in((folder / "frames" / "sound.wav").string());
  ASSERT_EQ(samples.size(), 6U * 1600U * 2U) << "as long as the film";
  // Tick 10 is shown in the second frame, and heard a little later for the way and the limiter.
  const auto heard = std::ranges::find_if(samples, [](float sample) { return sample != 0.0F; });
  EXPECT_GT(heard - samples.begin(), 1600 * 2);
  EXPECT_LT(heard - samples.begin(), 3 * 1600 * 2);
  EXPECT_GT(*std::ranges::max_element(samples), 0.02F);
  EXPECT_FALSE(has_partial(folder));

  rendered(options("film.mp4"));
  EXPECT_EQ(streams_of(folder / "film.mp4"), "h264\naac,48000,2\n");
  rendered(options("again.mp4"));
  EXPECT_EQ(read_file(folder / "film.mp4"), read_file(folder / "again.mp4"));
  FilmOptions silent = options("film.mp4");
  silent.sound = false;
  rendered(silent);
  EXPECT_EQ(streams_of(folder / "film.mp4"), "h264\n");
  silent.format.file = (folder / "silent/").string();
  rendered(silent);
  EXPECT_FALSE(fs::exists(folder / "silent" / "sound.wav"));
}

TEST_F(FilmPictures, pages_show_a_moving_picture) {
  rendered(options("film.webp"));
  rendered(options("film.gif"));
  const std::vector<char> webp = read_file(folder / "film.webp"), gif = read_file(folder / "film.gif");
  ASSERT_GT(std::min(webp.size(), gif.size()), 500U);
  EXPECT_EQ(std::string(webp.begin() + 8, webp.begin() + 12), "WEBP");
  const std::string anmf = "ANMF";
  EXPECT_NE(std::search(webp.begin(), webp.end(), anmf.begin(), anmf.end()), webp.end()) << "it moves";
  EXPECT_EQ(std::string(gif.begin(), gif.begin() + 6), "GIF89a");
}

TEST_F(FilmPictures, a_film_that_is_stopped_leaves_no_half_file) {
  for (const int asks : {0, 1, 5, 11}) {
    int left = asks;
    const auto film = render_film(
        options("film.mp4"), [&left] { return left-- <= 0; }, unseen);
    EXPECT_FALSE(film.has_value()) << asks;
    EXPECT_TRUE(left_nothing()) << asks;
  }
}

TEST_F(FilmPictures, an_encoder_that_fails_is_told_and_leaves_nothing) {
  FilmOptions odd = options("film.mp4");
  odd.format.width = odd.drawn.size.width = 63;
  const auto uneven = render_film(odd, never, unseen);
  ASSERT_FALSE(uneven.has_value());
  EXPECT_NE(uneven.error().message.find("even"), std::string::npos) << uneven.error().message;
  const auto nowhere = render_film(options("none/film.mp4"), never, unseen);
  ASSERT_FALSE(nowhere.has_value());
  EXPECT_NE(nowhere.error().message.find("none/film.mp4 cannot be written"), std::string::npos)
      << nowhere.error().message;
  FilmOptions silent = options("none/film.mp4");
  silent.sound = false;
  const auto silently = render_film(silent, never, unseen);
  ASSERT_FALSE(silently.has_value());
  EXPECT_NE(silently.error().message.find("ffmpeg ended with status"), std::string::npos)
      << silently.error().message;
  EXPECT_TRUE(left_nothing());
}

TEST(FilmStop, a_signal_is_seen_once_it_came) {
  StopSignals signals;
  EXPECT_FALSE(signals.asked());
  ::raise(SIGTERM);
  EXPECT_TRUE(signals.asked());
  EXPECT_TRUE(signals.asked());
}

// ---- options, and the program

struct Refused {
  std::string option;  ///< that is named
  std::string value;
  std::string out = "film.mp4";
};

TEST(FilmOptionTest, wrong_options_are_refused_by_name) {
  for (const Refused& wrong : std::vector<Refused>{{"--from", "soon"},
                                                   {"--to", "-5"},
                                                   {"--fps", "0"},
                                                   {"--speed", "0"},
                                                   {"--size", "12"},
                                                   {"--size", "99999x5"},
                                                   {"--camera", "1,2"},
                                                   {"--orbit", "quake"},
                                                   {"--method", "wish"},
                                                   {"--grid-resolution", "40"},
                                                   {"--grid-spacing", "odd"},
                                                   {"--quality", "best"},
                                                   {"--view-radius", "1"},
                                                   {"--encoder-quality", "0"},
                                                   {"--encoder-quality", "50", "film.gif"},
                                                   {"--encoder-quality", "50", "frames/"},
                                                   {"--particles", "perhaps"},
                                                   {"--sound", "loud"},
                                                   {"--sound", "true", "film.gif"},
                                                   {"--from", ""},
                                                   {"--eye", ""},
                                                   {"--orbit", ""},
                                                   {"--out", ".", "."},
                                                   {"--path", "/nowhere/path.json"},
                                                   {"--out", "film.avi", "film.avi"}}) {
    testing::internal::CaptureStderr();
    std::vector<const char*> arguments = {"scree-render", "session.scree", "-o", wrong.out.c_str()};
    if (wrong.option != "--out")
      arguments.insert(arguments.end(), {wrong.option.c_str(), wrong.value.c_str()});
    const auto parsed = parse_film_options(static_cast<int>(arguments.size()), arguments.data());
    const std::string said = testing::internal::GetCapturedStderr();
    ASSERT_TRUE(std::holds_alternative<int>(parsed)) << wrong.option << " " << wrong.value;
    EXPECT_EQ(std::get<int>(parsed), 2);
    EXPECT_NE(said.find(wrong.option), std::string::npos) << said;
  }
}

TEST(FilmOptions, methods_own_options_reach_the_drawing) {
  const std::array arguments = {"scree-render", "session.scree", "-o",           "film.mp4",
                                "--method",     "grid",          "--grid-scale", "4"};
  const auto parsed = parse_film_options(static_cast<int>(arguments.size()), arguments.data());
  ASSERT_TRUE(std::holds_alternative<FilmOptions>(parsed));
  EXPECT_EQ(grid_shape_of(std::get<FilmOptions>(parsed).drawn.method_options),
            (GridShape{GridShape().resolution, 4, GridShape().spacing}));
}

class FilmProgram : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    simulate(20);
    record();
  }
  std::pair<int, std::string> run(const std::string& arguments, const std::string& environment = "") const {
    return run_program(environment + " " SCREE_RENDER_PROGRAM " " + arguments);
  }
  void expect_refused(const std::string& arguments, int code, const std::string& says) const {
    const auto [ended, said] = run(arguments);
    EXPECT_EQ(ended, code) << arguments << "\n" << said;
    EXPECT_NE(said.find(says), std::string::npos) << arguments << "\n" << said;
  }
};

TEST_F(FilmProgram, wrong_usage_is_2_and_what_cannot_be_made_is_1) {
  const std::string film = " -o " + (folder / "film.mp4").string() + " ";
  expect_refused("", 2, "RECORDING");
  expect_refused(path, 2, "--out");
  expect_refused(path + film + "--orbit 1 --camera 1,2,3,4,5", 2, "camera");
  expect_refused((folder / "none.scree").string() + film, 1, "none.scree");
  expect_refused(path + film + "--to 21", 1, "0 to 20");
  expect_refused(path + film + "--orbit 99", 1, "no event 99");
}

TEST_F(FilmProgram, pictures_of_another_film_are_not_mixed_with_its_own) {
  fs::create_directories(folder / "frames");
  write_file(folder / "frames" / "notes.png", {'n'});
  write_file(folder / "frames" / "000123.png", {'p'});
  expect_refused(path + " -o " + (folder / "frames").string() + "/ --camera 0,9,9,0,0", 1, "000123.png");
  EXPECT_FALSE(fs::exists(folder / "frames" / "000000.png"));
}

TEST_F(FilmProgram, its_recording_is_not_overwritten) {
  const fs::path same = folder / "session.mp4";
  fs::rename(path, same);
  const auto before = read_file(same);
  const auto [code, said] = run(same.string() + " -o " + (folder / "." / "session.mp4").string(), "");
  EXPECT_EQ(code, 1) << said;
  EXPECT_NE(said.find("are one file"), std::string::npos) << said;
  EXPECT_EQ(read_file(same), before);
}

TEST_F(FilmProgram, without_ffmpeg_it_says_how_to_get_it) {
  const auto [code, said] = run(path + " -o " + (folder / "film.mp4").string(), "PATH=/nowhere");
  EXPECT_EQ(code, 1) << said;
  EXPECT_NE(said.find("ffmpeg"), std::string::npos) << said;
  EXPECT_NE(said.find("scree setup"), std::string::npos) << said;
  EXPECT_FALSE(has_partial(folder));
}

}  // namespace
}  // namespace scree
