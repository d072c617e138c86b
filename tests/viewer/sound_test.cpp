// What pieces do is found, and written to a file of sound that is whole at any time.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "client/mirror/predictions.h"
#include "client/viewer/base/limits.h"
#include "client/viewer/events/piece_event_detector.h"
#include "client/viewer/sound/sounds.h"
#include "shared/operation/operation.h"
#include "tests/support/wave_samples.h"

namespace scree {
namespace {

constexpr size_t second = Synthesiser::rate_hz;

float peak(const std::vector<float>& samples) {
  float most = 0.0F;
  for (const float sample : samples) most = std::max(most, std::abs(sample));
  return most;
}

/// Root mean square of the samples.
float loudness(const std::vector<float>& samples) {
  double sum = 0.0;
  for (const float sample : samples) sum += static_cast<double>(sample) * static_cast<double>(sample);
  return static_cast<float>(std::sqrt(sum / static_cast<double>(samples.size())));
}

/// Pieces of a carve, which a test moves.
class PieceWatchTest : public testing::Test {
 protected:
  PieceWatchTest() {
    PieceTable table;
    apply(CarveOperation{sphere({}, 2.0F), SeedPattern::uniform, 8, 5, {}, 1}, field_, table);
    for (const auto& [id, volume] : table)
      broken_off_[id] = {volume, {volume->centre_voxels * voxel_m, {1.0F, 0.0F, 0.0F, 0.0F}}};
  }
  std::vector<PieceEvent> step(const ScenePieces& pieces, const SceneProps& props = no_props()) {
    now_s_ += frame_s;
    return piece_events_.step(Scene{field_, pieces, props}, now_s_);
  }
  static constexpr float voxel_m = 0.25F;
  static constexpr double frame_s = 1.0 / 60.0;
  MapField field_{{TerrainKind::flat, 1, voxel_m}};
  ScenePieces broken_off_;
  PieceEventDetector piece_events_;
  double now_s_ = 100.0;
};

TEST_F(PieceWatchTest, pieces_crack_off_strike_and_settle_once_each) {
  ASSERT_FALSE(broken_off_.empty());
  EXPECT_TRUE(step({}).empty());
  const std::vector<PieceEvent> cracks = step(broken_off_);
  ASSERT_EQ(cracks.size(), std::min(broken_off_.size(), limits::piece_events_per_step_max));
  EXPECT_EQ(cracks[0].kind, PieceEventKind::crack);
  EXPECT_GT(cracks[0].impulse_n_s, 0.0F);
  ScenePieces falling = broken_off_;
  float speed_m_s = 0.0F;
  for (int i = 0; i < 30; ++i) {
    speed_m_s -= 9.81F * static_cast<float>(frame_s);
    for (auto& [id, piece] : falling) piece.pose.position_m.y += speed_m_s * static_cast<float>(frame_s);
    EXPECT_TRUE(step(falling).empty()) << "falling is silent, frame " << i;
  }
  const std::vector<PieceEvent> strikes = step(falling);  // all stop at once
  ASSERT_FALSE(strikes.empty());
  EXPECT_EQ(strikes[0].kind, PieceEventKind::strike);
  for (int i = 0; i < 30; ++i) EXPECT_TRUE(step(falling).empty()) << "lying is silent, frame " << i;
  const std::vector<PieceEvent> ends = step({});
  ASSERT_FALSE(ends.empty());
  EXPECT_EQ(ends[0].kind, PieceEventKind::settle);
  EXPECT_TRUE(step({}).empty());
}

TEST_F(PieceWatchTest, a_machine_that_draws_once_a_second_hears_and_one_that_slept_does_not) {
  step({});
  now_s_ += 1.0;
  EXPECT_FALSE(step(broken_off_).empty());
  now_s_ += 60.0;
  EXPECT_TRUE(step({}).empty());
}

TEST_F(PieceWatchTest, props_strike_and_do_no_more) {
  Prop crate;
  crate.parts.push_back({.half_m = glm::vec3(0.5F)});
  crate.mass_kg = 300.0F;
  Prop lift = crate;
  lift.motion = PropMotion::kinematic;
  const Pose up{{0.0F, 20.0F, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}};
  SceneProps props{{5, {std::make_shared<const Prop>(crate), up}},
                   {6, {std::make_shared<const Prop>(lift), up}}};
  EXPECT_TRUE(step({}).empty());
  EXPECT_TRUE(step({}, props).empty()) << "they come without a crack";
  float speed_m_s = 0.0F;
  for (int i = 0; i < 40; ++i) {
    speed_m_s -= 9.81F * static_cast<float>(frame_s);
    for (auto& [id, prop] : props) prop.pose.position_m.y += speed_m_s * static_cast<float>(frame_s);
    EXPECT_TRUE(step({}, props).empty()) << "falling is silent, frame " << i;
  }
  const std::vector<PieceEvent> strikes = step({}, props);  // both stop
  ASSERT_EQ(strikes.size(), 1U) << "what a kinematic one does is no blow";
  EXPECT_EQ(strikes[0].kind, PieceEventKind::strike);
  EXPECT_EQ(strikes[0].piece, 5U);
  EXPECT_NEAR(strikes[0].size_m, 1.0F, 0.01F);
  EXPECT_EQ(strikes[0].mass_kg, 300.0F);
  EXPECT_TRUE(step({}).empty()) << "they go without a sound";
}

TEST_F(PieceWatchTest, the_heaviest_of_a_frame_come_first) {
  step({});
  const std::vector<PieceEvent> cracks = step(broken_off_);
  ASSERT_GT(cracks.size(), 2U);
  EXPECT_TRUE(std::ranges::is_sorted(cracks, std::ranges::greater{}, &PieceEvent::impulse_n_s));
}

TEST_F(PieceWatchTest, a_world_that_is_shown_for_the_first_time_is_silent) {
  EXPECT_TRUE(step(broken_off_).empty());
  piece_events_.begin();
  EXPECT_TRUE(step({}).empty());
  now_s_ += 10.0;  // nobody listened
  EXPECT_TRUE(step(broken_off_).empty());
}

TEST_F(PieceWatchTest, a_predicted_break_happens_once) {
  ASSERT_TRUE(step({}).empty());
  constexpr PieceId predicted = 0xC0000000U;
  ASSERT_TRUE(Predictions::is_predicted(predicted));
  ScenePieces foreseen;
  for (const auto& [id, piece] : broken_off_) foreseen[predicted + id] = piece;
  EXPECT_EQ(step(foreseen).size(), broken_off_.size());
  EXPECT_TRUE(step(broken_off_).empty()) << "the server's pieces take their places";
  EXPECT_EQ(step({}).size(), broken_off_.size()) << "they merge";
  step(foreseen);
  EXPECT_TRUE(step({}).empty()) << "a prediction that is taken back";
}

TEST_F(PieceWatchTest, a_blast_written_to_a_file_is_a_wav_of_its_length_and_loudness) {
  const std::string path = (std::filesystem::path(testing::TempDir()) / "scree_blast.wav").string();
  Result<Sounds> sounds = Sounds::begin(false, path);
  ASSERT_TRUE(sounds) << sounds.error().message;
  EXPECT_FALSE(sounds->silent());
  Camera camera;
  camera.eye_m = {0.0F, 2.0F, 8.0F};
  for (int i = 0; i <= 120; ++i)
    sounds->step(step(i < 30 ? ScenePieces{} : broken_off_), camera, 50.0 + static_cast<double>(i) * frame_s);
  ASSERT_TRUE(sounds->finish());
  const std::vector<float> samples = samples_in(path);
  std::filesystem::remove(path);
  EXPECT_EQ(samples.size(), 2 * second * Synthesiser::channels);
  const std::vector<float> before(samples.begin(), samples.begin() + static_cast<long>(second / 2));
  const std::vector<float> blast(samples.begin() + static_cast<long>(second), samples.end());
  EXPECT_EQ(peak(before), 0.0F);
  EXPECT_GT(peak(blast), 0.05F);
  EXPECT_LE(peak(blast), Synthesiser::peak_max + 1e-3F);
  EXPECT_GT(loudness(blast), 0.003F);
  EXPECT_LT(loudness(blast), 0.4F);
}

TEST(WaveFile, is_whole_after_every_append) {
  const std::string path = (std::filesystem::path(testing::TempDir()) / "scree_whole.wav").string();
  Result<WaveFile> file = WaveFile::create(path, Synthesiser::rate_hz, 2);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(samples_in(path).empty());
  for (size_t i = 1; i <= 3; ++i) {
    file->append(std::vector<float>(10, 0.25F * static_cast<float>(i)));
    const std::vector<float> samples = samples_in(path);  // as if the program had been killed now
    ASSERT_EQ(samples.size(), 10 * i);
    EXPECT_NEAR(samples.back(), 0.25F * static_cast<float>(i), 1e-4F);
  }
  EXPECT_TRUE(file->finish());
  std::filesystem::remove(path);
}

TEST(Sounds, without_a_device_nothing_is_played_and_nothing_fails) {
  ::setenv("ALSOFT_DRIVERS", "none-such", 1);
  Result<Sounds> sounds = Sounds::begin(true, "");
  ::unsetenv("ALSOFT_DRIVERS");
  ASSERT_TRUE(sounds) << sounds.error().message;
  EXPECT_TRUE(sounds->silent());
  sounds->step({}, {}, 1.0);
  EXPECT_TRUE(sounds->finish());
}

TEST(Sounds, a_file_that_cannot_be_written_is_said) {
  const Result<Sounds> sounds = Sounds::begin(false, "/no/such/folder/sound.wav");
  ASSERT_FALSE(sounds);
  EXPECT_NE(sounds.error().message.find("--sound-file"), std::string::npos);
}

}  // namespace
}  // namespace scree
