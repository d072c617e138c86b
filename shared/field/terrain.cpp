#include "shared/field/terrain.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/redistance.h"
#include "shared/field/rough_noise.h"

namespace scree {

namespace {

/// The density function is sampled every second voxel and interpolated: it is smooth on that scale.
constexpr int lattice_step = 2;
/// Voxels around a chunk that decide its distances: the narrow band, and one.
constexpr int apron = 4;

constexpr float cliff_height_m = 16.0F;
constexpr float canyon_roughness = 0.4F;  ///< the canyon's noise, relative to the open terrain's
constexpr float arch_x_m = 15.0F;
constexpr float arch_radius_m = 7.5F;
constexpr float arch_thickness_m = 1.9F;
constexpr float arch_roughness = 0.12F;  ///< the arch's noise, likewise

/// A half torus that stands across the z axis.
float arch(glm::vec3 p) {
  const float ring = std::sqrt(p.y * p.y + p.z * p.z) - arch_radius_m;
  const float x = p.x - arch_x_m;
  return std::sqrt(ring * ring + x * x) - arch_thickness_m;
}

/// Whether the arch, with all that the noise may add to it, reaches into the box.
bool arch_may_reach(glm::vec3 lo_m, glm::vec3 hi_m) {
  constexpr float around_m = arch_thickness_m + arch_roughness * amplitude_sum_m + 0.1F;
  constexpr float span_m = arch_radius_m + around_m;
  return lo_m.x < arch_x_m + around_m && hi_m.x > arch_x_m - around_m && lo_m.y < span_m &&
         hi_m.y > -span_m && lo_m.z < span_m && hi_m.z > -span_m;
}

/// The ground alone, without the canyon's arch.
float ground(TerrainKind kind, glm::vec3 p, float bump) {
  switch (kind) {
    case TerrainKind::flat:
      return p.y;
    case TerrainKind::noise:
      return p.y + bump;
    case TerrainKind::canyon:
      const float step = blend(std::clamp(0.5F - p.x / 5.0F, 0.0F, 1.0F));
      return p.y - cliff_height_m * step + canyon_roughness * bump;
  }
  CHECK(is_known(kind));
  return 0.0F;
}

/// Negative inside rock; the zero set is the surface. In metres, but not a distance. `bump` is the noise at
/// p.
float density(TerrainKind kind, glm::vec3 p, float bump) {
  const float below = ground(kind, p, bump);
  return kind == TerrainKind::canyon ? std::min(below, arch(p) + arch_roughness * bump) : below;
}

/// Above `top` there is only air, below `bottom` only rock.
struct Heights {
  float bottom_m;
  float top_m;
};

Heights heights(TerrainKind kind) {
  switch (kind) {
    case TerrainKind::flat:
      return {0.0F, 0.0F};
    case TerrainKind::noise:
      return {-amplitude_sum_m, amplitude_sum_m};
    case TerrainKind::canyon:
      return {-amplitude_sum_m * canyon_roughness, cliff_height_m + amplitude_sum_m};
  }
  CHECK(is_known(kind));
  return {};
}

/// Means of eight lattice values around voxels along z, of which every second one lies between two of the
/// lattice: `a` to `d` are the rows of the lattice around theirs.
SCREE_VECTOR_CLONES
void interpolate_row(size_t cells, const float* __restrict a, const float* __restrict b,
                     const float* __restrict c, const float* __restrict d, float* __restrict out) {
  for (size_t k = 0; k < cells; ++k) {
    const float on = ((a[k] + a[k]) + (b[k] + b[k])) + ((c[k] + c[k]) + (d[k] + d[k]));
    const float between = ((a[k] + a[k + 1]) + (b[k] + b[k + 1])) + ((c[k] + c[k + 1]) + (d[k] + d[k + 1]));
    out[2 * k] = on * 0.125F;
    out[2 * k + 1] = between * 0.125F;
  }
}

/// Densities at the even voxels of `box`, whose bounds are even.
struct Lattice {
  int n[3];
  std::vector<float> values;
  bool uniform = true;

  Lattice(const TerrainSource& source, const VoxelBox& box) {
    const VoxelCoord size = box.size();
    CHECK(((box.lo.x | box.lo.y | box.lo.z | size.x | size.y | size.z) & 1) == 0);
    n[0] = size.x / lattice_step + 1;
    n[1] = size.y / lattice_step + 1;
    n[2] = size.z / lattice_step + 1;
    values.reserve(static_cast<size_t>(n[0]) * static_cast<size_t>(n[1]) * static_cast<size_t>(n[2]));
    for (int x = 0; x < n[0]; ++x)
      for (int y = 0; y < n[1]; ++y) {
        const auto metres = [&](int first, int steps) {
          return static_cast<float>(first + steps * lattice_step) * source.voxel_size_m;
        };
        const float x_m = metres(box.lo.x, x), y_m = metres(box.lo.y, y);
        RoughColumn rough(x_m, y_m, source.random_seed);
        for (int z = 0; z < n[2]; ++z) {
          const float z_m = metres(box.lo.z, z);
          values.push_back(density(source.kind, {x_m, y_m, z_m}, rough.at(z_m)));
          uniform = uniform && (values.back() < 0.0F) == (values.front() < 0.0F);
        }
      }
  }

  /// The values along z.
  const float* row(int x, int y) const {
    CHECK_DEBUG(x >= 0 && y >= 0 && x < n[0] && y < n[1]);
    return values.data() + (static_cast<size_t>(x) * static_cast<size_t>(n[1]) + static_cast<size_t>(y)) *
                               static_cast<size_t>(n[2]);
  }

  /// Trilinear values at the voxels, in a window's order.
  std::vector<float> levels() const {
    const int size_x = (n[0] - 1) * lattice_step, size_y = (n[1] - 1) * lattice_step;
    const auto cells = static_cast<size_t>(n[2] - 1), size_z = cells * lattice_step;
    std::vector<float> levels(static_cast<size_t>(size_x) * static_cast<size_t>(size_y) * size_z);
    float* out = levels.data();
    for (int x = 0; x < size_x; ++x)
      for (int y = 0; y < size_y; ++y, out += size_z) {
        const int i = x / 2, j = y / 2, i1 = i + (x & 1), j1 = j + (y & 1);
        interpolate_row(cells, row(i, j), row(i, j1), row(i1, j), row(i1, j1), out);
      }
    return levels;
  }
};

/// The part of the box in which the ground's surface can lie.
enum class Reach { air, rock, surface };

Reach reach_of(const VoxelBox& box, float voxel_size_m, double bottom_m, double top_m) {
  if (static_cast<double>(box.lo.y) * static_cast<double>(voxel_size_m) > top_m) return Reach::air;
  if (static_cast<double>(box.hi.y) * static_cast<double>(voxel_size_m) < bottom_m) return Reach::rock;
  return Reach::surface;
}

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

/// What bounds of the noise prove of the ground in a box: `surface` where they prove nothing.
Reach reach_of(const TerrainSource& source, const VoxelBox& box) {
  const Heights bounds = heights(source.kind);
  const Reach reach = reach_of(box, source.voxel_size_m, static_cast<double>(bounds.bottom_m),
                               static_cast<double>(bounds.top_m));
  if (reach != Reach::surface || source.kind == TerrainKind::flat) return reach;
  const auto metres_at = [&](VoxelCoord v) { return glm::vec3(v.x, v.y, v.z) * source.voxel_size_m; };
  const glm::vec3 lo_m = metres_at(box.lo), hi_m = metres_at(box.hi);
  const RoughRange rough = rough_range(lo_m, hi_m, source.random_seed);
  // The ground's density grows with height, away from the cliff, and with the noise.
  if (ground(source.kind, hi_m, rough.most_m) < 0.0F) return Reach::rock;
  const bool arched = source.kind == TerrainKind::canyon && arch_may_reach(lo_m, hi_m);
  return ground(source.kind, lo_m, rough.least_m) > 0.0F && !arched ? Reach::air : Reach::surface;
}

/// Height up to which all chunks of a column are rock by bounds of the noise, metres.
float rock_top_m(const TerrainSource& source, int chunk_x, int chunk_z) {
  const float side_m = static_cast<float>(chunk_size) * source.voxel_size_m;
  const float bottom_m = heights(source.kind).bottom_m;
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
  if (stored.chunk != nullptr ||
      reach_of(model.layout(), box_around(chunk), source.voxel_size_m) != Reach::surface)
    return all;
  for (const TileKey key : tiles_of(model.layout(), chunk, source.voxel_size_m))
    all = model.tile(key) != nullptr && all;
  return all;
}

GeneratedChunk generate_chunk(const TerrainSource& source, ChunkCoord chunk) {
  if (source.heights != nullptr) {
    const ChunkLookup stored = stored_chunk(source, chunk);
    if (stored.chunk != nullptr) return copy_of(*stored.chunk);
    GeneratedChunk made = chunk_of_heights(source, chunk);
    made.exact = made.exact && stored.known;
    return made;
  }
  const VoxelBox box = box_around(chunk);
  if (const Reach reach = reach_of(source, box); reach != Reach::surface) return uniform_chunk(reach, true);
  const Lattice lattice(source, box);
  if (lattice.uniform) return uniform_chunk(lattice.values.front() < 0.0F ? solid_brick() : air_brick());
  Window window(box);
  distances_from_levels(lattice.levels(), window);
  return split_into_bricks(window, chunk);
}

float floor_m(const TerrainSource& source) {
  if (source.heights == nullptr) return heights(source.kind).bottom_m;
  const auto low_m = static_cast<float>(metres(source.heights->layout().lowest));
  const auto& bricks = source.heights->bricks();
  return bricks ? std::min(low_m, bricks->bottom_m()) : low_m;
}

float top_m(const TerrainSource& source) {
  if (source.heights == nullptr) return heights(source.kind).top_m;
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
    return ground(source.kind, p_m, RoughColumn(p_m.x, p_m.y, source.random_seed).at(p_m.z));
  if (const auto code = stored_code(source, p_m)) return decode(*code) * source.voxel_size_m;
  return static_cast<float>(static_cast<double>(p_m.y) - height_at(*source.heights,
                                                                   static_cast<double>(p_m.x),
                                                                   static_cast<double>(p_m.z)));
}

float ground_height_m(const TerrainSource& source, float x_m, float z_m) {
  if (source.heights != nullptr) return height_of_ground_m(source, x_m, z_m);
  constexpr float step_m = 0.25F;
  const Heights bounds = heights(source.kind);
  float y = bounds.top_m + step_m;
  const auto level = [&](float y_m) {
    return density(source.kind, {x_m, y_m, z_m}, RoughColumn(x_m, y_m, source.random_seed).at(z_m));
  };
  while (y > bounds.bottom_m && level(y) >= 0.0F) y -= step_m;
  return y;
}

}  // namespace scree
