// Worlds as files: what was saved is found again, whatever happened to the process, the disk or the file.
#include "server/store/world_file.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <thread>

#include "server/store/chunk_fetcher.h"
#include "server/store/world_lock.h"
#include "server/store/world_saver.h"
#include "server/world/world.h"
#include "tests/store/faulty_disk.h"
#include "tests/store/world_file_fixture.h"
#include "tests/support/recording_fixture.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

TEST_F(WorldFileTest, what_was_saved_is_read_again_bit_for_bit) {
  make();
  EXPECT_EQ(value_in_file(), encode(world->snapshot()));
  WorldSaver saver(std::move(file), world->tick(), flat_terrain,
                   {.durability = Durability::tick, .before_save = {}});
  for (Tick tick = 31; tick <= 90; ++tick) {
    std::vector<Command> commands;
    if (tick == 50) commands = {carve_at(-3.0F, 50)};
    const auto delta = world->step(commands);
    if (saver.note(*delta)) saver.save(world->moment());
    if (tick == 60)
      while (saver.status().saves == 0) std::this_thread::yield();
  }
  const auto finished = saver.finish(world->moment());
  ASSERT_TRUE(finished.has_value()) << finished.error().message;
  EXPECT_EQ(saver.status().saved_tick, 90U);
  EXPECT_GT(saver.status().saves, 1U);
  EXPECT_EQ(value_in_file(), encode(world->snapshot()));
  EXPECT_EQ(refusal_of(path), "");
}

TEST_F(WorldFileTest, the_first_save_after_the_file_was_made_drops_pieces_that_are_gone) {
  make();
  ASSERT_FALSE(world->snapshot().moment.pieces.empty());
  EXPECT_TRUE(file->save(World(small_world()).moment(), {}).has_value());
  EXPECT_TRUE(file->read().value().world.moment.pieces.empty());
}

TEST_F(WorldFileTest, a_piece_that_is_released_is_saved_so) {
  make();
  WorldMoment moment = world->moment();
  ASSERT_FALSE(moment.pieces.empty());
  for (const bool kept : {true, false}) {
    moment.pieces.front().traits.kept = kept;
    ASSERT_TRUE(file->save(moment, {}).has_value());
    EXPECT_EQ(file->read().value().world.moment.pieces.front().traits.kept, kept);
  }
}

TEST_F(WorldFileTest, a_file_is_never_made_over_another_one) {
  make();
  const auto again = WorldFile::create(path, header_of(world->snapshot()), world->snapshot());
  ASSERT_FALSE(again.has_value());
  EXPECT_NE(again.error().message.find("exists already"), std::string::npos);
}

TEST_F(WorldFileTest, a_log_that_a_world_of_that_name_left_behind_is_not_taken_for_the_new_ones) {
  make();
  ASSERT_TRUE(file->save(world->moment(), {}).has_value());
  const std::vector<char> log = read_file(path + "-wal");
  ASSERT_FALSE(log.empty());
  file.reset();
  std::filesystem::remove(path);
  write_file(path + "-wal", log);
  World fresh(small_world());
  const auto made = WorldFile::create(path, header_of(fresh.snapshot()), fresh.snapshot());
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().message.find(path + "-wal exists already"), std::string::npos)
      << made.error().message;
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(WorldFileTest, a_save_that_finds_no_room_leaves_the_last_one_and_a_later_one_has_all) {
  FaultyDisk disk;
  make();
  const auto tick = [&](uint32_t request) { world->step(std::vector<Command>{carve_at(2.0F, request)}); };
  tick(100);
  disk.full = true;
  const auto refused = file->save(world->moment(), {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("full"), std::string::npos) << refused.error().message;
  EXPECT_EQ(refusal_of(path), "");  // the last one
  disk.full = false;
  file.reset();
}

/// A session of saves as a saver would make them: each tick's moment, and the chunks that it changed.
struct Saves {
  WorldSnapshot begin;
  std::vector<std::pair<WorldMoment, std::vector<WorldChunk>>> ticks;
};

Saves saves_of(Tick ticks) {
  Saves saves;
  World world(small_world());
  saves.begin = world.snapshot();
  for (Tick tick = 1; tick <= ticks; ++tick) {
    world.step(std::vector<Command>{carve_at(static_cast<float>(tick), static_cast<uint32_t>(tick))});
    std::map<ChunkCoord, WorldChunk> chunks;
    for (const BrickPatch& patch : world.snapshot().bricks) {
      WorldChunk& chunk = chunks[chunk_of(patch.coord)];
      chunk.chunk = chunk_of(patch.coord);
      chunk.version = tick;
      chunk.hash += brick_hash(patch.coord, patch.brick, patch.materials);
      chunk.bricks.push_back(patch);
    }
    auto& [moment, list] = saves.ticks.emplace_back(world.moment(), std::vector<WorldChunk>());
    for (auto& [coord, chunk] : chunks) list.push_back(std::move(chunk));
  }
  return saves;
}

TEST_F(WorldFileTest, a_disk_that_dies_at_any_write_keeps_all_that_was_told_as_saved) {
  const Saves saves = saves_of(4);
  bool died = true;
  uint64_t deaths = 0;
  for (uint64_t writes = 1; died; ++writes) {
    FaultyDisk disk;
    disk.dies_after = writes;
    Tick told = 0;
    bool made = false;
    {
      auto created = WorldFile::create(path, header_of(saves.begin), saves.begin);
      made = created.has_value();
      for (const auto& [moment, chunks] : saves.ticks)
        if (made && (*created)->save(moment, chunks)) told = moment.tick;
    }
    died = disk.dead();
    deaths += died ? 1 : 0;
    disk.crash();
    if (!made) {
      EXPECT_FALSE(std::filesystem::exists(path)) << writes;
      continue;
    }
    {
      auto opened = WorldFile::open(path);
      ASSERT_TRUE(opened.has_value()) << opened.error().message;
      const auto rows = (*opened)->read();
      ASSERT_TRUE(rows.has_value()) << writes << ": " << rows.error().message;
      const auto world = World::restore(rows->world);
      ASSERT_TRUE(world.has_value()) << world.error().message;
      EXPECT_GE((*world)->tick(), told) << writes;
      if ((*world)->tick() > 0) {
        EXPECT_EQ((*world)->moment().state_hash, saves.ticks[(*world)->tick() - 1].first.state_hash);
      }
    }
    for (const char* name : {"", "-wal", "-shm", "-journal"}) std::filesystem::remove(path + name);
  }
  EXPECT_GT(deaths, 20U);
}

TEST_F(WorldFileTest, damage_anywhere_is_refused_or_was_in_no_use) {
  make();
  const std::vector<uint8_t> good = encode(world->snapshot());
  file.reset();
  const std::vector<char> bytes = read_file(path);
  const std::string damaged = folder / "damaged";
  size_t refused = 0;
  for (size_t at = 37; at < bytes.size(); at += bytes.size() / 60 + 1) {
    std::vector<char> flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    write_file(damaged, flipped);
    const auto opened = WorldFile::open(damaged);
    const auto rows = opened ? (*opened)->read() : tl::unexpected(opened.error());
    if (!rows) {
      ++refused;
      EXPECT_NE(rows.error().message.find(damaged), std::string::npos) << rows.error().message;
    } else {
      EXPECT_EQ(encode(rows->world), good) << at;
    }
  }
  EXPECT_GT(refused, 20U);
  for (size_t length = 0; length < bytes.size(); length += 4096) {
    write_file(damaged, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)});
    EXPECT_NE(refusal_of(damaged), "") << length;
  }
}

TEST_F(WorldFileTest, foreign_files_and_other_releases_are_named) {
  const auto expect = [&](const std::string& word) {
    const std::string said = refusal_of(path);
    EXPECT_NE(said.find(word), std::string::npos) << said;
    std::filesystem::remove(path);
  };
  expect("there is no such file");
  write_file(path, std::vector<char>(5000, 'x'));
  expect("is no world: it is not an SQLite file");
  {
    auto recording = Recorder::create(path, {"test", small_world()});
    ASSERT_TRUE(recording.has_value());
  }
  expect("is no world: it is an SQLite file of another program");
  make();
  file.reset();
  {
    auto database = Database::open(path);
    ASSERT_TRUE(database && database->execute("PRAGMA user_version = 9").has_value());
  }
  expect("is a world of format 9");
}

TEST_F(WorldFileTest, sql_that_came_with_a_file_does_not_run_and_the_file_is_refused) {
  const std::map<std::string, std::string> brought{
      {"trigger", "CREATE TRIGGER eats AFTER INSERT ON moment BEGIN DELETE FROM chunks; END"},
      {"view",
       "DROP TABLE pieces; CREATE VIEW pieces AS WITH RECURSIVE n(i) AS (SELECT 1 UNION "
       "ALL SELECT i + 1 FROM n) SELECT i AS key, x'00' AS data, 0 AS checksum FROM n"},
      {"index", "CREATE INDEX costly ON chunks (hex(data))"},
      {"table", "CREATE TABLE more (key INTEGER PRIMARY KEY, data BLOB CHECK (length(hex(data)) < 9))"}};
  for (const auto& [kind, sql] : brought) {
    SCOPED_TRACE(kind);
    make();
    file.reset();
    {
      auto database = Database::open(path);
      ASSERT_TRUE(database.has_value()) << database.error().message;
      const auto done = database->execute(sql);
      ASSERT_TRUE(done.has_value()) << done.error().message;
      if (kind == "trigger") {
        const auto before = database->number("SELECT count(*) FROM chunks");
        ASSERT_TRUE(before.has_value());
        ASSERT_TRUE(database->execute("INSERT INTO moment VALUES (9, x'00', 0)").has_value());
        const auto after = database->number("SELECT count(*) FROM chunks");
        EXPECT_TRUE(after.has_value() && *after == *before && **after > 0);
      }
      if (kind == "view") {
        EXPECT_FALSE(database->number("SELECT count(*) FROM pieces").has_value());
      }
    }
    const std::string said = refusal_of(path);
    EXPECT_NE(said.find("has a " + kind + " "), std::string::npos) << said;
    std::filesystem::remove(path);
  }
}

TEST_F(WorldFileTest, repair_keeps_every_chunk_that_is_whole_and_says_what_was_lost) {
  make();
  const WorldSnapshot before = world->snapshot();
  file.reset();
  {
    auto database = Database::open(path);
    ASSERT_TRUE(database &&
                database
                    ->execute("UPDATE chunks SET checksum = 0 WHERE key = (SELECT min(key) FROM chunks);"
                              "UPDATE pieces SET checksum = 0 WHERE key = (SELECT max(key) FROM pieces)")
                    .has_value());
  }
  EXPECT_NE(refusal_of(path).find("damaged"), std::string::npos);
  file = std::move(*WorldFile::open(path));
  LostRows lost;
  const auto rows = file->read(&lost);
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  EXPECT_EQ(lost.reasons.size(), 2U);
  const auto salvaged = World::salvage(rows->world);
  ASSERT_TRUE(salvaged.has_value()) << salvaged.error().message;
  const WorldSnapshot after = (*salvaged)->snapshot();
  EXPECT_EQ(after.moment.pieces.size() + 1, before.moment.pieces.size());
  EXPECT_LT(after.bricks.size(), before.bricks.size());
  EXPECT_GT(after.bricks.size(), 0U);
  const auto again = World::restore(after);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  for (int tick = 0; tick < 60; ++tick) EXPECT_EQ((*again)->step({})->ledger.error(), 0);
}

TEST_F(WorldFileTest, a_backup_is_whole_while_the_world_is_saved) {
  make();
  ASSERT_TRUE(file->save(world->moment(), {}).has_value());
  const std::string copy = folder / "backup";
  const auto reader = WorldFile::open(path);
  ASSERT_TRUE(reader.has_value() && (*reader)->copy_to(copy).has_value());
  EXPECT_EQ(refusal_of(copy), "");
}

TEST_F(WorldFileTest, chunks_that_were_read_are_taken_a_few_at_a_time) {
  make();
  ChunkFetcher fetcher;
  ASSERT_TRUE(fetcher.start(path).has_value());
  const std::vector<ChunkCoord> chunks = world->field().edited_chunks();
  ASSERT_GE(chunks.size(), 3U);
  for (size_t i = 0; i < 3; ++i) fetcher.ask(chunks[i]);
  while (fetcher.chunks_read() < 3) std::this_thread::yield();
  std::vector<SuppliedChunk> came;
  while (came.size() < 3) {
    std::vector<SuppliedChunk> some = fetcher.collect(2);
    ASSERT_LE(some.size(), 2U);
    for (SuppliedChunk& one : some) came.push_back(std::move(one));
  }
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(came[i].chunk, chunks[i]);
  EXPECT_TRUE(fetcher.collect(2).empty());
}

TEST_F(WorldFileTest, a_reader_follows_the_file_that_was_put_back_and_no_backup_in_its_place) {
  namespace fs = std::filesystem;
  make();
  const std::string backup = folder / "backup";
  ASSERT_TRUE(file->copy_to(backup).has_value());
  world->step({});
  ASSERT_TRUE(file->save(world->moment(), {}).has_value());
  auto reader = WorldFile::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  const WorldFile* const before = reader->get();
  const auto remove = [&] {
    for (const char* end : {"", "-wal", "-shm"}) fs::remove(path + end);
  };
  remove();
  fs::copy_file(backup, path);
  WorldFile::follow(*reader);
  EXPECT_EQ(reader->get(), before) << "it is of an earlier tick";
  remove();
  const auto put_back = file->opened_anew();
  ASSERT_TRUE(put_back.has_value()) << put_back.error().message;
  WorldFile::follow(*reader);
  EXPECT_NE(reader->get(), before);
  const auto rows = (*reader)->read_moment();
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  EXPECT_EQ(rows->world.moment.tick, world->tick());
}

}  // namespace
}  // namespace scree
