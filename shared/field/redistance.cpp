#include "shared/field/redistance.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"

namespace scree {

namespace {

/// Farther than the narrow band reaches: "not known yet".
constexpr float far_voxels = band_voxels + 1.0F;

/// Jacobi passes: each carries distances one voxel further; along a diagonal the band's depth of 3 takes 6.
constexpr int passes = 6;

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

/// The update of a row of voxels, but never below their floors. No branch, so that it runs in vectors.
SCREE_VECTOR_CLONES
void relax_row(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const float* __restrict u,
               const float* __restrict floor, float* __restrict out) {
  for (ptrdiff_t z = 0; z < count; ++z) {
    const float a = std::min(u[z - 1], u[z + 1]);
    const float b = std::min(u[z - step_y], u[z + step_y]);
    const float c = std::min(u[z - step_x], u[z + step_x]);
    out[z] = std::max(floor[z], std::min(u[z], upwind(a, b, c)));
  }
}

/// A window's magnitudes and sides with a border all around, so that no pass looks outside; and for each row
/// along z how many rows away the nearest source of distances is, so that passes skip what they cannot reach.
class Solver {
 public:
  explicit Solver(const VoxelCoord& size)
      : size_(size),
        step_y_(static_cast<ptrdiff_t>(size.z) + 2),
        step_x_(step_y_ * (size.y + 2)),
        magnitudes_(static_cast<size_t>(step_x_) * static_cast<size_t>(size.x + 2), far_voxels),
        floors_(magnitudes_.size(), 0.0F),
        inside_(magnitudes_.size(), 0),
        row_distance_(static_cast<size_t>(size.x) * static_cast<size_t>(size.y), passes + 1) {}

  /// Index of the first voxel of a row in the padded arrays.
  size_t row(int x, int y) const { return static_cast<size_t>((x + 1) * step_x_ + (y + 1) * step_y_ + 1); }
  bool on_border(int x, int y) const { return x == 0 || y == 0 || x + 1 == size_.x || y + 1 == size_.y; }

  void set_inside(size_t at, bool inside) { inside_[at] = inside ? 1 : 0; }
  bool inside(size_t at) const { return inside_[at] != 0; }

  /// Whether some voxel of the row has a neighbour within the window on the other side.
  bool crosses(int x, int y) const {
    const uint8_t* own = inside_.data() + row(x, y);
    const auto count = static_cast<size_t>(size_.z);
    const auto differs = [&](bool exists, ptrdiff_t step) {
      return exists && std::memcmp(own, own + step, count) != 0;
    };
    return std::memcmp(own, own + 1, count - 1) != 0 || differs(x > 0, -step_x_) ||
           differs(x + 1 < size_.x, step_x_) || differs(y > 0, -step_y_) || differs(y + 1 < size_.y, step_y_);
  }

  bool crosses_at(size_t at) const {
    const uint8_t side = inside_[at];
    const uint8_t* p = inside_.data() + at;
    return p[-1] != side || p[1] != side || p[-step_y_] != side || p[step_y_] != side ||
           p[-step_x_] != side || p[step_x_] != side;
  }

  /// The voxel keeps this magnitude, and others measure from it.
  void fix(int x, int y, size_t at, float magnitude) {
    magnitudes_[at] = magnitude;
    floors_[at] = magnitude;
    if (magnitude < band_voxels) row_distance_[row_index(x, y)] = 0;
  }

  void solve() {
    spread_row_distances();
    std::vector<float> other = magnitudes_;
    for (int pass = 0; pass < passes; pass += 2) {
      relax(magnitudes_, other, pass + 1);
      relax(other, magnitudes_, pass + 2);
    }
  }

  /// Code of a voxel that is not fixed.
  Code code(size_t at) const { return encode(inside_[at] != 0 ? -magnitudes_[at] : magnitudes_[at]); }

 private:
  size_t row_index(int x, int y) const {
    return static_cast<size_t>(x) * static_cast<size_t>(size_.y) + static_cast<size_t>(y);
  }

  void spread_row_distances() {
    for (int step = 1; step <= passes; ++step)
      for (int x = 0; x < size_.x; ++x)
        for (int y = 0; y < size_.y; ++y) {
          if (row_distance_[row_index(x, y)] != step - 1) continue;
          const auto offer = [&](int i, int j) {
            if (i < 0 || j < 0 || i >= size_.x || j >= size_.y) return;
            int& there = row_distance_[row_index(i, j)];
            there = std::min(there, step);
          };
          offer(x - 1, y);
          offer(x + 1, y);
          offer(x, y - 1);
          offer(x, y + 1);
        }
  }

  /// to := the update of every voxel within reach of a source.
  void relax(const std::vector<float>& from, std::vector<float>& to, int reach) const {
    for (int x = 0; x < size_.x; ++x)
      for (int y = 0; y < size_.y; ++y) {
        if (row_distance_[row_index(x, y)] > reach) continue;
        const size_t first = row(x, y);
        relax_row(size_.z, step_x_, step_y_, from.data() + first, floors_.data() + first, to.data() + first);
      }
  }

  VoxelCoord size_;
  ptrdiff_t step_y_;
  ptrdiff_t step_x_;
  std::vector<float> magnitudes_;
  std::vector<float> floors_;  ///< a fixed voxel's own magnitude, else 0
  std::vector<uint8_t> inside_;
  std::vector<int> row_distance_;
};

/// Distance to the zero set along the axes that cross it, from level `here` at `index`; as fast marching
/// starts.
float crossing_distance(const std::vector<float>& levels, const VoxelCoord& size, int x, int y, int z,
                        size_t index) {
  const auto nz = static_cast<size_t>(size.z);
  const size_t steps[3] = {static_cast<size_t>(size.y) * nz, nz, 1};
  const int at[3] = {x, y, z};
  const int end[3] = {size.x, size.y, size.z};
  const float here = levels[index];
  float sum = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    float nearest = far_voxels;
    const auto look = [&](float there) {
      if ((there < 0.0F) != (here < 0.0F)) nearest = std::min(nearest, here / (here - there));
    };
    if (at[axis] > 0) look(levels[index - steps[axis]]);
    if (at[axis] + 1 < end[axis]) look(levels[index + steps[axis]]);
    if (nearest < far_voxels) sum += 1.0F / std::max(nearest * nearest, 1e-12F);
  }
  return sum > 0.0F ? std::min(1.0F, 1.0F / std::sqrt(sum)) : far_voxels;
}

/// Calls f(x, y, index in the window, index in the solver) for each row along z.
template <typename F>
void for_each_row(const VoxelCoord& size, const Solver& solver, F&& f) {
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y)
      f(x, y, static_cast<size_t>(x * size.y + y) * static_cast<size_t>(size.z), solver.row(x, y));
}

}  // namespace

void redistance(Window& window) {
  const VoxelCoord size = window.box.size();
  const auto nz = static_cast<size_t>(size.z);
  Solver solver(size);
  for_each_row(size, solver, [&](int, int, size_t i, size_t p) {
    for (size_t z = 0; z < nz; ++z) solver.set_inside(p + z, window.codes[i + z] < 0);
  });
  std::vector<uint8_t> fixed(window.codes.size(), 0);
  for_each_row(size, solver, [&](int x, int y, size_t i, size_t p) {
    const bool border_row = solver.on_border(x, y);
    const bool crosses = !border_row && solver.crosses(x, y);
    for (size_t z = 0; z < nz; ++z) {
      const bool border = border_row || z == 0 || z + 1 == nz;
      if (!border && !(crosses && solver.crosses_at(p + z))) continue;
      fixed[i + z] = 1;
      solver.fix(x, y, p + z, std::abs(decode(window.codes[i + z])));
    }
  });
  solver.solve();
  for_each_row(size, solver, [&](int, int, size_t i, size_t p) {
    for (size_t z = 0; z < nz; ++z)
      if (fixed[i + z] == 0) window.codes[i + z] = solver.code(p + z);
  });
}

void distances_from_levels(const std::vector<float>& levels, Window& window) {
  const VoxelCoord size = window.box.size();
  const auto nz = static_cast<size_t>(size.z);
  CHECK(levels.size() == window.codes.size());
  Solver solver(size);
  for_each_row(size, solver, [&](int, int, size_t i, size_t p) {
    for (size_t z = 0; z < nz; ++z) solver.set_inside(p + z, levels[i + z] < 0.0F);
  });
  for_each_row(size, solver, [&](int x, int y, size_t i, size_t p) {
    if (!solver.crosses(x, y)) return;
    for (size_t z = 0; z < nz; ++z) {
      const float d = crossing_distance(levels, size, x, y, static_cast<int>(z), i + z);
      if (d < far_voxels) solver.fix(x, y, p + z, d);
    }
  });
  solver.solve();
  for_each_row(size, solver, [&](int, int, size_t i, size_t p) {
    for (size_t z = 0; z < nz; ++z) window.codes[i + z] = solver.code(p + z);
  });
}

}  // namespace scree
