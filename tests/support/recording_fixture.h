// A small world simulated, and recorded to a file of its own, for tests of recordings.
#pragma once

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include "server/store/database.h"
#include "server/store/recorder.h"
#include "server/store/recording_reader.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"

namespace scree {

inline WorldConfig small_world() {
  WorldConfig config = flat_world();
  config.pieces_max = 100;
  return config;
}

inline Command carve_at(float x_m, uint32_t request) {
  CarveRequest carve;
  carve.shape = sphere({x_m, 0.0F, 0.0F}, 1.0F);
  carve.seeds = 6;
  carve.random_seed = request;
  carve.impact_m = {x_m, 1.0F, 0.0F};
  return {1, request, carve};
}

inline std::vector<char> read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_file(const std::filesystem::path& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

class RecordingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() /
             ("scree_recording_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    path = (folder / "session.scree").string();
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// Simulates `ticks` ticks with a carve now and then, none after `busy`; keeps what was published.
  void simulate(Tick ticks, Tick busy = std::numeric_limits<Tick>::max()) {
    World world(small_world());
    for (Tick tick = 1; tick <= ticks; ++tick) {
      std::vector<Command> commands;
      if (tick % 100 == 10 && tick <= busy)
        commands = {carve_at(static_cast<float>(tick % 7), static_cast<uint32_t>(tick)),
                    {2, 1, FillRequest{sphere({-8.0F, 1.0F, 0.0F}, 1.0F)}}};
      deltas.push_back(world.step(commands));
      commands_by_tick.push_back(std::move(commands));
    }
  }
  void record(const WorldConfig& config = small_world()) {
    auto recorder = Recorder::create(path, {"test", config});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    for (size_t i = 0; i < deltas.size(); ++i) (*recorder)->push(deltas[i], commands_by_tick[i]);
    const auto finished = (*recorder)->finish();
    ASSERT_TRUE(finished.has_value()) << finished.error().message;
  }
  std::string refusal() const {
    auto reader = RecordingReader::open(path);
    return reader ? std::string() : reader.error().message;
  }
  void expect_refused(const std::string& because) const {
    const std::string reason = refusal();
    EXPECT_NE(reason.find(because), std::string::npos) << reason;
    EXPECT_NE(reason.find(path), std::string::npos) << reason;
  }

  RecordedFrame recorded_frame(Tick tick) const {
    auto reader = RecordingReader::open(path);
    const auto frame = reader ? (*reader)->frame(tick) : tl::unexpected(reader.error());
    EXPECT_TRUE(frame.has_value()) << frame.error().message;
    return frame ? *frame : RecordedFrame{};
  }
  /// Replaces a row of the recording, with the right checksum.
  void put_recorded(const std::string& table, Tick tick, const std::vector<uint8_t>& data) const {
    auto database = Database::open(path);
    ASSERT_TRUE(database.has_value()) << database.error().message;
    const auto replace =
        database->prepare("REPLACE INTO " + table + " (tick, data, checksum) VALUES (?1, ?2, ?3)");
    ASSERT_TRUE(replace.has_value() && database->put(*replace, tick, data).has_value());
  }

  std::filesystem::path folder;
  std::string path;
  std::vector<std::shared_ptr<const TickDelta>> deltas;
  std::vector<std::vector<Command>> commands_by_tick;
};

}  // namespace scree
