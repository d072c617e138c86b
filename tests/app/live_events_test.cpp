// What a live server logs of its events: who did it, when, and what made a tick slow.
#include "server/app/live_events.h"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/world/settings.h"
#include "tests/support/flat_world.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

/// A tick in which a carve took most of the time.
TickDelta slow_tick() {
  TickDelta delta;
  delta.tick = 3;
  delta.times[TickStage::requests] = 30.0;
  delta.times[TickStage::bodies] = 4.0;
  CarveOperation small, large;
  small.shape = sphere({1.0F, 0.0F, 0.0F}, 1.0F);
  large.shape = sphere({8.0F, 2.0F, 3.0F}, 4.0F);
  delta.operations.push_back({small, {}, {}, {1}, TickStage::requests, 5, 5});
  delta.operations.push_back({large, {}, {}, {2, 3, 4}, TickStage::requests, 7, 9});
  delta.operations.push_back({large, {}, {}, {5, 6, 7, 8}, TickStage::impacts, 0, 0});
  return delta;
}

TEST(LiveEvents, a_slow_tick_says_stage_place_and_party_and_lines_say_who_and_when) {
  const TestFolder folder;
  const std::string path = folder / "events.jsonl";
  const WorldConfig world = flat_world();
  auto events = LiveEvents::open(path, world, print(world));
  ASSERT_TRUE(events.has_value()) << events.error().message;
  (*events)->note({.kind = EventKind::join, .session = 7, .text = "Ann", .token_id = 0x1F});
  const std::vector<Event> machine = (*events)->drain(slow_tick());
  ASSERT_EQ(machine.size(), 2U);
  const Event& slow = machine[1];
  EXPECT_EQ(slow.kind, EventKind::slow);
  EXPECT_EQ(slow.text, "requests 30.0 ms, party 9");
  EXPECT_EQ(slow.place_m, glm::vec3(8.0F, 2.0F, 3.0F));
  EXPECT_EQ(slow.session, 7U);
  EXPECT_EQ((*events)->persons(), (std::vector<Participant>{{7, "Ann", 0x1F}}));
  ASSERT_TRUE((*events)->finish().has_value());
  std::ifstream file(path);
  std::vector<nlohmann::json> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(lines.size(), 5U);
  for (const nlohmann::json& line : lines) EXPECT_EQ(line["at"].get<std::string>().back(), 'Z');
  EXPECT_EQ(lines[1]["event"], "carve");
  EXPECT_EQ(lines[1]["name"], "Ann");
  EXPECT_EQ(lines[1]["token"], "000000000000001f");
  EXPECT_EQ(lines[3]["event"], "join");
  EXPECT_EQ(lines[3]["token"], "000000000000001f");
  EXPECT_EQ(lines[4]["name"], "Ann");
}

TEST(LiveEvents, a_slow_tick_without_an_operation_says_its_stage) {
  const WorldConfig world = flat_world();
  auto events = LiveEvents::open("", world, print(world));
  ASSERT_TRUE(events.has_value());
  TickDelta delta;
  delta.tick = 1;
  delta.times[TickStage::bodies] = 50.0;
  const auto machine = (*events)->drain(delta);
  ASSERT_EQ(machine.size(), 1U);
  EXPECT_EQ(machine[0].text, "bodies 50.0 ms");
  EXPECT_FALSE(machine[0].place_m.has_value());
  EXPECT_EQ(machine[0].session, 0U);
}

}  // namespace
}  // namespace scree
