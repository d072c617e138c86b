// A program that digs and saves is killed at any moment: what its file holds is a tick of that world, with
// every store by owner and material.
#include <csignal>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "server/store/world_saver.h"
#include "tests/store/world_file_fixture.h"

namespace scree {
namespace {

std::vector<Command> digging_at(Tick tick) {
  const auto x_m = static_cast<float>(tick % 50) * 0.3F;
  const uint64_t session = 1 + tick % 2;
  if (tick % 7 == 0)
    return {{session, 1, DigRequest{sphere({x_m, -0.5F, 0.0F}, 0.8F), 0, {StoreKind::token, session}}}};
  if (tick % 14 == 3)
    return {{session, 2,
             PlaceRequest{sphere({x_m, 0.5F, 12.0F}, 0.4F), material::soil, false, {StoreKind::token, 2}}}};
  return {};
}

/// Digs for ever, and saves every tick. Writes each saved tick into the pipe.
[[noreturn]] void dig_until_killed(const std::string& path, int told) {
  World world(small_world());
  auto file = WorldFile::create(path, header_of(world.snapshot()), world.snapshot());
  if (!file || !(*file)->read()) ::_exit(1);
  WorldSaver saver(std::move(*file), world.tick(), flat_terrain,
                   {.durability = Durability::tick, .autosave_s = 1.0, .before_save = {}});
  for (Tick saved = 0;;) {
    const auto delta = world.step(digging_at(world.tick() + 1));
    if (saver.note(*delta)) saver.save(world.moment());
    const Tick now = saver.status().saved_tick;
    if (now != saved && ::write(told, &now, sizeof now) != sizeof now) ::_exit(1);
    saved = now;
  }
}

TEST(KilledStores, a_world_that_is_killed_has_every_store_of_a_tick_to_the_unit) {
  for (const Tick wanted : {Tick{20}, Tick{63}, Tick{150}}) {
    TestFolder folder;
    const std::string path = folder / "world.scree";
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) dig_until_killed(path, ends[1]);
    ::close(ends[1]);
    Tick told = 0;
    while (told < wanted && ::read(ends[0], &told, sizeof told) == sizeof told) continue;
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(ends[0]);
    ASSERT_GE(told, wanted);
    const auto file = WorldFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    const auto rows = (*file)->read();
    ASSERT_TRUE(rows) << rows.error().message;
    const auto restored = World::restore(rows->world);
    ASSERT_TRUE(restored) << restored.error().message;
    ASSERT_GE((*restored)->tick(), told);
    World same(small_world());
    while (same.tick() < (*restored)->tick()) same.step(digging_at(same.tick() + 1));
    EXPECT_EQ((*restored)->moment().stores, same.moment().stores);
    EXPECT_EQ((*restored)->moment().materials, same.moment().materials);
    EXPECT_EQ((*restored)->moment().ledger, same.moment().ledger);
    EXPECT_EQ((*restored)->moment().stores.size(), 2U);
    EXPECT_GT((*restored)->moment().ledger.stored, 0);
    EXPECT_EQ((*restored)->step({})->ledger.error(), 0);
  }
}

}  // namespace
}  // namespace scree
