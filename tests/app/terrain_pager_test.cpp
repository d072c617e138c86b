// A world under a tiny bound of terrain in memory: what is carved far away goes to the file and comes back,
// and everything is as if it had never gone.
#include "server/app/terrain_pager.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <thread>

#include "server/app/admission.h"
#include "server/app/limits.h"
#include "server/app/piece_forecast.h"
#include "server/app/resident_memory.h"
#include "server/app/saved_world.h"
#include "server/app/temporary_world.h"
#include "server/formats/world_codec.h"
#include "server/replay/recorded_world.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/database.h"
#include "server/store/recorder.h"
#include "server/store/stored_field.h"
#include "server/world/limits.h"
#include "server/world/world_snapshot.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_world.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

class PagerTest : public ::testing::Test {
 protected:
  void open(size_t bricks_max) {
    auto opened = SavedWorld::open(path, config, 1, {}, bricks_max);
    ASSERT_TRUE(opened.has_value()) << opened.error().message;
    saved_world = std::move(*opened);
    world = saved_world->release_world();
    ASSERT_TRUE(
        saved_world->start(*world, {.durability = Durability::off, .autosave_s = 0.0, .before_save = {}}));
    auto paging = TerrainPager::open(path, world->paging(), std::make_shared<ChunkFetcher>(), bricks_max,
                                     [this] { return resident_mb * bytes_per_mb; });
    ASSERT_TRUE(paging.has_value()) << paging.error().message;
    pager = std::move(*paging);
  }
  /// A tick as a server makes it.
  std::shared_ptr<const TickDelta> step(std::vector<Command> arrived = {}) {
    pager->begin_tick();
    Admitted admitted = admission.admit(std::move(arrived), {*world, *pager, nullptr, true});
    for (Reply& reply : admitted.refused) refused.push_back(std::move(reply));
    const auto delta = world->step(admitted.commands);
    admission.answered(delta->replies);
    for (const Reply& reply : delta->replies) EXPECT_EQ(reply.refusal, "");
    answers += delta->replies.size();
    saved_world->note(*delta, *world, pager->pressed());
    pager->end_tick(*delta, saved_world->status().saved_tick, {},
                    forecast.update(*delta, world->config().terrain.voxel_size_m),
                    world->config().memory_max_mb);
    handed.push_back(std::move(admitted.commands));
    hashes.push_back(delta->state_hash);
    return delta;
  }
  /// Ticks until it is so.
  template <typename Condition>
  void step_until(Condition&& condition) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline);
      step();
      std::this_thread::yield();
    }
  }
  Command carve(float x_m) {
    CarveRequest request;
    request.shape = sphere({x_m, 0.0F, 0.0F}, 1.5F);
    request.seeds = 3;
    request.random_seed = ++asked;
    request.impact_m = {x_m, 2.0F, 0.0F};
    return {1, asked, request};
  }

  TestFolder folder;
  std::string path = folder / "world";
  WorldConfig config = flat_world();
  std::unique_ptr<SavedWorld> saved_world;
  std::unique_ptr<World> world;
  std::unique_ptr<TerrainPager> pager;
  PieceForecast forecast;
  Admission admission;
  uint32_t asked = 0;
  size_t answers = 0;
  std::vector<Reply> refused;
  std::vector<std::vector<Command>> handed;  ///< to the simulation, by tick, as a recording has them
  std::vector<uint64_t> hashes;
  double resident_mb = 0.0;  ///< what the process would have in RAM
};

TEST_F(PagerTest, a_session_under_a_tiny_bound_has_the_hashes_of_one_without) {
  open(60);
  for (int i = 0; i < 6; ++i) {
    step({carve(60.0F * static_cast<float>(i)), carve(60.0F * static_cast<float>(i) + 2.0F)});
    for (int tick = 0; tick < 20; ++tick) step();
  }
  step_until([&] { return world->field().is_out({0, -1, 0}) || world->field().is_out({0, 0, 0}); });
  EXPECT_LT(world->field().bricks_in(), world->field().edited_brick_count());
  const size_t before = answers;
  step({carve(0.5F), carve(1.0F), carve(240.0F)});
  EXPECT_EQ(answers, before) << "the edit waits for its terrain, and later ones of its session for it";
  EXPECT_EQ(admission.held(), 1U);
  step_until([&] { return answers == before + 3; });
  for (int tick = 0; tick < 100; ++tick) step();
  EXPECT_GT(pager->status().chunks_read, pager->status().waits) << "some were read ahead";
  EXPECT_TRUE(refused.empty());
  EXPECT_LE(saved_world->status().saved_tick, world->tick());

  World whole(config);
  for (size_t i = 0; i < handed.size(); ++i)
    ASSERT_EQ(whole.step(handed[i])->state_hash, hashes[i]) << "tick " << i + 1;
  EXPECT_EQ(world->measure_terrain(), whole.measure_terrain());
  EXPECT_EQ(encode(world->snapshot()), encode(whole.snapshot()));
  ASSERT_TRUE(saved_world->finish(*world).has_value());

  // The file has it all, and the world goes on from it under the same bound.
  pager.reset();
  world.reset();
  saved_world.reset();
  open(60);
  EXPECT_LE(world->field().bricks_in(), 60U + 64U);
  EXPECT_EQ(encode(world->snapshot()), encode(whole.snapshot()));
}

TEST_F(PagerTest, a_recording_begins_with_terrain_that_is_out_and_verifies) {
  open(60);
  for (int i = 0; i < 6; ++i) {
    step({carve(60.0F * static_cast<float>(i))});
    for (int tick = 0; tick < 20; ++tick) step();
  }
  ASSERT_TRUE(saved_world->finish(*world).has_value());
  pager.reset();
  world.reset();
  saved_world.reset();
  open(20);
  const size_t out = world->field().chunks_out();
  ASSERT_GT(out, 0U);
  const std::string recording = folder / "recording";
  const auto read = [this](ChunkCoord chunk) { return world->chunk(chunk); };
  auto recorder =
      Recorder::create(recording, {"test", world->config()}, {world->moment(), world->outline(), read});
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  EXPECT_EQ(world->field().chunks_out(), out) << "they stay out";
  const uint64_t hash_before = world->field().hash();
  const Tick before = world->tick();
  for (int tick = 0; tick < 70; ++tick) {
    const auto delta = tick == 5 ? step({carve(1.0F), carve(242.0F)}) : step();
    (*recorder)->push(delta, handed.back());
  }
  ASSERT_TRUE((*recorder)->finish().has_value());
  auto reader = RecordingReader::open(recording);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  const auto report = verify(**reader);
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(report->agrees()) << report->difference;
  EXPECT_EQ(report->ticks, 70U);
  EXPECT_EQ(report->state_hash, hashes.back());
  const auto within = verify(**reader, {}, {}, 20);
  ASSERT_TRUE(within.has_value()) << within.error().message;
  EXPECT_TRUE(within->agrees()) << within->difference;
  RecordedTerrain terrain(**reader, 20);
  const auto simulated = simulated_to(**reader, world->tick(), terrain, {});
  ASSERT_TRUE(simulated.has_value()) << simulated.error().message;
  EXPECT_GT((*simulated)->field().chunks_out(), 0U) << "whoever simulates has the same bound";
  EXPECT_EQ(encode((*simulated)->snapshot()), encode(world->snapshot()));
  const std::string made = folder / "made";
  ASSERT_TRUE(create_world(made, {.world = 1, .config = world->moment().config}, **simulated).has_value());
  const auto file = WorldFile::open(made);
  ASSERT_TRUE(file.has_value()) << file.error().message;
  EXPECT_EQ(encode((*file)->read().value().world), encode(world->snapshot()));
  auto source = ReplaySource::open(recording);
  ASSERT_TRUE(source.has_value()) << source.error().message;
  const auto first = (*source)->next();
  ASSERT_TRUE(first.has_value()) << first.error().message;
  EXPECT_EQ((*first)->tick, before);
  EXPECT_EQ((*first)->field_hash, hash_before);
}

TEST_F(PagerTest, terrain_that_cannot_be_read_is_refused_by_name_and_the_rest_goes_on) {
  open(20);
  for (int i = 0; i < 4; ++i) {
    step({carve(60.0F * static_cast<float>(i))});
    step();
  }
  step_until([&] { return world->moment().pieces.empty(); });
  for (int tick = 0; tick < 120; ++tick) step();  // until no search needs the terrain any more
  step_until([&] { return world->field().is_out({0, -1, 0}); });
  auto file = Database::open(path);
  ASSERT_TRUE(file.has_value() && file->execute("DELETE FROM chunks").has_value());
  step({carve(0.0F)});
  step_until([&] { return !refused.empty(); });
  EXPECT_EQ(refused.front().reason, Refusal::terrain_unreadable);
  EXPECT_NE(refused.front().refusal.find(path), std::string::npos) << refused.front().refusal;
  const size_t before = answers;
  step({carve(400.0F)});
  step_until([&] { return answers == before + 1; });
}

TEST_F(PagerTest, an_edit_waits_a_little_for_its_terrain_to_be_generated) {
  open(0);
  TerrainAhead ahead(config.terrain);
  const auto ask = [&](std::vector<Command> arrived) {
    return admission.admit(std::move(arrived), {*world, *pager, &ahead, true}).commands.size();
  };
  EXPECT_EQ(ask({carve(0.0F)}), 0U);
  EXPECT_EQ(admission.held(), 1U);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (ask({}) == 0) {  // nobody hands the terrain over
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  while (!ahead.has(world->field(), VoxelBox{{-30, -30, -30}, {30, 30, 30}})) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    ahead.serve(world->field(), {});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(ask({carve(0.0F)}), 1U) << "what is there is not waited for";
}

TEST_F(PagerTest, without_room_edits_are_refused_by_name_or_wait_where_room_will_come) {
  config.memory_max_mb = limits::memory_max_min_mb;
  // Paint of 8 m edits at most 9³ bricks and costs no pieces.
  const auto paint = [&](uint32_t at) {
    const float x_m = 40.0F * static_cast<float>(at % 40) - 800.0F, z_m = 40.0F * static_cast<float>(at / 40);
    return Command{1, at, PaintRequest{box({x_m, 0.0F, z_m}, glm::vec3(4.6F)), material::ice}};
  };
  open(0);
  uint32_t at = 0;
  std::vector<Reply> answered;
  const auto ask = [&](std::vector<Command> commands, bool room_comes) {
    Admitted admitted = admission.admit(std::move(commands), {*world, *pager, nullptr, room_comes});
    for (const Command& command : admitted.commands)
      answered.push_back({command.session, command.request, {}, 0});
    return admitted;
  };
  while (at < 4000 && refused.empty()) refused = ask({paint(++at)}, false).refused;
  ASSERT_FALSE(refused.empty());
  EXPECT_GT(at, 50U);
  EXPECT_EQ(refused.front().reason, Refusal::memory_max);
  EXPECT_NE(refused.front().refusal.find("--memory-max"), std::string::npos) << refused.front().refusal;
  const size_t before = answered.size();
  EXPECT_TRUE(ask({paint(++at)}, true).refused.empty());
  EXPECT_EQ(answered.size(), before) << "it waits for room";
  EXPECT_EQ(admission.held(), 1U);
  admission.answered(std::exchange(answered, {}));
  ask({}, true);
  EXPECT_EQ(answered.size(), 1U);
}

TEST_F(PagerTest, an_answer_frees_the_room_of_one_edit_though_others_have_its_number) {
  config.memory_max_mb = limits::memory_max_min_mb;
  open(0);
  constexpr uint32_t number = 7;
  const Command paint{1, number, PaintRequest{box(glm::vec3(0.0F), glm::vec3(4.6F)), material::ice}};
  const Command change{1, number, SettingsRequest{{{"impacts", "false"}}}};
  const std::vector<Reply> answer{{1, number, {}, 0}};
  const auto is_admitted = [&](const Command& command) {
    const Admitted admitted = admission.admit({command}, {*world, *pager, nullptr, false});
    EXPECT_EQ(admitted.commands.size() + admitted.refused.size(), 1U);
    return admitted.refused.empty();
  };
  size_t paints = 0;
  while (paints < 4000 && is_admitted(paint)) ++paints;  // none is carried out
  ASSERT_GT(paints, 50U);
  ASSERT_LT(paints, 4000U);
  admission.answered(answer);
  EXPECT_TRUE(is_admitted(paint));
  EXPECT_FALSE(is_admitted(paint)) << "all others still wait";
  EXPECT_TRUE(is_admitted(change));
  admission.answered(answer);
  EXPECT_FALSE(is_admitted(paint)) << "it may be the change of settings that was answered";
}

TEST_F(PagerTest, shapes_that_no_operation_may_have_are_refused_by_the_simulation_and_have_no_box) {
  open(0);
  constexpr float most = std::numeric_limits<float>::max();
  for (const float far_m : {4200.0F, 1e9F, 1e30F, most}) {
    for (const glm::vec3 far :
         {glm::vec3(far_m, 0.0F, 0.0F), glm::vec3(0.0F, -far_m, 0.0F), glm::vec3(-far_m)}) {
      const Shape shapes[] = {capsule(glm::vec3(0.0F), 4.0F * far, 1.0F), capsule(-far, far, 1.0F),
                              box(glm::vec3(0.0F), glm::abs(far) + 1.0F), sphere(200.0F * far, 1.0F),
                              crater(glm::vec3(0.0F), far_m)};
      for (const Shape& shape : shapes) {
        ASSERT_FALSE(validate_edit(shape, 0.25F)) << far_m;
        const Command commands[] = {{1, ++asked, CarveRequest{.shape = shape}},
                                    {1, ++asked, FillRequest{shape}},
                                    {1, ++asked, PaintRequest{shape, material::ice}}};
        for (const Command& command : commands) {
          const Admitted admitted = admission.admit({command}, {*world, *pager, nullptr, true});
          ASSERT_EQ(admitted.commands.size(), 1U) << far_m;
          EXPECT_NE(world->step(admitted.commands)->replies.front().refusal, "") << far_m;
        }
      }
    }
  }
}

TEST_F(PagerTest, terrain_gives_way_to_what_the_model_does_not_know_of_and_takes_its_room_back) {
  config.memory_max_mb = limits::memory_max_min_mb;
  const double target_mb = config.memory_max_mb * (1.0 - limits::resident_margin_share);
  const auto ticks = [&](unsigned counts) {
    for (unsigned tick = 0; tick < counts * limits::pager_count_ticks; ++tick) step();
  };
  open(0);
  step({carve(0.0F)});
  resident_mb = target_mb - 1.0;
  ticks(2);
  EXPECT_EQ(pager->memory().beyond_bytes, 0.0);
  const uint32_t before_mb = pager->status().memory_mb;
  resident_mb = target_mb + 10.0;
  ticks(1);
  EXPECT_DOUBLE_EQ(pager->memory().beyond_bytes, 10.0 * bytes_per_mb);
  EXPECT_EQ(pager->status().memory_mb, before_mb + 10);
  ticks(1);
  EXPECT_DOUBLE_EQ(pager->memory().beyond_bytes, 20.0 * bytes_per_mb) << "that was not enough";
  ticks(20);
  EXPECT_DOUBLE_EQ(pager->memory().beyond_bytes,
                   config.memory_max_mb * limits::beyond_share_max * bytes_per_mb)
      << "some terrain stays";
  resident_mb = target_mb - 32.0;
  ticks(1);
  EXPECT_LT(pager->memory().beyond_bytes, config.memory_max_mb * limits::beyond_share_max * bytes_per_mb);
  ticks(40);
  EXPECT_EQ(pager->memory().beyond_bytes, 0.0);
}

TEST(resident_memory, is_what_the_system_says_and_holes_are_given_back) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has a heap of its own";
#endif
  ResidentMemory seen;
  EXPECT_GT(seen.bytes(), 1e6);
  seen.bound(0.0);
  constexpr size_t size = 256, count = 400000;  // smaller than what malloc gives back by itself
  std::vector<std::unique_ptr<char[]>> blocks;
  for (size_t i = 0; i < count; ++i) {
    blocks.push_back(std::make_unique<char[]>(size));
    blocks.back()[0] = 1;
  }
  const double full = resident_bytes();
  const auto last = std::move(blocks.back());  // keeps the end of the heap
  blocks.clear();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (seen.bytes() > full - 0.5 * size * count) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    std::this_thread::yield();
  }
}

TEST(temporary_world, goes_with_its_server_and_a_left_one_with_the_next) {
  TestFolder folder;
  ::setenv("XDG_CACHE_HOME", (folder / "").c_str(), 1);
  const auto files = [&] {
    size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "scree"))
      count += entry.exists() ? 1 : 0;
    return count;
  };
  {
    auto saved_world = SavedWorld::open_temporary(flat_world(), 1);
    ASSERT_TRUE(saved_world.has_value()) << saved_world.error().message;
    const auto world = (*saved_world)->release_world();
    ASSERT_TRUE((*saved_world)->start(*world, {.durability = Durability::off, .before_save = {}}));
    EXPECT_TRUE(std::filesystem::exists((*saved_world)->path()));
    EXPECT_TRUE((*saved_world)->finish(*world).has_value());
  }
  EXPECT_EQ(files(), 0U);
  const std::string left = folder / "scree/paged-1-1.world";
  std::ofstream(left) << "left behind";
  EXPECT_TRUE(temporary_world_path().has_value());
  EXPECT_EQ(files(), 0U);
  ::unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace scree
