#include "server/fracture/hull_corners.h"

#include <array>
#include <cmath>
#include <limits>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"

namespace scree {

namespace {

/// Corners are added until the hull is this near to the shape along every line of comparison, voxels.
constexpr float hull_error_voxels = 0.12F;

/// Least thickness of a hull, voxels: Bullet treats thinner ones as planes.
constexpr float thickness_min_voxels = 0.3F;

/// Eight floats at a time, written as vectors: the compiler does not vectorise these loops by itself.
using LineFloats = float __attribute__((vector_size(32)));
using LineInts = int __attribute__((vector_size(32)));
constexpr size_t line_lanes = 8;

/// Lines of comparison between a hull and its shape: to the faces, edges and corners of a cube, and half-way
/// between those. Eight to a vector, with an array for each coordinate; unused lanes of the last are zero.
struct alignas(SCREE_CLONES_ALIGNMENT) Lines {
  static constexpr size_t count = (6 + 12 + 8 + 24) / 2;
  static constexpr size_t vectors = (count + line_lanes - 1) / line_lanes;
  std::array<LineFloats, vectors> x, y, z;
};

Lines make_lines() {
  Lines found{};
  size_t count = 0;
  for (int x = 0; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) {
        const int twos = (x * x == 4) + (y * y == 4) + (z * z == 4);
        const int zeros = (x == 0) + (y == 0) + (z == 0);
        const bool cube = twos == 0 && zeros < 3;
        const bool between = twos == 1 && zeros == 0;
        const bool mirrored = x == 0 && (y < 0 || (y == 0 && z < 0));
        if ((!cube && !between) || mirrored) continue;
        const float length = std::sqrt(static_cast<float>(x * x + y * y + z * z));
        found.x[count / line_lanes][count % line_lanes] = static_cast<float>(x) / length;
        found.y[count / line_lanes][count % line_lanes] = static_cast<float>(y) / length;
        found.z[count / line_lanes][count % line_lanes] = static_cast<float>(z) / length;
        ++count;
      }
  CHECK(count == Lines::count);
  return found;
}

const Lines& lines() {
  static const Lines all = make_lines();
  return all;
}

/// The least and greatest coordinate of some points along each line.
struct alignas(SCREE_CLONES_ALIGNMENT) Extent {
  std::array<LineFloats, Lines::vectors> lows, highs;

  Extent() {
    lows.fill(LineFloats{} + 1e30F);
    highs.fill(LineFloats{} - 1e30F);
  }
  /// Whether the points are thick enough to collide along every line.
  bool is_solid() const {
    for (size_t i = 0; i < Lines::count; ++i)
      if (highs[i / line_lanes][i % line_lanes] - lows[i / line_lanes][i % line_lanes] < thickness_min_voxels)
        return false;
    return true;
  }
};

/// The points that have the least and the greatest coordinates; the first of several.
struct alignas(SCREE_CLONES_ALIGNMENT) ExtremePoints {
  std::array<LineInts, Lines::vectors> lowest{}, highest{};
};

SCREE_VECTOR_CLONES void measure_points(const std::vector<glm::vec3>& points, Extent& extent,
                                        ExtremePoints& extremes) {
  const Lines& along = lines();
  for (size_t i = 0; i < Lines::vectors; ++i) {
    const LineFloats x = along.x[i], y = along.y[i], z = along.z[i];
    LineFloats low = extent.lows[i], high = extent.highs[i];
    LineInts lowest{}, highest{}, number{};
    for (const glm::vec3& p : points) {
      const LineFloats r = p.x * x + p.y * y + p.z * z;
      const LineInts above = r > high, below = r < low;
      high = above ? r : high;
      highest = above ? number : highest;
      low = below ? r : low;
      lowest = below ? number : lowest;
      number += 1;
    }
    extent.lows[i] = low;
    extent.highs[i] = high;
    extremes.lowest[i] = lowest;
    extremes.highest[i] = highest;
  }
}

SCREE_INLINE void extend(Extent& extent, glm::vec3 p) {
  const Lines& along = lines();
  for (size_t i = 0; i < Lines::vectors; ++i) {
    const LineFloats r = p.x * along.x[i] + p.y * along.y[i] + p.z * along.z[i];
    extent.highs[i] = r > extent.highs[i] ? r : extent.highs[i];
    extent.lows[i] = r < extent.lows[i] ? r : extent.lows[i];
  }
}

/// Where the hull misses most of the shape: the end of a line, 2 · line for its greatest coordinates, one
/// more for its least, and by how much. The first where several are equally far.
struct Miss {
  float most = -1.0F;
  int end = 0;
};

SCREE_INLINE void find_miss(const Extent& wanted, const Extent& have, Miss& miss) {
  std::array<LineFloats, Lines::vectors> above, below;
  LineFloats most = LineFloats{} - 1.0F;
  for (size_t i = 0; i < Lines::vectors; ++i) {
    above[i] = wanted.highs[i] - have.highs[i];
    below[i] = have.lows[i] - wanted.lows[i];
    most = above[i] > most ? above[i] : most;
    most = below[i] > most ? below[i] : most;
  }
  for (size_t lane = 0; lane < line_lanes; ++lane)
    miss.most = most[lane] > miss.most ? most[lane] : miss.most;
  LineInts ends = {0, 2, 4, 6, 8, 10, 12, 14};
  LineInts first = LineInts{} + std::numeric_limits<int>::max();
  for (size_t i = 0; i < Lines::vectors; ++i, ends += 2 * static_cast<int>(line_lanes)) {
    const LineInts of_high = above[i] == miss.most ? ends : LineInts{} + std::numeric_limits<int>::max();
    const LineInts of_low = below[i] == miss.most ? ends + 1 : LineInts{} + std::numeric_limits<int>::max();
    first = of_high < first ? of_high : first;
    first = of_low < first ? of_low : first;
  }
  miss.end = first[0];
  for (size_t lane = 1; lane < line_lanes; ++lane) miss.end = first[lane] < miss.end ? first[lane] : miss.end;
}

/// The numbers of the points that become corners, as many as the return value says.
SCREE_VECTOR_CLONES int choose(const std::vector<glm::vec3>& candidates, const Extent& wanted,
                               const ExtremePoints& extremes, Extent& have,
                               std::array<int, hull_corners_max>& chosen) {
  int count = 0;
  while (count < hull_corners_max) {
    Miss miss;
    find_miss(wanted, have, miss);
    if (count >= 4 && miss.most < hull_error_voxels) break;
    const auto line = static_cast<size_t>(miss.end / 2);
    const auto& points = miss.end % 2 == 0 ? extremes.highest : extremes.lowest;
    const int next = points[line / line_lanes][line % line_lanes];
    chosen[static_cast<size_t>(count++)] = next;
    extend(have, candidates[static_cast<size_t>(next)]);
  }
  return count;
}

}  // namespace

std::vector<glm::vec3> choose_corners(const std::vector<glm::vec3>& candidates) {
  Extent wanted, have;
  ExtremePoints extremes;
  measure_points(candidates, wanted, extremes);
  if (!wanted.is_solid()) return {};
  std::array<int, hull_corners_max> chosen;
  const int count = choose(candidates, wanted, extremes, have, chosen);
  if (count < 4 || !have.is_solid()) return {};
  std::vector<glm::vec3> corners;
  corners.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i)
    corners.push_back(candidates[static_cast<size_t>(chosen[static_cast<size_t>(i)])]);
  return corners;
}

std::vector<glm::vec3> if_thick(std::vector<glm::vec3> points) {
  Extent extent;
  ExtremePoints extremes;
  if (points.size() >= 4) measure_points(points, extent, extremes);
  if (points.size() < 4 || !extent.is_solid()) points.clear();
  return points;
}

}  // namespace scree
