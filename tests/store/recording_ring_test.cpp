// A recording whose size is bounded: what remains of it plays and verifies.
#include <gtest/gtest.h>

#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/recording_writer.h"
#include "shared/base/random.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

class RecordingRingTest : public RecordingTest {
 protected:
  /// A world with carves now and then, recorded as a ring.
  void run(RingLimit limit, Tick ticks) {
    auto writer = RecordingWriter::create(path, {"test", small_world()}, limit);
    ASSERT_TRUE(writer.has_value()) << writer.error().message;
    World world(small_world());
    for (Tick tick = 1; tick <= ticks; ++tick) {
      std::vector<Command> commands;
      if (tick % 97 == 10)
        commands = {carve_at(static_cast<float>(tick % 17) - 8.0F, static_cast<uint32_t>(tick))};
      deltas.push_back(world.step(commands));
      std::optional<WorldMoment> part;
      const PartWish wish = (*writer)->wants_part();
      if (wish == PartWish::now || (wish == PartWish::soon && (all_soon || deltas.back()->pieces.empty()))) {
        pieces_at_parts += deltas.back()->pieces.size();
        world.renew();
        part = world.moment();
      }
      const auto added = (*writer)->add(*deltas.back(), commands, {}, part ? &*part : nullptr);
      ASSERT_TRUE(added.has_value()) << added.error().message;
      if (tick % 15 != 0) continue;
      ASSERT_TRUE((*writer)->commit().has_value());
    }
    ASSERT_TRUE((*writer)->finish().has_value());
  }
  void expect_plays_and_verifies() {
    auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader.has_value()) << reader.error().message;
    const Tick first = (*reader)->first_tick(), last = (*reader)->last_tick();
    const auto report = verify(**reader);
    ASSERT_TRUE(report.has_value()) << report.error().message;
    EXPECT_TRUE(report->agrees()) << report->first_difference << ": " << report->difference;
    EXPECT_EQ(report->ticks, last - first + 1);
    EXPECT_GE(report->restarts, 1U) << "parts";
    auto source = ReplaySource::open(path);
    ASSERT_TRUE(source.has_value()) << source.error().message;
    Random random(5);
    for (int i = 0; i < 30; ++i) {
      const Tick to = first - 1 + random.below(static_cast<uint32_t>(last - first + 2));
      const auto jumped = (*source)->jump(to);
      ASSERT_TRUE(jumped.has_value()) << jumped.error().message;
      EXPECT_EQ((*jumped)->field_hash, deltas[to - 1]->field_hash) << to;
      EXPECT_EQ((*jumped)->pieces, deltas[to - 1]->pieces) << to;
    }
  }
  bool all_soon = false;  ///< also in ticks with pieces
  size_t pieces_at_parts = 0;
};

TEST_F(RecordingRingTest, a_ring_of_seconds_keeps_the_last_of_them) {
  all_soon = true;
  run({.seconds = 10.0}, 1500);
  if (HasFatalFailure()) return;
  EXPECT_GT(pieces_at_parts, 0U) << "bodies were renewed";
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_EQ((*reader)->last_tick(), 1500U);
  const Tick ticks = 1500 - (*reader)->first_tick() + 1;
  EXPECT_GE(ticks, 600U);
  EXPECT_LE(ticks, 600U + 75U + 16U) << "a part more, and the ticks of a commit";
  expect_plays_and_verifies();
}

TEST_F(RecordingRingTest, a_ring_of_bytes_takes_no_more) {
  run({.bytes = 600'000}, 1500);
  if (HasFatalFailure()) return;
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_GT((*reader)->first_tick(), 1U);
  EXPECT_LE(std::filesystem::file_size(path), 800'000U);
  expect_plays_and_verifies();
}

TEST_F(RecordingRingTest, parts_wait_for_ticks_without_pieces_but_not_for_ever) {
  RecordingRing ring({.seconds = 8.0}, 60);
  ring.begin({100, 1}, 0);
  EXPECT_EQ(ring.wish(159, 0), PartWish::none);
  EXPECT_EQ(ring.wish(160, 0), PartWish::soon);
  EXPECT_EQ(ring.wish(220, 0), PartWish::now);
  RecordingRing of_bytes({.bytes = 8'000'000}, 60);
  of_bytes.begin({100, 1}, 500'000);
  EXPECT_EQ(of_bytes.wish(1'000'000, 1'400'000), PartWish::none);
  EXPECT_EQ(of_bytes.wish(101, 1'500'000), PartWish::soon);
  EXPECT_EQ(of_bytes.wish(101, 2'500'000), PartWish::now);
}

TEST_F(RecordingRingTest, a_renewed_world_goes_on_as_a_restored_one) {
  World world(small_world());
  for (Tick tick = 1; tick <= 30; ++tick) {
    std::vector<Command> commands;
    if (tick % 8 == 1) commands = {carve_at(static_cast<float>(tick), static_cast<uint32_t>(tick))};
    world.step(commands);
  }
  const WorldSnapshot value = world.snapshot();
  ASSERT_FALSE(value.moment.pieces.empty());
  const auto restored = World::restore(value);
  ASSERT_TRUE(restored.has_value()) << restored.error().message;
  world.renew();
  for (Tick tick = 31; tick <= 200; ++tick) {
    std::vector<Command> commands;
    if (tick == 60) commands = {carve_at(-5.0F, 60)};
    const uint64_t hash = world.step(commands)->state_hash;
    ASSERT_EQ((*restored)->step(commands)->state_hash, hash) << tick;
  }
}

TEST(RingLimit, is_a_time_or_a_number_of_bytes) {
  EXPECT_EQ(ring_limit_of("90s").value_or(RingLimit{}).seconds, 90.0);
  EXPECT_EQ(ring_limit_of("10m").value_or(RingLimit{}).seconds, 600.0);
  EXPECT_EQ(ring_limit_of("2h").value_or(RingLimit{}).seconds, 7200.0);
  EXPECT_EQ(ring_limit_of("500M").value_or(RingLimit{}).bytes, 500'000'000U);
  EXPECT_EQ(ring_limit_of("2G").value_or(RingLimit{}).bytes, 2'000'000'000U);
  for (const char* wrong :
       {"", "m", "10", "-1m", "1.5G", "5s", "1M", "10 m", "9999999h", "1000T", "10mG", "5000000000s"})
    EXPECT_FALSE(ring_limit_of(wrong).has_value()) << wrong;
}

}  // namespace
}  // namespace scree
