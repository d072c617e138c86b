// Blows and worlds of benches that take a scene.
#pragma once

#include <memory>

#include "bench/support/bench.h"
#include "tools/scenes/build.h"

namespace scree {

/// The scene's configuration with the methods of this one; without a scene, this one.
WorldConfig config_of(const BenchOptions& options, const WorldConfig& config);

/// A world of that configuration, with the scene built.
std::unique_ptr<World> world_of(const BenchOptions& options, const WorldConfig& config, size_t threads = 1);

/// Balls about the scene's strikes in turn, each a little aside, the same for the same seed.
class SceneBlows {
 public:
  SceneBlows(const SceneSetup& scene, float radius_m, uint32_t seeds, uint64_t random_seed);
  CarveRequest next();

 private:
  const SceneSetup& scene_;
  float radius_m_;
  uint32_t seeds_;
  uint64_t random_seed_;
  size_t made_ = 0;
};

}  // namespace scree
