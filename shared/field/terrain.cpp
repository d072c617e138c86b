#include "shared/field/terrain.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/base/check.h"
#include "shared/field/ground_layers.h"
#include "shared/field/redistance.h"
#include "shared/field/rough_noise.h"
#include "shared/field/terrain_density.h"

namespace scree {

namespace {

/// Voxels around a chunk that decide its distances: the narrow band, and one.
constexpr int apron = 4;

VoxelBox box_around(ChunkCoord chunk) {
  const VoxelCoord first = first_voxel(chunk);
  return VoxelBox{first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}}.grown(apron);
}

double metres(int32_t height) {
  return static_cast<double>(height) / height_steps_per_m;
}

Reach reach_of(const HeightLayout& layout, const VoxelBox& box, float voxel_size_m) {
  return reach_of(box, voxel_size_m, metres(layout.lowest), metres(layout.highest));
}

GeneratedChunk uniform_chunk(Reach reach, bool exact) {
  GeneratedChunk chunk = uniform_chunk(reach == Reach::air ? air_brick() : solid_brick());
  chunk.exact = exact;
  return chunk;
}

/// Height up to which all chunks of a column are rock by bounds of the noise, metres.
float rock_top_m(const TerrainSource& source, int chunk_x, int chunk_z) {
  const float side_m = static_cast<float>(chunk_size) * source.voxel_size_m;
  const float bottom_m = heights_of(source.kind).bottom_m;
  int y = floor_to_int(bottom_m / side_m);
  while (reach_of(source, box_around({chunk_x, y, chunk_z})) == Reach::rock) ++y;
  return std::max(bottom_m, static_cast<float>(y) * side_m);
}

/// The heights above a voxel are levels of which redistancing makes distances, also where it is steep.
GeneratedChunk chunk_of_heights(const TerrainSource& source, ChunkCoord coord) {
  const VoxelBox box = box_around(coord);
  const HeightModel& model = *source.heights;
  Reach reach = reach_of(model.layout(), box, source.voxel_size_m);
  if (reach != Reach::surface) return uniform_chunk(reach, true);
  const VoxelCoord size = box.size();
  const HeightPatch patch = heights_at(model, box.lo.x, box.lo.z, size.x, source.voxel_size_m);
  reach = reach_of(box, source.voxel_size_m, patch.lowest_m, patch.highest_m);
  if (reach != Reach::surface) return uniform_chunk(reach, patch.exact);
  Window window(box);
  std::vector<float> levels;
  levels.reserve(window.codes.size());
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y) {
      const double y_m = static_cast<double>(box.lo.y + y) * static_cast<double>(source.voxel_size_m);
      for (int z = 0; z < size.z; ++z)
        levels.push_back(static_cast<float>(y_m - patch.heights_m[static_cast<size_t>(z * size.x + x)]));
    }
  distances_from_levels(levels, window);
  GeneratedChunk chunk = split_into_bricks(window, coord);
  chunk.exact = patch.exact;
  return chunk;
}

/// As possible() of the layers, of a chunk.
bool may_be_layered(const GroundLayers& layers, ChunkCoord chunk) {
  const int first = first_voxel(chunk).y;
  return layers.possible(first, first + chunk_size);
}

/// So many chunks above one tell which layers lie in it.
int layer_chunks_above(const TerrainSource& source, ChunkCoord chunk) {
  const GroundLayers layers(source);
  return may_be_layered(layers, chunk) ? (layers.above() + chunk_size - 1) / chunk_size : 0;
}

/// The layers under a surface of heights: also of a chunk that is all rock.
void add_layers_of_heights(const TerrainSource& source, ChunkCoord coord, GeneratedChunk& chunk) {
  const GroundLayers layers(source);
  if (!may_be_layered(layers, coord)) return;
  const VoxelCoord first = first_voxel(coord);
  const HeightPatch patch = heights_at(*source.heights, first.x, first.z, chunk_size, source.voxel_size_m);
  chunk.exact = chunk.exact && patch.exact;
  const auto y_m = [&](int y) {
    return static_cast<double>(first.y + y) * static_cast<double>(source.voxel_size_m);
  };
  if (y_m(0) >= patch.highest_m || y_m(chunk_size + layers.above()) < patch.lowest_m) return;
  chunk.stored_materials = layers_of_chunk(layers, coord, [&](int x, int y, int z) {
    return y_m(y) < patch.heights_m[static_cast<size_t>(z * chunk_size + x)];
  });
}

/// Densities in a box of which a window, or a chunk, is a part.
struct LevelBox {
  VoxelBox box;
  Levels levels;

  size_t index(int x, int y, int z) const {
    const VoxelCoord size = box.size();
    return (static_cast<size_t>(x - box.lo.x) * static_cast<size_t>(size.y) +
            static_cast<size_t>(y - box.lo.y)) *
               static_cast<size_t>(size.z) +
           static_cast<size_t>(z - box.lo.z);
  }
  /// Those of a box that is lower alone.
  std::vector<float> below(const VoxelBox& part) const {
    std::vector<float> values;
    values.reserve(Window::count(part));
    const auto count = static_cast<ptrdiff_t>(part.size().y) * part.size().z;
    for (int x = part.lo.x; x < part.hi.x; ++x) {
      const auto from = levels.values.begin() + static_cast<ptrdiff_t>(index(x, part.lo.y, part.lo.z));
      values.insert(values.end(), from, from + count);
    }
    return values;
  }
};

/// Layers are of the ground alone: where something else may stand on it, its densities are computed apart.
void add_layers(const TerrainSource& source, ChunkCoord coord, const GroundLayers& layers,
                const LevelBox& with_all, GeneratedChunk& chunk) {
  const VoxelCoord first = first_voxel(coord);
  const LevelBox* at = &with_all;
  LevelBox alone;
  if (arch_may_reach(source, with_all.box)) {
    alone.box = with_all.box;
    alone.levels = levels_of(source, alone.box, Standing::ground_alone);
    if (alone.levels.values.empty()) return;
    at = &alone;
  }
  chunk.stored_materials = layers_of_chunk(layers, coord, [&](int x, int y, int z) {
    return at->levels.values[at->index(first.x + x, first.y + y, first.z + z)] < 0.0F;
  });
}

GeneratedChunk generated(const TerrainSource& source, ChunkCoord coord) {
  const VoxelBox box = box_around(coord);
  const GroundLayers layers(source);
  LevelBox around{box, {}};
  const bool layered = may_be_layered(layers, coord);
  if (layered) around.box.hi.y = std::max(box.hi.y, (box.hi.y - apron + layers.above() + 1) / 2 * 2);
  if (const Reach reach = reach_of(source, around.box); reach != Reach::surface)
    return uniform_chunk(reach, true);
  around.levels = levels_of(source, around.box, Standing::with_arch);
  const Levels& levels = around.levels;
  if (levels.values.empty()) return uniform_chunk(levels.sign < 0.0F ? solid_brick() : air_brick());
  Window window(box);
  distances_from_levels(around.box == box ? levels.values : around.below(box), window);
  GeneratedChunk chunk = split_into_bricks(window, coord);
  if (layered) add_layers(source, coord, layers, around, chunk);
  return chunk;
}

/// The code of the voxel nearest to a place, where the ground stores its chunk.
std::optional<Code> stored_code(const TerrainSource& source, glm::vec3 p_m) {
  if (!source.heights->bricks()) return std::nullopt;
  const glm::vec3 p = p_m / source.voxel_size_m + 0.5F;
  const VoxelCoord voxel{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
  const ChunkLookup lookup = stored_chunk(source, chunk_of(voxel));
  if (lookup.chunk == nullptr) return std::nullopt;
  const Brick& brick = *lookup.chunk->bricks[static_cast<size_t>(index_in_chunk(brick_of(voxel)))];
  return brick.codes[static_cast<size_t>(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7))];
}

/// Through the stored chunks of the column from above, as far as the model's surface.
float height_of_ground_m(const TerrainSource& source, float x_m, float z_m) {
  const auto surface_m =
      static_cast<float>(height_at(*source.heights, static_cast<double>(x_m), static_cast<double>(z_m)));
  const auto& bricks = source.heights->bricks();
  if (!bricks) return surface_m;
  for (float y_m = bricks->top_m(); y_m > bricks->bottom_m(); y_m -= source.voxel_size_m) {
    const auto code = stored_code(source, {x_m, y_m, z_m});
    if (code ? *code < 0 : y_m < surface_m) return code ? y_m : surface_m;
  }
  return std::min(surface_m, bricks->bottom_m());
}

}  // namespace

ChunkLookup stored_chunk(const TerrainSource& source, ChunkCoord chunk) {
  const auto key = source.heights ? stored_key(*source.heights, chunk, source.voxel_size_m) : std::nullopt;
  return key ? source.heights->chunk(*key) : ChunkLookup{};
}

bool is_here(const TerrainSource& source, ChunkCoord chunk) {
  if (source.heights == nullptr) return true;
  const GroundModel& model = *source.heights;
  const ChunkLookup stored = stored_chunk(source, chunk);
  bool all = stored.known;
  const int above = layer_chunks_above(source, chunk);
  for (int i = 1; i <= above; ++i) all = stored_chunk(source, chunk + ChunkCoord{0, i, 0}).known && all;
  VoxelBox box = box_around(chunk);
  box.hi.y += above * chunk_size;
  const bool by_heights = stored.chunk == nullptr || above > 0;
  if (!by_heights || reach_of(model.layout(), box, source.voxel_size_m) != Reach::surface) return all;
  for (const TileKey key : tiles_of(model.layout(), chunk, source.voxel_size_m))
    all = model.tile(key) != nullptr && all;
  return all;
}

std::vector<TileKey> tiles_of(const TerrainSource& source, ChunkCoord chunk) {
  CHECK(source.heights != nullptr);
  std::vector<TileKey> keys = tiles_of(source.heights->layout(), chunk, source.voxel_size_m);
  for (int i = 0, above = layer_chunks_above(source, chunk); i <= above; ++i)
    if (const auto key = stored_tile_of(*source.heights, chunk + ChunkCoord{0, i, 0}, source.voxel_size_m))
      keys.push_back(*key);
  return keys;
}

GeneratedChunk generate_chunk(const TerrainSource& source, ChunkCoord chunk) {
  if (source.heights != nullptr) {
    const ChunkLookup stored = stored_chunk(source, chunk);
    if (stored.chunk != nullptr) return copy_of(*stored.chunk);
    GeneratedChunk made = chunk_of_heights(source, chunk);
    add_layers_of_heights(source, chunk, made);
    made.exact = made.exact && stored.known;
    return made;
  }
  return generated(source, chunk);
}

float floor_m(const TerrainSource& source) {
  if (source.heights == nullptr) return heights_of(source.kind).bottom_m;
  const auto low_m = static_cast<float>(metres(source.heights->layout().lowest));
  const auto& bricks = source.heights->bricks();
  return bricks ? std::min(low_m, bricks->bottom_m()) : low_m;
}

float top_m(const TerrainSource& source) {
  if (source.heights == nullptr) return heights_of(source.kind).top_m;
  const auto high_m = static_cast<float>(metres(source.heights->layout().highest));
  const auto& bricks = source.heights->bricks();
  return bricks ? std::max(high_m, bricks->top_m()) : high_m;
}

float floor_m(const TerrainSource& source, int chunk_x, int chunk_z) {
  if (source.heights == nullptr) return rock_top_m(source, chunk_x, chunk_z);
  const HeightPatch patch = heights_at(*source.heights, chunk_x * chunk_size, chunk_z * chunk_size,
                                       chunk_size, source.voxel_size_m);
  const auto low_m = static_cast<float>(patch.lowest_m);
  // Among stored chunks there may be caves.
  const auto& bricks = source.heights->bricks();
  const bool stored =
      bricks && stored_key(*source.heights, {chunk_x, bricks->lo.y, chunk_z}, source.voxel_size_m);
  return stored ? std::min(low_m, bricks->bottom_m()) : low_m;
}

MaterialHeights layers_of(const TerrainSource& source) {
  return source.heights != nullptr ? source.heights->layout().layers : traits_of(source.kind).layers;
}

std::optional<GroundExtent> extent_of(const TerrainSource& source) {
  if (source.heights == nullptr) return std::nullopt;
  const HeightLayout& layout = source.heights->layout();
  GroundExtent extent{layout.half_width_m(), layout.half_depth_m()};
  if (const auto& bricks = source.heights->bricks()) {
    const float chunk_m = bricks->voxel_size_m * static_cast<float>(chunk_size);
    extent.half_width_m =
        std::max(extent.half_width_m, static_cast<float>(std::max(-bricks->lo.x, bricks->hi.x)) * chunk_m);
    extent.half_depth_m =
        std::max(extent.half_depth_m, static_cast<float>(std::max(-bricks->lo.z, bricks->hi.z)) * chunk_m);
  }
  return extent;
}

std::optional<glm::vec3> place_above(const TerrainSource& source) {
  constexpr float above_m = 20.0F;
  if (!extent_of(source)) return std::nullopt;
  return glm::vec3(0.0F, top_m(source) + above_m, 0.0F);
}

float ground_density(const TerrainSource& source, glm::vec3 p_m) {
  if (source.heights == nullptr)
    return ground_of(source.kind, p_m, RoughColumn(p_m.x, p_m.y, source.random_seed).at(p_m.z));
  if (const auto code = stored_code(source, p_m)) return decode(*code) * source.voxel_size_m;
  return static_cast<float>(static_cast<double>(p_m.y) - height_at(*source.heights,
                                                                   static_cast<double>(p_m.x),
                                                                   static_cast<double>(p_m.z)));
}

float ground_height_m(const TerrainSource& source, float x_m, float z_m) {
  if (source.heights != nullptr) return height_of_ground_m(source, x_m, z_m);
  constexpr float step_m = 0.25F;
  const TerrainHeights bounds = heights_of(source.kind);
  float y = bounds.top_m + step_m;
  const auto level = [&](float y_m) {
    return density_of(source.kind, {x_m, y_m, z_m}, RoughColumn(x_m, y_m, source.random_seed).at(z_m));
  };
  while (y > bounds.bottom_m && level(y) >= 0.0F) y -= step_m;
  return y;
}

}  // namespace scree
