#include "shared/surface/facet.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"

namespace scree {
namespace {

/// Padded to whole vectors.
constexpr size_t around = 32;
constexpr size_t middle = 13;
/// The rise of points past the 27, and of saturated ones: no plane agrees with it.
constexpr int32_t no_rise = 1 << 20;
/// A little more than the largest error by the rounding of two codes; codes.
constexpr float agreement = 1.7F;
/// A face rises by a voxel in a voxel; a steeper or flatter gradient lies between faces.
constexpr float slope_tolerance = 0.1F;

struct Offsets {
  std::array<int32_t, around> x{}, y{}, z{};
};

constexpr Offsets make_offsets() {
  Offsets offsets;
  for (int i = 0; i < 27; ++i) {
    const auto at = static_cast<size_t>(i);
    offsets.x[at] = i / 9 - 1;
    offsets.y[at] = i / 3 % 3 - 1;
    offsets.z[at] = i % 3 - 1;
  }
  return offsets;
}
constexpr Offsets offsets = make_offsets();

/// How many codes the points around lie higher, by index (x + 1) · 9 + (y + 1) · 3 + z + 1.
using Rises = std::array<int32_t, around>;

bool is_saturated(Code code) {
  return code == code_air || code == code_solid;
}

void read(const Window& window, VoxelCoord p, Rises& rises) {
  rises.fill(no_rise);
  const int32_t here = window.at(p.x, p.y, p.z);
  const auto stride = static_cast<size_t>(window.box.hi.z - window.box.lo.z);
  size_t at = 0;
  for (int x = -1; x <= 1; ++x) {
    const Code* plane = &window.codes[window.index(p.x + x, p.y - 1, p.z - 1)];
    for (size_t i = 0; i < 9; ++i, ++at) {
      const Code code = plane[i / 3 * stride + i % 3];
      if (!is_saturated(code)) rises[at] = code - here;
    }
  }
}

/// Sums over the points that agree with a gradient, in codes: of the squared offsets, and of these by rises.
struct Sums {
  int32_t count = 0;
  int32_t xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  int32_t x = 0, y = 0, z = 0;
};

SCREE_VECTOR_CLONES int32_t count_agreeing(const Rises& rises, const glm::vec3& g) {
  int32_t count = -1;  // the middle
  for (size_t i = 0; i < around; ++i) {
    const float plane = g.x * static_cast<float>(offsets.x[i]) + g.y * static_cast<float>(offsets.y[i]) +
                        g.z * static_cast<float>(offsets.z[i]);
    const float off = static_cast<float>(rises[i]) - plane;
    count += static_cast<int32_t>((off <= agreement) & (off >= -agreement));
  }
  return count;
}

SCREE_VECTOR_CLONES void sum_agreeing(const Rises& rises, const glm::vec3& g, Sums& sums) {
  Sums s;
  for (size_t i = 0; i < around; ++i) {
    const int32_t x = offsets.x[i], y = offsets.y[i], z = offsets.z[i];
    const float plane =
        g.x * static_cast<float>(x) + g.y * static_cast<float>(y) + g.z * static_cast<float>(z);
    const float off = static_cast<float>(rises[i]) - plane;
    const auto one = static_cast<int32_t>((off <= agreement) & (off >= -agreement));
    s.count += one;
    s.xx += one * x * x;
    s.yy += one * y * y;
    s.zz += one * z * z;
    s.xy += one * x * y;
    s.xz += one * x * z;
    s.yz += one * y * z;
    const int32_t rise = one * rises[i];
    s.x += x * rise;
    s.y += y * rise;
    s.z += z * rise;
  }
  sums = s;
}

/// The gradient that fits the points best that agree with this one.
glm::vec3 fitted(const Rises& rises, glm::vec3 gradient) {
  Sums s;
  sum_agreeing(rises, gradient, s);
  const glm::mat3 a(s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz);
  return glm::determinant(a) > 1.0F ? glm::inverse(a) * glm::vec3(s.x, s.y, s.z) : gradient;
}

float length_of(glm::vec3 v) {
  return std::sqrt(glm::dot(v, v));
}

bool is_face(glm::vec3 gradient) {
  return std::abs(length_of(gradient) - codes_per_voxel) <= slope_tolerance * codes_per_voxel;
}

/// The differences to the two sides along an axis; one where they agree. Differences from saturated points
/// belong to no face.
struct Sides {
  std::array<float, 2> rise;
  size_t count;

  Sides(const Rises& rises, size_t stride)
      : rise{static_cast<float>(-rises[middle - stride]), static_cast<float>(rises[middle + stride])},
        count(std::abs(rise[1] - rise[0]) <= agreement ? 1 : 2) {
    if (count == 1) rise[0] = 0.5F * (rise[0] + rise[1]);
  }
};

}  // namespace

Facet facet_at(const Window& window, VoxelCoord point) {
  CHECK_DEBUG(window.box.covers(VoxelBox{point, point + VoxelCoord{1, 1, 1}}.grown(1)));
  const Code here = window.at(point.x, point.y, point.z);
  if (is_saturated(here)) return {};
  Rises rises;
  read(window, point, rises);
  const Sides x(rises, 9), y(rises, 3), z(rises, 1);
  int best = 0;
  glm::vec3 gradient(0.0F);
  for (size_t i = 0; i < x.count; ++i)
    for (size_t j = 0; j < y.count; ++j)
      for (size_t k = 0; k < z.count; ++k) {
        const glm::vec3 g(x.rise[i], y.rise[j], z.rise[k]);
        if (!is_face(g)) continue;
        const int supporters = count_agreeing(rises, g);
        if (supporters <= best) continue;
        best = supporters;
        gradient = g;
      }
  if (best == 0) return {};
  // Twice: the first fit removes the rounding of the differences, and more points agree.
  gradient = fitted(rises, fitted(rises, gradient));
  const int supporters = count_agreeing(rises, gradient);
  if (supporters <= 0 || !is_face(gradient)) return {};
  return {gradient / length_of(gradient), -decode(here), supporters};
}

}  // namespace scree
