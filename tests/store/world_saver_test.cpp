// Keepers of worlds: what a running world changed is saved, also where the disk or the file is not as it
// should be.
#include "server/store/world_saver.h"

#include <gtest/gtest.h>
#include <thread>

#include "server/store/ground_mass.h"
#include "server/store/limits.h"
#include "server/store/stored_field.h"
#include "server/store/world_schema.h"
#include "tests/store/faulty_disk.h"
#include "tests/store/world_file_fixture.h"

namespace scree {
namespace {

TEST_F(WorldFileTest, without_durability_a_world_is_saved_every_autosave_or_only_at_the_end) {
  for (const auto& [autosave_s, saves] : {std::pair{0.25, 3U}, {0.0, 0U}}) {
    make();
    ASSERT_TRUE(file->read().has_value());
    WorldSaver saver(std::move(file), world->tick(), flat_terrain,
                     {.durability = Durability::off, .autosave_s = autosave_s, .before_save = {}});
    std::vector<Tick> due;
    for (int i = 0; i < 45; ++i) {
      const auto delta = world->step({});
      if (!saver.note(*delta)) continue;
      due.push_back(delta->tick);
      saver.save(world->moment());
      while (saver.status().saved_tick < delta->tick) std::this_thread::yield();
    }
    EXPECT_EQ(due.size(), saves);
    if (!due.empty()) {
      EXPECT_EQ(due.front(), 45U);
    }
    EXPECT_EQ(saver.status().saves, saves);
    ASSERT_TRUE(saver.finish(world->moment()).has_value());
    EXPECT_EQ(value_in_file(), encode(world->snapshot()));
    std::filesystem::remove(path);
  }
}

TEST_F(WorldFileTest, without_durability_a_world_is_saved_before_much_of_it_waits) {
  make();
  ASSERT_TRUE(file->read().has_value());
  WorldSaver saver(std::move(file), world->tick(), flat_terrain,
                   {.durability = Durability::off, .autosave_s = 0.0, .before_save = {}});
  const auto brick = std::make_shared<const Brick>(Brick{});
  const auto changed = [&](size_t chunk, int brick_of_chunk) {
    const BrickCoord coord = brick_in_chunk({static_cast<int>(chunk), 0, 0}, brick_of_chunk);
    return BrickState{coord, brick, brick_hash(coord, *brick, {}), {}};
  };
  TickDelta delta;
  delta.tick = world->tick() + 1;
  for (size_t chunk = 1; chunk < limits::unsaved_chunks_max; ++chunk)
    for (const int of_chunk : {0, 1, 2}) delta.bricks.push_back(changed(chunk, of_chunk));
  EXPECT_FALSE(saver.note(delta));
  ++delta.tick;
  EXPECT_FALSE(saver.note(delta)) << "the same chunks again";
  ++delta.tick;
  delta.bricks = {changed(limits::unsaved_chunks_max, 0)};
  EXPECT_TRUE(saver.note(delta));
  WorldMoment moment = world->moment();
  moment.tick = delta.tick;
  saver.save(moment);
  while (saver.status().saved_tick < delta.tick) std::this_thread::yield();
  ++delta.tick;
  EXPECT_FALSE(saver.note(delta)) << "all others are saved";
}

TEST_F(WorldFileTest, rows_without_the_grounds_mass_are_read_and_a_keeper_adds_it) {
  make();
  WorldMoment moment = world->moment();
  std::vector<WorldChunk> chunks;
  for (const BrickPatch& patch : world->snapshot().bricks) {
    if (chunks.empty() || chunks.back().chunk != chunk_of(patch.coord)) {
      const auto found = std::ranges::find(chunks, chunk_of(patch.coord), &WorldChunk::chunk);
      if (found != chunks.end()) {
        std::rotate(found, found + 1, chunks.end());
      } else {
        chunks.push_back({chunk_of(patch.coord), 30, 0, {}, {}});
      }
    }
    chunks.back().hash += brick_hash(patch.coord, patch.brick, patch.materials);
    chunks.back().bricks.push_back(patch);
  }
  ASSERT_TRUE(file->save(moment, chunks).has_value());
  auto rows = file->read();
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  EXPECT_TRUE(rows->ground.empty());
  EXPECT_EQ(refusal_of(path), "");
  WorldSaver saver(std::move(file), world->tick(), flat_terrain, {.before_save = {}});
  saver.note(*world->step(std::vector<Command>{carve_at(1.0F, 1)}));
  ASSERT_TRUE(saver.finish(world->moment()).has_value());
  const auto reopened = WorldFile::open(path);
  rows = (*reopened)->read();
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  EXPECT_GT(rows->ground.size(), 0U);
  const GroundMasses measured = measured_ground(flat_terrain, rows->world.bricks);
  for (const auto& [chunk, mass] : rows->ground) EXPECT_EQ(measured.at(chunk), mass);
  EXPECT_TRUE(World::restore(rows->world, 1, rows->ground).has_value());
}

TEST_F(WorldFileTest, what_a_full_disk_left_out_is_saved_when_there_is_room_again) {
  FaultyDisk disk;
  make();
  disk.full = true;
  WorldSaver saver(std::move(file), world->tick(), flat_terrain,
                   {.durability = Durability::tick, .before_save = {}});
  const auto carve = [&](uint32_t request) {
    const auto delta =
        world->step(std::vector<Command>{carve_at(2.0F + static_cast<float>(request), request)});
    if (saver.note(*delta)) saver.save(world->moment());
  };
  carve(1);
  while (saver.status().failures == 0) std::this_thread::yield();
  EXPECT_EQ(saver.status().saved_tick, 30U);
  EXPECT_FALSE(saver.status().health.ok());
  disk.full = false;
  carve(2);
  ASSERT_TRUE(saver.finish(world->moment()).has_value());
  EXPECT_EQ(saver.status().saved_tick, 32U);
  EXPECT_EQ(value_in_file(), encode(world->snapshot()));
}

TEST_F(WorldFileTest, terrain_is_read_with_little_of_it_in_memory_as_of_one_moment) {
  make();
  WorldSaver saver(std::move(file), 30, flat_terrain, {.durability = Durability::off, .before_save = {}});
  ASSERT_TRUE(saver.note(*world->step({}), true));
  saver.save(world->moment());
  while (saver.status().saves == 0) std::this_thread::yield();
  auto reader = WorldFile::open(path);
  ASSERT_TRUE(reader.has_value() && (*reader)->hold_moment().has_value());
  ASSERT_TRUE((*reader)->read_moment().has_value());
  const WorldSnapshot before = world->snapshot();
  saver.note(*world->step(std::vector<Command>{carve_at(5.0F, 1)}));
  ASSERT_TRUE(saver.finish(world->moment()).has_value());
  const auto field = stored_field(std::move(*reader), flat_terrain, 1);
  ASSERT_TRUE(field.has_value()) << field.error().message;
  EXPECT_EQ((*field)->hash(), before.moment.field_hash);
  EXPECT_EQ((*field)->bricks_in(), 0U);
  for (const BrickPatch& patch : before.bricks) {
    ASSERT_EQ((*field)->brick(patch.coord), patch.brick);
    ASSERT_EQ((*field)->materials(patch.coord), patch.materials);
    ASSERT_EQ((*field)->chunks_in().size(), 1U);
  }
  EXPECT_NE(world->field().hash(), before.moment.field_hash);
}

TEST_F(WorldFileTest, a_changed_chunk_whose_row_cannot_be_read_is_written_anew) {
  make();
  const auto delta = world->step(std::vector<Command>{carve_at(5.0F, 1)});
  ASSERT_FALSE(delta->bricks.empty());
  auto damaged = Database::open(path);
  ASSERT_TRUE(damaged.has_value());
  const std::string key = std::to_string(world_schema::chunk_key(chunk_of(delta->bricks.front().coord)));
  ASSERT_TRUE(damaged->execute("UPDATE chunks SET checksum = checksum + 1 WHERE key = " + key));
  ASSERT_NE(refusal_of(path), "") << "it has a row";
  WorldSaver saver(std::move(file), 30, flat_terrain, {.durability = Durability::tick, .before_save = {}});
  ASSERT_TRUE(saver.note(*delta));
  saver.save(world->moment());
  while (saver.status().failures == 0) std::this_thread::yield();
  const SaverStatus status = saver.status();
  EXPECT_EQ(status.saved_tick, 30U) << "not told as saved";
  EXPECT_EQ(status.lacking, std::vector{chunk_of(delta->bricks.front().coord)});
  EXPECT_NE(status.health.because.value_or("").find("chunk "), std::string::npos) << *status.health.because;
  ASSERT_TRUE(saver.note(*world->step({}), true));
  saver.save(world->moment(), chunk_now(world->field()));
  ASSERT_TRUE(saver.finish(world->moment(), chunk_now(world->field())).has_value());
  EXPECT_TRUE(saver.status().lacking.empty());
  EXPECT_EQ(value_in_file(), encode(world->snapshot()));
}

TEST_F(WorldFileTest, the_last_save_writes_a_chunk_anew_as_well) {
  make();
  const auto delta = world->step(std::vector<Command>{carve_at(5.0F, 1)});
  auto damaged = Database::open(path);
  ASSERT_TRUE(damaged.has_value() && damaged->execute("UPDATE chunks SET data = x'00' WHERE key = " +
                                                      std::to_string(world_schema::chunk_key(
                                                          chunk_of(delta->bricks.front().coord)))));
  WorldSaver saver(std::move(file), 30, flat_terrain, {.durability = Durability::off, .before_save = {}});
  saver.note(*delta);
  ASSERT_TRUE(saver.finish(world->moment(), chunk_now(world->field())).has_value());
  EXPECT_EQ(value_in_file(), encode(world->snapshot()));
}

TEST_F(WorldFileTest, a_disk_that_dies_leaves_the_last_save_and_nothing_is_told_as_saved_any_more) {
  FaultyDisk disk;
  make();
  disk.dies_after = disk.writes + 3;
  WorldSaver saver(std::move(file), world->tick(), flat_terrain,
                   {.durability = Durability::tick, .before_save = {}, .last_tries_s = 0.1});
  for (uint32_t i = 1; i <= 5; ++i) {
    const auto delta = world->step(std::vector<Command>{carve_at(static_cast<float>(i), i)});
    if (saver.note(*delta)) saver.save(world->moment());
  }
  const auto finished = saver.finish(world->moment());
  ASSERT_FALSE(finished.has_value());
  EXPECT_NE(finished.error().message.find("its file holds tick 30, and the world stood at 35"),
            std::string::npos)
      << finished.error().message;
  EXPECT_FALSE(saver.status().health.ok());
  EXPECT_EQ(saver.status().saved_tick, 30U);
  disk.crash();
  EXPECT_EQ(refusal_of(path), "");
}

}  // namespace
}  // namespace scree
