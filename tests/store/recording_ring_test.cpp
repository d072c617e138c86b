// A recording whose size is bounded: what remains of it plays and verifies.
#include <gtest/gtest.h>

#include "server/replay/replay_player.h"
#include "server/replay/verify.h"
#include "server/store/recording_writer.h"
#include "shared/base/random.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

class RecordingRingTest : public RecordingTest {
 protected:
  /// A world with carves now and then, recorded as a ring.
  void begin(RingLimit limit) {
    auto created = RecordingWriter::create(path, {"test", small_world()}, limit);
    ASSERT_TRUE(created.has_value()) << created.error().message;
    writer = std::move(*created);
  }
  void run(RingLimit limit, Tick ticks) {
    begin(limit);
    if (HasFatalFailure()) return;
    write_to(ticks);
    ASSERT_TRUE(writer->finish().has_value());
  }
  void write_to(Tick ticks) {
    for (Tick tick = world.tick() + 1; tick <= ticks; ++tick) {
      std::vector<Command> commands;
      if (tick % 97 == 10)
        commands = {carve_at(static_cast<float>(tick % 17) - 8.0F, static_cast<uint32_t>(tick))};
      deltas.push_back(world.step(commands));
      std::optional<WorldMoment> part;
      const PartWish wish = writer->wants_part();
      if (wish == PartWish::now || (wish == PartWish::soon && (all_soon || deltas.back()->pieces.empty()))) {
        pieces_at_parts += deltas.back()->pieces.size();
        world.renew();
        part = world.moment();
      }
      const auto added = writer->add(*deltas.back(), commands, {}, part ? &*part : nullptr);
      ASSERT_TRUE(added.has_value()) << added.error().message;
      if (tick % 15 != 0) continue;
      ASSERT_TRUE(writer->commit().has_value());
    }
  }
  /// A replay of the ring as it is written. False at the end.
  void play(Tick from, const PlayerOptions& options = {}) {
    auto source = ReplaySource::open(path, from, {}, WithoutTicks::awaited);
    ASSERT_TRUE(source.has_value()) << source.error().message;
    PlayerOptions telling = options;
    telling.tell = [this](const std::string& what) { told.push_back(what); };
    player.emplace(std::move(*source), telling);
  }
  /// Ticks of the player, with the state that their viewers have.
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      const auto delta = player->next();
      ASSERT_TRUE(delta.has_value()) << delta.error().message;
      ASSERT_NE(*delta, nullptr) << "it goes on";
      published.apply(**delta);
      moment = (*delta)->playback.value();
    }
    const uint64_t hash = moment.moment == 0 ? 0 : deltas[moment.moment - 1]->field_hash;
    EXPECT_EQ(published.field_hash(), hash) << moment.moment;
    EXPECT_EQ(published.pieces().size(), moment.moment == 0 ? 0 : deltas[moment.moment - 1]->pieces.size())
        << moment.moment;
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
  std::unique_ptr<RecordingWriter> writer;
  World world{small_world()};
  bool all_soon = false;  ///< also in ticks with pieces
  size_t pieces_at_parts = 0;
  std::optional<ReplayPlayer> player;
  PublishedState published;
  PlaybackMessage moment;
  std::vector<std::string> told;
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
  EXPECT_EQ(of_bytes.wish(101, 2'500'000), PartWish::none) << "however fast it fills";
  EXPECT_EQ(of_bytes.wish(175, 1'500'000), PartWish::soon);
  EXPECT_EQ(of_bytes.wish(250, 2'500'000), PartWish::now);
}

TEST_F(RecordingRingTest, a_ring_that_is_too_small_keeps_some_seconds_and_says_so) {
  RecordingRing ring({.bytes = 64'000'000}, 60);
  ring.begin({100, 1}, 0);
  ring.begin({200, 1}, 0);
  ring.begin({400, 1}, 0);
  EXPECT_EQ(ring.first_to_stay(700, 80'000'000), nullptr) << "500 ticks would remain";
  ASSERT_NE(ring.first_to_stay(800, 80'000'000), nullptr);
  EXPECT_EQ(ring.first_to_stay(800, 80'000'000)->tick, 200U);
  EXPECT_EQ(ring.first_to_stay(800, 56'000'000), nullptr) << "an eighth is the log's";
  const auto over = [&](uint64_t file, uint64_t log, uint64_t used) {
    return ring.over_limit({.file_bytes = file, .log_bytes = log, .over_limit = {}}, used);
  };
  EXPECT_EQ(over(56'000'000, 8'000'000, 56'000'000), "");
  EXPECT_EQ(over(64'000'000, 8'000'000, 50'000'000), "") << "pages that are used again";
  EXPECT_NE(over(80'000'000, 8'000'000, 80'000'000).find("64 MB takes 88 MB: the terrain"),
            std::string::npos);
  EXPECT_NE(over(50'000'000, 40'000'000, 50'000'000).find("somebody reads"), std::string::npos);
}

TEST_F(RecordingRingTest, the_log_of_a_ring_of_bytes_is_merged_and_cut) {
  begin({.bytes = 600'000});
  uint64_t most = 0;
  for (Tick tick = 15; tick <= 900; tick += 15) {
    write_to(tick);
    most = std::max(most, writer->size().log_bytes);
  }
  EXPECT_GT(most, 0U);
  EXPECT_LE(most, 400'000U) << "an eighth, and a commit";
  EXPECT_EQ(std::filesystem::file_size(path), writer->size().file_bytes);
}

TEST_F(RecordingRingTest, a_ring_verifies_while_it_is_written) {
  all_soon = true;
  begin({.seconds = 10.0});
  write_to(900);
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  const Tick first = (*reader)->first_tick();
  ASSERT_GT(first, 1U);
  Tick written = 900;
  // Its ticks are dropped one after the other meanwhile.
  const auto report = verify(**reader, [&](Tick, Tick) { write_to(written += 60); });
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(report->agrees()) << report->difference;
  EXPECT_EQ(report->ticks, 900 - first + 1);
  ASSERT_TRUE((*reader)->refresh().has_value());
  EXPECT_GT((*reader)->first_tick(), 900U) << "none of them is there any more";
  EXPECT_EQ((*reader)->last_tick(), written - written % 15);
  (*reader)->let_go();
}

TEST_F(RecordingRingTest, a_replay_that_is_overtaken_goes_on_where_the_ring_begins) {
  all_soon = true;
  begin({.seconds = 10.0});
  write_to(300);
  play(0);
  steps(30);
  ASSERT_TRUE(player->request({.play = ReplayPlay::pause}).has_value());
  steps(1);
  EXPECT_EQ(moment.moment, 30U);
  write_to(1500);
  steps(6);
  EXPECT_GT(moment.first, 800U);
  EXPECT_EQ(moment.moment, moment.first);
  ASSERT_EQ(told.size(), 1U) << "once";
  EXPECT_NE(told[0].find("tick 30 is shown"), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("at tick " + std::to_string(moment.first)), std::string::npos) << told[0];
  ASSERT_TRUE(player->request({.play = ReplayPlay::play}).has_value());
  steps(60);
  EXPECT_EQ(moment.moment, moment.first + 60);
  EXPECT_EQ(told.size(), 1U);
}

TEST_F(RecordingRingTest, a_tick_that_was_dropped_is_not_gone_to_but_the_first) {
  all_soon = true;
  begin({.seconds = 10.0});
  write_to(300);
  play(290);
  steps(2);
  for (const Tick tick : {Tick{1500}, Tick{2100}}) {
    write_to(tick);
    steps(4);
    ASSERT_TRUE(player->request({.move = ReplayMove::to_tick, .value = 5}).has_value());
    steps(4);
    EXPECT_LE(moment.moment - moment.first, 4U);
    ASSERT_FALSE(told.empty());
    EXPECT_NE(told.back().find("tick 5 is asked for"), std::string::npos) << told.back();
    told.clear();
  }
}

TEST_F(RecordingRingTest, a_replay_waits_for_the_first_tick_wherever_that_is) {
  begin({.seconds = 10.0});
  play(0);
  steps(400);
  EXPECT_EQ(moment.moment, 0U);
  EXPECT_TRUE(moment.playing);
  EXPECT_FALSE(published.settings().empty());
  write_to(60);
  steps(30);
  EXPECT_GT(moment.moment, 20U);
  EXPECT_TRUE(told.empty());
  all_soon = true;
  writer.reset();
  std::filesystem::remove(path);
  auto created = RecordingWriter::create(
      path, {"test", small_world()},
      {world.moment(), world.outline(), [this](ChunkCoord chunk) { return world.chunk(chunk); }},
      {.seconds = 10.0});
  ASSERT_TRUE(created.has_value()) << created.error().message;
  writer = std::move(*created);
  player.reset();
  published = {};
  play(0);
  steps(3);
  EXPECT_EQ(moment.moment, 0U);
  write_to(120);
  steps(6);
  EXPECT_GE(moment.moment, 60U);
  EXPECT_TRUE(told.empty()) << "nothing was dropped";
}

TEST_F(RecordingRingTest, a_recording_that_is_taken_away_is_noticed_at_the_next_commit) {
  begin({});
  write_to(15);
  std::filesystem::rename(path, path + ".elsewhere");
  for (Tick tick = 16; tick <= 20; ++tick) ASSERT_TRUE(writer->add(*world.step({}), {}).has_value());
  const auto committed = writer->commit();
  ASSERT_FALSE(committed.has_value());
  EXPECT_NE(committed.error().message.find("moved or removed"), std::string::npos)
      << committed.error().message;
  std::filesystem::rename(path + ".elsewhere", path);
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
       {"", "m", "10", "-1m", "1.5G", "5s", "1M", "63M", "10 m", "9999999h", "1000T", "10mG", "5000000000s"})
    EXPECT_FALSE(ring_limit_of(wrong).has_value()) << wrong;
}

}  // namespace
}  // namespace scree
