#include "shared/field/terrain_density.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/rough_noise.h"

namespace scree {

namespace {

/// The density function is sampled every second voxel and interpolated: it is smooth on that scale.
constexpr int lattice_step = 2;

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

  Lattice(const TerrainSource& source, const VoxelBox& box, Standing standing) {
    const auto density = standing == Standing::with_arch ? density_of : ground_of;
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
        std::optional<RoughColumn> rough;  // flat ground has none, and to compute it takes the longest
        if (source.kind != TerrainKind::flat) rough.emplace(x_m, y_m, source.random_seed);
        for (int z = 0; z < n[2]; ++z) {
          const float z_m = metres(box.lo.z, z);
          values.push_back(density(source.kind, {x_m, y_m, z_m}, rough ? rough->at(z_m) : 0.0F));
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

}  // namespace

float ground_of(TerrainKind kind, glm::vec3 p, float bump) {
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

float density_of(TerrainKind kind, glm::vec3 p, float bump) {
  const float below = ground_of(kind, p, bump);
  return kind == TerrainKind::canyon ? std::min(below, arch(p) + arch_roughness * bump) : below;
}

TerrainHeights heights_of(TerrainKind kind) {
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

Reach reach_of(const VoxelBox& box, float voxel_size_m, double bottom_m, double top_m) {
  if (static_cast<double>(box.lo.y) * static_cast<double>(voxel_size_m) > top_m) return Reach::air;
  if (static_cast<double>(box.hi.y) * static_cast<double>(voxel_size_m) < bottom_m) return Reach::rock;
  return Reach::surface;
}

Reach reach_of(const TerrainSource& source, const VoxelBox& box) {
  const TerrainHeights bounds = heights_of(source.kind);
  const Reach reach = reach_of(box, source.voxel_size_m, static_cast<double>(bounds.bottom_m),
                               static_cast<double>(bounds.top_m));
  if (reach != Reach::surface || source.kind == TerrainKind::flat) return reach;
  const auto metres_at = [&](VoxelCoord v) { return glm::vec3(v.x, v.y, v.z) * source.voxel_size_m; };
  const glm::vec3 lo_m = metres_at(box.lo), hi_m = metres_at(box.hi);
  const RoughRange rough = rough_range(lo_m, hi_m, source.random_seed);
  // The ground's density grows with height, away from the cliff, and with the noise.
  if (ground_of(source.kind, hi_m, rough.most_m) < 0.0F) return Reach::rock;
  const bool arched = source.kind == TerrainKind::canyon && arch_may_reach(lo_m, hi_m);
  return ground_of(source.kind, lo_m, rough.least_m) > 0.0F && !arched ? Reach::air : Reach::surface;
}

bool arch_may_reach(const TerrainSource& source, const VoxelBox& box) {
  if (source.kind != TerrainKind::canyon) return false;
  const auto metres_at = [&](VoxelCoord v) { return glm::vec3(v.x, v.y, v.z) * source.voxel_size_m; };
  return arch_may_reach(metres_at(box.lo), metres_at(box.hi));
}

Levels levels_of(const TerrainSource& source, const VoxelBox& box, Standing standing) {
  const Lattice lattice(source, box, standing);
  if (lattice.uniform) return {{}, lattice.values.front()};
  return {lattice.levels(), 0.0F};
}

}  // namespace scree
