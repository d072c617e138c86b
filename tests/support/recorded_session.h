// A small world's session as a file, with carves and a person who walks through it, for tests that replay
// one.
#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <string>

#include "server/store/recorder.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"

namespace scree {

/// A carve each 80 ticks; Ann (session 3) walks along x and looks at the ground before her.
inline void record_session(const std::string& path, Tick ticks) {
  WorldConfig config = flat_world();
  config.pieces_max = 100;
  World world(config);
  auto recorder = Recorder::create(path, {"test", config});
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  for (Tick tick = 1; tick <= ticks; ++tick) {
    const auto x_m = static_cast<float>(tick) * 0.02F;
    std::vector<Command> commands;
    if (tick % 80 == 20) {
      CarveRequest carve;
      carve.shape = sphere({x_m, 0.0F, -4.0F}, 1.0F);
      carve.seeds = 6;
      carve.random_seed = static_cast<uint32_t>(tick);
      carve.impact_m = {x_m, 1.0F, -4.0F};
      commands = {{3, static_cast<uint32_t>(tick), carve}};
    }
    std::vector<Event> noted;
    if (tick == 1) noted.push_back({.kind = EventKind::join, .tick = 1, .session = 3, .text = "Ann"});
    std::optional<std::vector<PlayerCursor>> cursors;
    if (tick % ticks_per_physics == 0) cursors = {{3, "Ann", {x_m, 1.7F, 0.0F}, {x_m, 0.0F, -4.0F}}};
    auto delta = world.step(commands);
    (*recorder)->push(std::move(delta), std::move(commands), std::move(noted), nullptr, std::move(cursors));
  }
  const auto finished = (*recorder)->finish();
  ASSERT_TRUE(finished.has_value()) << finished.error().message;
}

}  // namespace scree
