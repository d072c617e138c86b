// The ground: unedited terrain, immutable, the same bits on server and client. A world is its ground and what
// was edited. Everything that needs unedited terrain asks these functions, and does not know where the ground
// is from: generated from a kind and a seed, or made from an elevation model (heights.h), with stored chunks
// of bricks in their places (stored_chunks.h).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string_view>

#include "shared/base/kind_table.h"
#include "shared/field/generated_chunk.h"
#include "shared/field/stored_chunks.h"
#include "shared/material/material.h"
#include "shared/material/rubble.h"

namespace scree {

/// flat: rock below y = 0. noise: the paper's repeating noise (section 2.2), with overhangs and caves.
/// canyon: noise, with a cliff along x = 0 and an arch in front of it.
enum class TerrainKind : uint8_t { flat = 0, noise = 1, canyon = 2 };

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

/// A handle: cheap to copy, any thread may read it.
struct TerrainSource {
  TerrainKind kind = TerrainKind::canyon;
  uint32_t random_seed = 1;
  float voxel_size_m = 0.25F;
  /// If there is one, the ground is made from it, and kind and seed mean nothing.
  std::shared_ptr<const GroundModel> heights{};
  GroundRows rows{};  ///< what it is made of
  Rubble rubble{};    ///< and what merges make of it

  bool operator==(const TerrainSource&) const = default;
};

/// Whether generate_chunk() is exact now. Where it is not, what is missing is noted as such (HeightModel).
/// What is there stays there.
bool is_here(const TerrainSource& source, ChunkCoord chunk);
/// The tiles that decide it: of the elevation model, and of the stored chunks, where layers can lie also of
/// those above. The ground is made from heights, and its model is complete.
std::vector<TileKey> tiles_of(const TerrainSource& source, ChunkCoord chunk);

/// A pure function of its arguments, safe to call from any thread; one-voxel steps change the distance by at
/// most one voxel (1-Lipschitz along the axes, up to the rounding of codes).
GeneratedChunk generate_chunk(const TerrainSource& source, ChunkCoord chunk);

/// Height below which the ground is only rock, and above which it is only air. Metres.
float floor_m(const TerrainSource& source);
float top_m(const TerrainSource& source);

/// As floor_m(), but of the columns of voxels of one column of chunks; at most as high as their surface.
float floor_m(const TerrainSource& source, int chunk_x, int chunk_z);

/// What the ground stores of a chunk of its voxel size: a chunk, or that it stores none.
ChunkLookup stored_chunk(const TerrainSource& source, ChunkCoord chunk);

/// Where the ground's layers lie.
MaterialHeights layers_of(const TerrainSource& source);

/// Half of what the ground covers in x and in z, around the origin; nothing when it has no end. Metres.
struct GroundExtent {
  float half_width_m;
  float half_depth_m;
};
std::optional<GroundExtent> extent_of(const TerrainSource& source);

/// A place above the middle of all that the ground covers, metres; nothing when it has no end.
std::optional<glm::vec3> place_above(const TerrainSource& source);

/// Negative inside the undisturbed ground, without what stands on it (the canyon's arch). In metres, but not
/// a distance.
float ground_density(const TerrainSource& source, glm::vec3 p_m);

/// Height of the undisturbed ground under the sky at (x, z), found by marching down from above. Metres.
float ground_height_m(const TerrainSource& source, float x_m, float z_m);

}  // namespace scree
