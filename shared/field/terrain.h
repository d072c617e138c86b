// The generator of unedited terrain. Server and client generate the same bits; terrain crosses the wire only
// to clients that cannot generate it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string_view>

#include "shared/base/kind_table.h"
#include "shared/field/brick.h"

namespace scree {

/// flat: rock below y = 0. noise: the paper's repeating noise (section 2.2), with overhangs and caves.
/// canyon: noise, with a cliff along x = 0 and an arch in front of it.
enum class TerrainKind : uint8_t { flat = 0, noise = 1, canyon = 2 };

/// Soil covers ground below the one height, ice above the other (material.h).
struct MaterialHeights {
  float soil_below_m = 0.0F;
  float ice_above_m = 0.0F;
};

/// What the terrain is made of beside its form, which terrain.cpp generates.
struct TerrainRow {
  std::string_view name;
  MaterialHeights layers;
};

constexpr TerrainRow row_of(TerrainKind kind) {
  switch (kind) {
    case TerrainKind::flat:
      return {.name = "flat", .layers = {.soil_below_m = 1.0F, .ice_above_m = 1000.0F}};
    case TerrainKind::noise:
      return {.name = "noise", .layers = {.soil_below_m = 5.0F, .ice_above_m = 8.0F}};
    case TerrainKind::canyon:
      return {.name = "canyon", .layers = {.soil_below_m = 8.0F, .ice_above_m = 19.0F}};
  }
  return {};
}

struct TerrainSource {
  TerrainKind kind = TerrainKind::canyon;
  uint32_t random_seed = 1;
  float voxel_size_m = 0.25F;

  bool operator==(const TerrainSource&) const = default;
};

/// A chunk as generated. bricks[i] is never null; uniform bricks point to the shared ones.
struct GeneratedChunk {
  std::array<const Brick*, chunk_bricks * chunk_bricks * chunk_bricks> bricks;
  std::unique_ptr<Brick[]> storage;
};

/// A pure function of its arguments, safe to call from any thread; one-voxel steps change the distance by at
/// most one voxel (1-Lipschitz along the axes, up to the rounding of codes).
GeneratedChunk generate_chunk(const TerrainSource& source, ChunkCoord chunk);

/// Height below which generated terrain is only rock. Metres.
float floor_m(const TerrainSource& source);

/// Negative inside the undisturbed ground, without what stands on it (the canyon's arch). In metres, but not
/// a distance.
float ground_density(const TerrainSource& source, glm::vec3 p_m);

/// Height of the undisturbed ground under the sky at (x, z), found by marching down from above. Metres.
float ground_height_m(const TerrainSource& source, float x_m, float z_m);

}  // namespace scree
