#include "shared/field/redistance.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"

namespace scree {

namespace {

/// Farther than the narrow band reaches: "not known yet".
constexpr float far_voxels = band_voxels + 1.0F;

/// Jacobi passes: each carries distances one voxel further; along a diagonal the band's depth of 3 takes 6.
/// From codes, which are distances next to the surface already, 4 give the same (measured: benches seams and
/// recombine).
constexpr int passes_of_levels = 6;
constexpr int passes_of_codes = 4;

/// Godunov's upwind solution of |∇u| = 1 at unit spacing from the smaller neighbour along each axis. glm::min
/// and glm::max give the same bits as std's, but take values. With std's references the values stay in memory
/// under AddressSanitizer, and clang does not vectorise the loop below.
inline float upwind(float p, float q, float r) {
  const float a = glm::min(p, glm::min(q, r));
  const float c = glm::max(p, glm::max(q, r));
  const float b = glm::max(glm::min(p, q), glm::min(glm::max(p, q), r));
  const float one = a + 1.0F;
  const float two = 0.5F * (a + b + std::sqrt(glm::max(0.0F, 2.0F - (a - b) * (a - b))));
  const float sum = a + b + c;
  const float three =
      (sum + std::sqrt(glm::max(0.0F, sum * sum - 3.0F * (a * a + b * b + c * c - 1.0F)))) * (1.0F / 3.0F);
  const float planar = two > c ? three : two;
  return one > b ? planar : one;
}

/// Where the neighbours of a first voxel lie, in pairs by axis. A pointer for each: what LLVM knows to be the
/// same numbers it carries from turn to turn, and puts no such loop into vectors.
struct Neighbours {
  const float *z0, *z1, *y0, *y1, *x0, *x1;
};

/// The update of voxels, but never below their floors. No branch, so that it runs in vectors.
SCREE_VECTOR_CLONES
void relax_rows(ptrdiff_t count, const Neighbours& near, const float* __restrict u,
                const float* __restrict floor, float* __restrict out) {
  const auto [z0, z1, y0, y1, x0, x1] = near;
  for (ptrdiff_t z = 0; z < count; ++z) {
    const float a = glm::min(z0[z], z1[z]);
    const float b = glm::min(y0[z], y1[z]);
    const float c = glm::min(x0[z], x1[z]);
    out[z] = glm::max(floor[z], glm::min(u[z], upwind(a, b, c)));
  }
}

/// Updates all voxels but those of the outermost layer, which must be fixed or unused; where all rows count
/// as sources, fixed. Voxels far from any source are skipped, plane by plane. The rows of a plane are updated
/// in one loop, as a row is shorter than a few vectors; values computed across the ends of rows fall in the
/// outermost layer.
class Solver {
 public:
  explicit Solver(const VoxelCoord& size)
      : size_(size),
        step_y_(size.z),
        step_x_(step_y_ * size.y),
        magnitudes_(static_cast<size_t>(step_x_) * static_cast<size_t>(size.x), far_voxels),
        floors_(magnitudes_.size(), 0.0F),
        sources_(static_cast<size_t>(size.x)) {}

  float* magnitudes() { return magnitudes_.data(); }
  const float* magnitudes() const { return magnitudes_.data(); }
  float* floors() { return floors_.data(); }  ///< a fixed voxel's own magnitude, else 0

  /// Row y of plane x holds voxels that others measure from.
  void add_source(int x, int y) {
    CHECK_DEBUG(x >= 0 && x < size_.x && y >= 0 && y < size_.y);
    Rows& rows = sources_[static_cast<size_t>(x)];
    rows = {std::min(rows.first, y), std::max(rows.last, y)};
  }

  /// All rows hold some.
  void add_all_sources() { everywhere_ = true; }

  void solve(int passes) {
    std::vector<float> other = magnitudes_;
    for (int pass = 1; pass <= passes; ++pass) {
      relax(other, pass);
      magnitudes_.swap(other);
    }
  }

 private:
  struct Rows {
    int first = std::numeric_limits<int>::max() / 2;
    int last = std::numeric_limits<int>::min() / 2;
  };

  /// Rows of a plane that lie within so many steps of a source.
  Rows reached(int x, int steps) const {
    Rows rows;
    for (int i = std::max(0, x - steps); i <= std::min(size_.x - 1, x + steps); ++i) {
      const Rows& source = sources_[static_cast<size_t>(i)];
      const int left = steps - (i < x ? x - i : i - x);
      rows = {std::min(rows.first, source.first - left), std::max(rows.last, source.last + left)};
    }
    return {std::max(1, rows.first), std::min(size_.y - 2, rows.last)};
  }

  void relax(std::vector<float>& to, int steps) const {
    if (everywhere_) {  // rows of the outermost layer between planes are fixed, and stay
      const ptrdiff_t first = step_x_ + step_y_;
      relax_from(first, static_cast<ptrdiff_t>(to.size()) - 2 * first, to);
      return;
    }
    for (int x = 1; x + 1 < size_.x; ++x) {
      const Rows rows = reached(x, steps);
      if (rows.first > rows.last) continue;
      CHECK_DEBUG(rows.first >= 1 && rows.last + 1 < size_.y);
      relax_from(x * step_x_ + rows.first * step_y_, (rows.last - rows.first + 1) * step_y_, to);
    }
  }

  void relax_from(ptrdiff_t first, ptrdiff_t count, std::vector<float>& to) const {
    const float* const u = magnitudes_.data() + first;
    relax_rows(count, {u - 1, u + 1, u - step_y_, u + step_y_, u - step_x_, u + step_x_}, u,
               floors_.data() + first, to.data() + first);
  }

  VoxelCoord size_;
  ptrdiff_t step_y_;
  ptrdiff_t step_x_;
  std::vector<float> magnitudes_;
  std::vector<float> floors_;
  std::vector<Rows> sources_;
  bool everywhere_ = false;
};

/// Distance to the zero set from the voxel at `index`, by the crossings along the axes: the start of fast
/// marching (Sethian 1996).
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
    const auto measure = [&](float there) {
      if ((there < 0.0F) != (here < 0.0F)) nearest = std::min(nearest, here / (here - there));
    };
    if (at[axis] > 0) measure(levels[index - steps[axis]]);
    if (at[axis] + 1 < end[axis]) measure(levels[index + steps[axis]]);
    if (nearest < far_voxels) sum += 1.0F / std::max(nearest * nearest, 1e-12F);
  }
  return sum > 0.0F ? std::min(1.0F, 1.0F / std::sqrt(sum)) : far_voxels;
}

/// The sides on which a row's voxels are.
enum class RowSides : uint8_t { rock, air, both };

SCREE_VECTOR_CLONES
size_t count_rock(size_t count, const float* __restrict levels) {
  size_t rock = 0;
  for (size_t i = 0; i < count; ++i) rock += levels[i] < 0.0F ? 1 : 0;
  return rock;
}

RowSides sides_of(size_t count, const float* levels) {
  const size_t rock = count_rock(count, levels);
  if (rock == 0) return RowSides::air;
  return rock == count ? RowSides::rock : RowSides::both;
}

/// Whether some voxel of the row has a neighbour within the window on the other side. `rows`: by x, then y.
bool row_crosses(const std::vector<RowSides>& rows, const VoxelCoord& size, int x, int y) {
  const auto row = static_cast<size_t>(x) * static_cast<size_t>(size.y) + static_cast<size_t>(y);
  const RowSides own = rows[row];
  const auto differs = [&](bool exists, ptrdiff_t step) {
    return exists && rows[row + static_cast<size_t>(step)] != own;
  };
  return own == RowSides::both || differs(x > 0, -size.y) || differs(x + 1 < size.x, size.y) ||
         differs(y > 0, -1) || differs(y + 1 < size.y, 1);
}

/// The start of redistancing: voxels next to a zero crossing keep their magnitudes, others have none yet.
SCREE_VECTOR_CLONES
void pin_crossings(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
                   float* __restrict magnitudes, float* __restrict floors) {
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = c[i];
    const auto signs =
        static_cast<int8_t>((own ^ c[i - 1]) | (own ^ c[i + 1]) | (own ^ c[i - step_y]) |
                            (own ^ c[i + step_y]) | (own ^ c[i - step_x]) | (own ^ c[i + step_x]));
    const float magnitude = std::abs(decode(own));
    magnitudes[i] = signs < 0 ? magnitude : far_voxels;
    floors[i] = signs < 0 ? magnitude : 0.0F;
  }
}

/// Codes of the magnitudes, on the sides where they were.
SCREE_VECTOR_CLONES
void encode_magnitudes(size_t count, const float* __restrict magnitudes, Code* __restrict codes) {
  for (size_t i = 0; i < count; ++i) {
    CHECK_DEBUG(magnitudes[i] >= 0.0F);
    const float clamped = std::min(magnitudes[i], band_voxels);
    const auto code = static_cast<int8_t>(static_cast<int>(clamped * codes_per_voxel + 0.5F));
    codes[i] = codes[i] < 0 ? static_cast<Code>(-code) : code;
  }
}

/// Codes of the magnitudes, on the sides of the levels: as encode() of each.
SCREE_VECTOR_CLONES
void encode_levels(size_t count, const float* __restrict levels, const float* __restrict magnitudes,
                   Code* __restrict codes) {
  for (size_t i = 0; i < count; ++i) {
    const float clamped = std::min(magnitudes[i] * codes_per_voxel, 127.0F);
    const auto code = static_cast<int8_t>(static_cast<int>(clamped + 0.5F));
    codes[i] = levels[i] < 0.0F ? static_cast<Code>(-code) : code;
  }
}

/// The outermost layer keeps its magnitudes.
void pin_rim(const VoxelCoord& size, const std::vector<Code>& codes, float* magnitudes, float* floors) {
  const auto nz = static_cast<size_t>(size.z), plane = static_cast<size_t>(size.y) * nz;
  const auto pin = [&](size_t first, size_t count) {
    for (size_t i = first; i < first + count; ++i) floors[i] = magnitudes[i] = std::abs(decode(codes[i]));
  };
  pin(0, plane + nz + 1);
  for (size_t x = plane; x + plane < codes.size(); x += plane) {
    for (size_t row = x + nz; row + 2 * nz < x + plane; row += nz) pin(row + nz - 1, 2);
    pin(x + plane - nz - 1, 2 * nz + 2);
  }
  pin(codes.size() - plane, plane);
}

/// Marks the rows with voxels that others measure from, and all rows of a small window.
void find_sources(const VoxelCoord& size, Solver& solver) {
  constexpr int rows_few = 1024;  // too few for skipping any to pay
  if (size.x * size.y <= rows_few) return solver.add_all_sources();
  const float* row = solver.magnitudes();
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y, row += size.z)
      if (*std::min_element(row, row + size.z) < band_voxels) solver.add_source(x, y);
}

}  // namespace

void redistance(Window& window) {
  const VoxelCoord size = window.box.size();
  CHECK(std::min({size.x, size.y, size.z}) >= 3);
  CHECK_EQ(window.codes.size(), Window::count(window.box));
  Solver solver(size);
  const size_t count = window.codes.size();
  const ptrdiff_t step_y = size.z, step_x = step_y * size.y, first = step_x + step_y + 1;
  pin_crossings(static_cast<ptrdiff_t>(count) - 2 * first, step_x, step_y, window.codes.data() + first,
                solver.magnitudes() + first, solver.floors() + first);
  pin_rim(size, window.codes, solver.magnitudes(), solver.floors());
  find_sources(size, solver);
  solver.solve(passes_of_codes);
  encode_magnitudes(count, solver.magnitudes(), window.codes.data());
}

void distances_from_levels(const std::vector<float>& levels, Window& window) {
  const VoxelCoord size = window.box.size();
  CHECK_EQ(levels.size(), window.codes.size());
  // A layer around the window that nothing is measured from.
  const VoxelCoord padded = size + VoxelCoord{2, 2, 2};
  Solver solver(padded);
  std::fill_n(solver.floors(), Window::count({{}, padded}), far_voxels);
  const auto for_each_row = [&](auto&& f) {
    size_t i = 0;
    for (int x = 0; x < size.x; ++x)
      for (int y = 0; y < size.y; ++y, i += static_cast<size_t>(size.z))
        f(x, y, i,
          (static_cast<size_t>(x + 1) * static_cast<size_t>(padded.y) + static_cast<size_t>(y + 1)) *
                  static_cast<size_t>(padded.z) +
              1);
  };
  std::vector<RowSides> rows;
  rows.reserve(static_cast<size_t>(size.x) * static_cast<size_t>(size.y));
  for_each_row([&](int, int, size_t i, size_t) {
    rows.push_back(sides_of(static_cast<size_t>(size.z), levels.data() + i));
  });
  for_each_row([&](int x, int y, size_t i, size_t p) {
    std::fill_n(solver.floors() + p, size.z, 0.0F);
    if (!row_crosses(rows, size, x, y)) return;
    solver.add_source(x + 1, y + 1);
    for (int z = 0; z < size.z; ++z, ++i, ++p) {
      const float d = crossing_distance(levels, size, x, y, z, i);
      if (d < far_voxels) solver.floors()[p] = solver.magnitudes()[p] = d;
    }
  });
  solver.solve(passes_of_levels);
  for_each_row([&](int, int, size_t i, size_t p) {
    encode_levels(static_cast<size_t>(size.z), levels.data() + i, solver.magnitudes() + p,
                  window.codes.data() + i);
  });
}

}  // namespace scree
