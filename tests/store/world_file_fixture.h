// A small world with pieces in the air and its file, for tests of kept worlds.
#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "server/store/world_file.h"
#include "server/world/world.h"
#include "tests/support/recording_fixture.h"
#include "tests/support/test_folder.h"

namespace scree {

inline WorldHeader header_of(const WorldSnapshot& value) {
  WorldHeader header{.world = 77, .config = value.moment.config};
  header.config.program = "test";
  return header;
}

/// A small world with pieces in the air, at tick 30.
inline std::unique_ptr<World> busy_world() {
  auto world = std::make_unique<World>(small_world());
  for (Tick tick = 1; tick <= 30; ++tick) {
    std::vector<Command> commands;
    if (tick % 10 == 1) commands = {carve_at(static_cast<float>(tick) / 3.0F, static_cast<uint32_t>(tick))};
    world->step(commands);
  }
  return world;
}

inline std::string refusal_of(const std::string& path) {
  const auto file = WorldFile::open(path);
  if (!file) return file.error().message;
  const auto rows = (*file)->read();
  if (!rows) return rows.error().message;
  const auto world = World::restore(rows->world);
  return world ? std::string() : world.error().message;
}

class WorldFileTest : public ::testing::Test {
 protected:
  void make() {
    world = busy_world();
    auto made = WorldFile::create(path, header_of(world->snapshot()), world->snapshot());
    ASSERT_TRUE(made.has_value()) << made.error().message;
    file = std::move(*made);
  }
  std::vector<uint8_t> value_in_file() {
    auto reopened = WorldFile::open(path);
    EXPECT_TRUE(reopened.has_value()) << reopened.error().message;
    if (!reopened) return {};
    const auto rows = (*reopened)->read();
    EXPECT_TRUE(rows.has_value()) << rows.error().message;
    return rows ? encode(rows->world) : std::vector<uint8_t>();
  }

  TestFolder folder;
  std::string path = folder / "world.scree";
  std::unique_ptr<World> world;
  std::unique_ptr<WorldFile> file;
};

}  // namespace scree
