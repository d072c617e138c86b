#include "shared/field/redistance.h"

#include <algorithm>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Farther than the narrow band reaches: "not known yet".
constexpr float far_voxels = band_voxels + 1.0F;

/// Jacobi passes: each carries distances one voxel further; along a diagonal the band's depth of 3 takes 6.
constexpr int passes = 6;

/// Magnitudes of distances with a border of `far` all around, so that no pass looks outside.
struct Padded {
  int nx, ny, nz;
  std::vector<float> values;

  explicit Padded(const VoxelCoord& size)
      : nx(size.x + 2),
        ny(size.y + 2),
        nz(size.z + 2),
        values(static_cast<size_t>(nx) * static_cast<size_t>(ny) * static_cast<size_t>(nz), far_voxels) {}
  size_t row(int x, int y) const {
    return (static_cast<size_t>(x + 1) * static_cast<size_t>(ny) + static_cast<size_t>(y + 1)) *
               static_cast<size_t>(nz) +
           1;
  }
};

/// Godunov's upwind solution of |∇u| = 1 at unit spacing from the smaller neighbour along each axis.
inline float upwind(float p, float q, float r) {
  const float a = std::min(p, std::min(q, r));
  const float c = std::max(p, std::max(q, r));
  const float b = std::max(std::min(p, q), std::min(std::max(p, q), r));
  const float one = a + 1.0F;
  const float two = 0.5F * (a + b + std::sqrt(std::max(0.0F, 2.0F - (a - b) * (a - b))));
  const float sum = a + b + c;
  const float three =
      (sum + std::sqrt(std::max(0.0F, sum * sum - 3.0F * (a * a + b * b + c * c - 1.0F)))) * (1.0F / 3.0F);
  const float planar = two > c ? three : two;
  return one > b ? planar : one;
}

/// out := the update of every voxel; voxels that are not free keep their values.
void relax(const Padded& in, const std::vector<uint8_t>& free, Padded& out) {
  const size_t step_x = static_cast<size_t>(in.ny) * static_cast<size_t>(in.nz);
  const auto step_y = static_cast<size_t>(in.nz);
  for (int x = 0; x < in.nx - 2; ++x)
    for (int y = 0; y < in.ny - 2; ++y) {
      const size_t row = in.row(x, y);
      const float* u = in.values.data() + row;
      const uint8_t* open = free.data() + row;
      float* to = out.values.data() + row;
      for (int z = 0; z < in.nz - 2; ++z) {
        const float a = std::min(u[z - 1], u[z + 1]);
        const float b =
            std::min(u[z - static_cast<ptrdiff_t>(step_y)], u[z + static_cast<ptrdiff_t>(step_y)]);
        const float c =
            std::min(u[z - static_cast<ptrdiff_t>(step_x)], u[z + static_cast<ptrdiff_t>(step_x)]);
        const float next = std::min(u[z], upwind(a, b, c));
        to[z] = open[z] != 0 ? next : u[z];
      }
    }
}

void solve(Padded& distances, const std::vector<uint8_t>& free) {
  Padded other = distances;
  for (int pass = 0; pass < passes; pass += 2) {
    relax(distances, free, other);
    relax(other, free, distances);
  }
}

/// Calls f(x, y, z, window index, padded index) for every voxel, relative to the window.
template <typename F>
void for_each_voxel(const VoxelCoord& size, const Padded& padded, F&& f) {
  size_t i = 0;
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y) {
      const size_t row = padded.row(x, y);
      for (int z = 0; z < size.z; ++z, ++i) f(x, y, z, i, row + static_cast<size_t>(z));
    }
}

void write_codes(const VoxelCoord& size, const Padded& distances, const std::vector<uint8_t>& free,
                 const std::vector<uint8_t>& inside, Window& window) {
  for_each_voxel(size, distances, [&](int, int, int, size_t i, size_t p) {
    if (free[p] == 0) return;
    const float d = distances.values[p];
    window.codes[i] = encode(inside[p] != 0 ? -d : d);
  });
}

}  // namespace

void redistance(Window& window) {
  const VoxelCoord size = window.box.size();
  Padded distances(size);
  std::vector<uint8_t> inside(distances.values.size(), 0);
  std::vector<uint8_t> free(distances.values.size(), 0);
  for_each_voxel(size, distances,
                 [&](int, int, int, size_t i, size_t p) { inside[p] = window.codes[i] < 0; });
  const auto step_x = static_cast<size_t>(distances.ny) * static_cast<size_t>(distances.nz);
  const auto step_y = static_cast<size_t>(distances.nz);
  for_each_voxel(size, distances, [&](int x, int y, int z, size_t i, size_t p) {
    const bool border = x == 0 || y == 0 || z == 0 || x == size.x - 1 || y == size.y - 1 || z == size.z - 1;
    const uint8_t side = inside[p];
    const bool crossing =
        !border && (inside[p - 1] != side || inside[p + 1] != side || inside[p - step_y] != side ||
                    inside[p + step_y] != side || inside[p - step_x] != side || inside[p + step_x] != side);
    free[p] = !border && !crossing;
    if (free[p] == 0) distances.values[p] = std::abs(decode(window.codes[i]));
  });
  solve(distances, free);
  write_codes(size, distances, free, inside, window);
}

void distances_from_levels(const std::vector<float>& levels, Window& window) {
  const VoxelCoord size = window.box.size();
  CHECK(levels.size() == window.codes.size());
  Padded distances(size);
  std::vector<uint8_t> inside(distances.values.size(), 0);
  std::vector<uint8_t> free(distances.values.size(), 1);
  const auto nz = static_cast<size_t>(size.z);
  const size_t steps[3] = {static_cast<size_t>(size.y) * nz, nz, 1};
  for_each_voxel(size, distances, [&](int x, int y, int z, size_t i, size_t p) {
    const float here = levels[i];
    inside[p] = here < 0.0F;
    const int at[3] = {x, y, z};
    const int end[3] = {size.x, size.y, size.z};
    float sum = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      float nearest = far_voxels;
      const auto look = [&](float there) {
        if ((there < 0.0F) != (here < 0.0F)) nearest = std::min(nearest, here / (here - there));
      };
      if (at[axis] > 0) look(levels[i - steps[axis]]);
      if (at[axis] + 1 < end[axis]) look(levels[i + steps[axis]]);
      if (nearest < far_voxels) sum += 1.0F / std::max(nearest * nearest, 1e-12F);
    }
    if (sum > 0.0F) distances.values[p] = std::min(1.0F, 1.0F / std::sqrt(sum));
  });
  for_each_voxel(size, distances,
                 [&](int, int, int, size_t, size_t p) { free[p] = distances.values[p] >= far_voxels; });
  solve(distances, free);
  std::ranges::fill(free, uint8_t{1});
  write_codes(size, distances, free, inside, window);
}

}  // namespace scree
