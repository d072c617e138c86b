// Recordings on disks that die at any write or are full, and recordings with any bytes: what was committed
// plays and verifies, all else is refused by name, and nothing aborts.
#include <cstdlib>
#include <gtest/gtest.h>

#include "server/replay/recording_diff.h"
#include "server/replay/recording_excerpt.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/recording_writer.h"
#include "shared/base/random.h"
#include "tests/store/faulty_disk.h"
#include "tests/support/holds.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

class RecordingFaultsTest : public RecordingTest {
 protected:
  /// Parts each half a second, as a ring's.
  void simulate_parts(Tick ticks) {
    World world(small_world());
    for (Tick tick = 1; tick <= ticks; ++tick) {
      std::vector<Command> commands;
      if (tick % 25 == 10) commands = {carve_at(static_cast<float>(tick % 7), static_cast<uint32_t>(tick))};
      deltas.push_back(world.step(commands));
      commands_by_tick.push_back(std::move(commands));
      parts.emplace_back();
      if (tick % 30 != 0) continue;
      world.renew();
      parts.back() = std::make_shared<const WorldMoment>(world.moment());
    }
  }
  /// Writes them as a ring of a second until the disk refuses.
  void write_ring() {
    auto writer = RecordingWriter::create(path, {"test", small_world()}, {.seconds = 1.0});
    for (size_t i = 0; writer && i < deltas.size(); ++i) {
      if (!(*writer)->add(*deltas[i], commands_by_tick[i], {}, parts[i].get())) return;
      if (i % 10 == 9 && !(*writer)->commit()) return;
    }
    if (writer) static_cast<void>((*writer)->finish());
  }
  /// Plays and verifies as far as it goes; how far. 0: no tick was committed.
  Tick last_tick_of_whole() {
    auto reader = RecordingReader::open(path);
    if (!reader) {
      EXPECT_TRUE(holds(reader.error().message, path)) << reader.error().message;
      return 0;
    }
    const auto report = verify(**reader);
    EXPECT_TRUE(report && report->agrees()) << (report ? report->difference : report.error().message);
    auto source = ReplaySource::open(path);
    EXPECT_TRUE(source.has_value()) << source.error().message;
    if (!source) return 0;
    const Tick last = (*reader)->last_tick();
    const auto jumped = (*source)->jump(last);
    EXPECT_TRUE(jumped.has_value()) << jumped.error().message;
    if (!jumped) return 0;
    EXPECT_EQ((*jumped)->field_hash, deltas[last - 1]->field_hash);
    return last;
  }
  void remove_files() const {
    for (const char* end : {"", "-wal", "-shm", "-journal"}) fs::remove(path + end);
  }
  std::vector<std::shared_ptr<const WorldMoment>> parts;
};

TEST_F(RecordingFaultsTest, a_disk_that_dies_at_any_write_leaves_a_recording_that_plays_and_verifies) {
  simulate_parts(150);
  FaultyDisk disk;
  write_ring();
  const uint64_t writes = disk.writes;
  EXPECT_EQ(last_tick_of_whole(), 150U);
  Tick farthest = 0;
  for (uint64_t at = writes / 9; at < writes; at += writes / 9) {
    SCOPED_TRACE(at);
    remove_files();
    disk.writes = 0;
    disk.dies_after = at;
    write_ring();
    disk.crash();
    const Tick last = last_tick_of_whole();
    EXPECT_GE(last, farthest);
    farthest = last;
  }
  EXPECT_GT(farthest, 60U);
}

TEST_F(RecordingFaultsTest, a_disk_that_stays_full_leaves_a_recording_that_plays_and_verifies_so_far) {
  simulate(150);
  FaultyDisk disk;
  {
    auto recorder = Recorder::create(path, {"test", small_world()});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    for (size_t i = 0; i < 100; ++i) (*recorder)->push(deltas[i], commands_by_tick[i]);
    (*recorder)->commit_up_to(100);
    disk.full = true;
    for (size_t i = 100; i < 150; ++i) (*recorder)->push(deltas[i], commands_by_tick[i]);
    (*recorder)->commit_up_to(150);
    ASSERT_FALSE((*recorder)->health().ok());
    EXPECT_TRUE(holds(*(*recorder)->health().because, "full")) << *(*recorder)->health().because;
    const auto finished = (*recorder)->finish(0.0);
    ASSERT_FALSE(finished.has_value());
    EXPECT_TRUE(holds(finished.error().message, "has no ticks after 100, and 50 are in no part of it"))
        << finished.error().message;
  }
  disk.full = false;
  EXPECT_EQ(last_tick_of_whole(), 100U);
}

/// So many mutated recordings: SCREE_MUTATIONS, or as many as a test may take time for.
int mutations_wanted() {
  const char* const given = std::getenv("SCREE_MUTATIONS");
  return given == nullptr ? 60 : std::max(1, std::atoi(given));
}

/// Changes bytes of the file, or cuts it.
void mutate_bytes(std::vector<char>& bytes, Random& random) {
  for (uint32_t i = 0; i <= random.below(4); ++i)
    bytes[random.below(static_cast<uint32_t>(bytes.size()))] ^= static_cast<char>(1 + random.below(255));
  if (random.below(4) == 0) bytes.resize(random.below(static_cast<uint32_t>(bytes.size())));
}

/// Changes the content of a row, or its tick, and makes its checksum right: only the decoders can tell.
void mutate_row(const std::string& path, Random& random) {
  static constexpr std::array tables = {"header",          "frames",          "commands",
                                        "events",          "machine",         "keyframe_states",
                                        "keyframe_chunks", "keyframe_pieces", "state_moments"};
  const std::string table = tables[random.below(tables.size())];
  const std::string key = table == "keyframe_chunks" ? "id" : "tick";
  auto database = Database::open(path);
  if (!database) return;
  std::vector<std::pair<uint64_t, std::vector<uint8_t>>> rows;
  const auto add_row = [&](uint64_t tick, std::span<const uint8_t> data, bool) -> Result<void> {
    rows.emplace_back(tick, std::vector<uint8_t>(data.begin(), data.end()));
    return {};
  };
  static_cast<void>(database->each("SELECT " + key + ", data, checksum FROM " + table, add_row));
  if (rows.empty()) return;
  auto& [tick, data] = rows[random.below(static_cast<uint32_t>(rows.size()))];
  for (uint32_t i = 0; i <= random.below(3) && !data.empty(); ++i)
    data[random.below(static_cast<uint32_t>(data.size()))] ^= static_cast<uint8_t>(1 + random.below(255));
  if (random.below(5) == 0) data.resize(random.below(static_cast<uint32_t>(data.size() + 1)));
  const auto update =
      database->prepare("UPDATE " + table + " SET data = ?2, checksum = ?3 WHERE " + key + " = ?1");
  if (update) static_cast<void>(database->put(*update, tick, data));
  if (random.below(6) != 0) return;
  static_cast<void>(database->execute("UPDATE OR IGNORE " + table + " SET " + key + " = " + key + " + " +
                                      std::to_string(random.next()) + " WHERE " + key + " = " +
                                      std::to_string(tick)));
}

TEST_F(RecordingFaultsTest, mutated_recordings_never_abort_and_each_refusal_names_the_file) {
  simulate_parts(62);
  {
    auto writer = RecordingWriter::create(path, {"test", small_world()});
    ASSERT_TRUE(writer.has_value());
    for (size_t i = 0; i < deltas.size(); ++i)
      ASSERT_TRUE((*writer)->add(*deltas[i], commands_by_tick[i], {}, parts[i].get()).has_value());
    ASSERT_TRUE((*writer)->finish().has_value());
  }
  const std::vector<char> good = read_file(path);
  const std::string whole = (folder / "whole.scree").string(), out = (folder / "cut.scree").string();
  write_file(whole, good);
  const auto named = [&](const auto& result) {
    if (result) return true;
    EXPECT_TRUE(holds(result.error().message, folder.string())) << result.error().message;
    return false;
  };
  Random random(17);
  const int rounds = mutations_wanted();
  int refused = 0;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    remove_files();
    std::vector<char> bad = good;
    const bool of_bytes = random.below(2) == 0;
    if (of_bytes) mutate_bytes(bad, random);
    write_file(path, bad);
    if (!of_bytes) mutate_row(path, random);
    const auto reader = RecordingReader::open(path);
    if (!named(reader)) {
      ++refused;
      continue;
    }
    named(verify(**reader));
    auto source = ReplaySource::open(path);
    for (int i = 0; named(source) && i < 4; ++i) {
      const Tick first = (*source)->first_tick(), last = (*source)->last_tick();
      if (!named((*source)->jump(first + random.below(static_cast<uint32_t>(last - first + 1))))) break;
      if (!named((*source)->next())) break;
    }
    if (round % 8 != 0) continue;
    named(diff({path, {}}, {whole, {}}));
    named(write_excerpt(**reader, out, (*reader)->first_tick() + 1, (*reader)->last_tick(), {}));
    fs::remove(out);
  }
  EXPECT_GT(refused, rounds / 10);
}

}  // namespace
}  // namespace scree
