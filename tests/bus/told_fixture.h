// A world that is stepped by hand and told over a server of NATS, and sources that follow it.
#pragma once

#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/told/told_source.h"
#include "server/told/world_teller.h"
#include "server/world/world.h"
#include "tests/bus/nats_process.h"
#include "tests/support/flat_terrain.h"

namespace scree {

inline const std::string told_name = "quarry";

inline WorldConfig told_world_config() {
  WorldConfig config;
  config.terrain = flat_terrain;
  return config;
}

/// Carves of a storm: the n-th one.
inline Command told_carve(uint32_t n) {
  CarveRequest carve;
  const float x_m = static_cast<float>(n % 12) * 2.0F - 12.0F;
  const float z_m = static_cast<float>(n / 12 % 8) * 2.0F - 8.0F;
  carve.shape = sphere({x_m, -0.3F, z_m}, 1.2F);
  carve.seeds = 6;
  carve.random_seed = n;
  carve.impact_m = {x_m, 1.0F, z_m};
  Command command;
  command.session = 1;
  command.request = n + 1;
  command.body = carve;
  return command;
}

inline TellerConfig told_config() {
  TellerConfig config;
  config.world = told_name;
  return config;
}

class ToldByHand {
 public:
  explicit ToldByHand(std::shared_ptr<Bus> bus, uint64_t run = 77, TellerConfig config = told_config())
      : world(told_world_config()) {
    auto started = WorldTeller::start(std::move(bus), config, {"test", told_world_config()}, run);
    EXPECT_TRUE(started) << started.error().message;
    teller = std::move(*started);
  }

  void step(const std::vector<Command>& commands = {}) {
    const auto delta = world.step(commands);
    hashes[delta->tick] = delta->field_hash;
    if (teller->wants_start())
      teller->begin(world.keyframe(), {});
    else
      teller->push(delta);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  void storm(int ticks) {
    for (int i = 0; i < ticks; ++i) step({told_carve(carved_++)});
  }
  /// Whether so many keyframes come to be told, in all.
  bool comes_to_keyframes(uint64_t count) {
    return comes([&] { return teller->status().keyframes >= count; });
  }

  World world;
  std::unique_ptr<WorldTeller> teller;
  std::map<Tick, uint64_t> hashes;

 private:
  uint32_t carved_ = 0;
};

/// Follows as an edge does.
class ToldFollower {
 public:
  explicit ToldFollower(std::shared_ptr<Bus> bus) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (source == nullptr && std::chrono::steady_clock::now() < end) {
      auto opened = ToldSource::open(bus, told_name, {}, 3);
      if (opened) source = std::move(*opened);
      if (!opened) why = opened.error().message;
    }
    if (source == nullptr) return;
    const auto keyframe = source->keyframe();
    number = keyframe->tick;
    hashes[source->status().tick] = keyframe->field_hash;
  }

  /// Whether the source comes to that tick of the simulation.
  bool follow_to(Tick tick) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (source->status().tick < tick && std::chrono::steady_clock::now() < end) {
      const auto delta = source->next();
      if (delta == nullptr) return false;
      EXPECT_EQ(delta->tick, ++number);
      hashes[source->status().tick] = delta->field_hash;
    }
    return source->status().tick >= tick;
  }

  std::unique_ptr<ToldSource> source;
  std::string why;
  Tick number = 0;
  std::map<Tick, uint64_t> hashes;  ///< by the simulation's ticks
};

/// Every tick that the follower saw was the simulation's.
inline void expect_same(const ToldFollower& follower, const ToldByHand& told) {
  for (const auto& [tick, hash] : follower.hashes) ASSERT_EQ(hash, told.hashes.at(tick)) << "tick " << tick;
}

}  // namespace scree
