// Scenes and scripted blows, written once for benchmarks, tests and the demo.
#pragma once

#include <cstdint>
#include <optional>

#include "server/world/world.h"

namespace scree {

/// A carve of a ball about the surface of the ground at (x, z), struck from above.
CarveRequest blow_at(const TerrainSource& terrain, float x_m, float z_m, float radius_m, uint32_t seeds,
                     uint32_t random_seed);

/// Blows scattered over a square about the origin, the same for the same seed.
class ScatteredBlows {
 public:
  ScatteredBlows(const TerrainSource& terrain, float half_width_m, float radius_m, uint32_t seeds,
                 uint64_t random_seed);
  CarveRequest next();

 private:
  TerrainSource terrain_;
  float half_width_m_;
  float radius_m_;
  uint32_t seeds_;
  uint64_t state_;
};

/// Blows side by side in a square about the origin, each once, row by row.
class BlowGrid {
 public:
  BlowGrid(const TerrainSource& terrain, uint32_t blows_a_side, float spacing_m, float radius_m,
           uint32_t seeds);
  /// Nothing after the last.
  std::optional<CarveRequest> next();

 private:
  TerrainSource terrain_;
  uint32_t blows_a_side_;
  float spacing_m_;
  float radius_m_;
  uint32_t seeds_;
  uint32_t made_ = 0;
};

}  // namespace scree
