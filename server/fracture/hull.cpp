#include "server/fracture/hull.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

/// Corners are added until the hull is this near to the shape along every line of comparison, voxels.
constexpr float hull_error_voxels = 0.12F;

/// Least thickness of a hull, voxels: Bullet treats thinner ones as planes.
constexpr float thickness_min_voxels = 0.3F;

/// Bit k: whether codes[k] is inside or on the surface; `count` is at most 64.
uint64_t inside_bits(const Code* codes, int count) {
  CHECK_DEBUG(count >= 0 && count <= 64);
  constexpr uint64_t signs = 0x8080808080808080U, rest = ~signs;
  uint64_t bits = 0;
  for (int from = 0; from < count; from += 8) {
    uint64_t eight = rest;  // codes past the end are outside
    std::memcpy(&eight, codes + from, static_cast<size_t>(std::min(8, count - from)));
    const uint64_t outside = ((eight & rest) + rest) & ~eight & signs;
    const uint64_t inside = (outside ^ signs) >> 7;
    bits |= ((inside * 0x0102040810204080U) >> 56) << from;
  }
  return bits;
}

/// Appends the points where the volume's surface crosses edges of the voxel lattice. Whole rows are compared
/// at once: few voxels are near the surface.
class SurfacePoints {
 public:
  SurfacePoints(const Window& window, std::vector<glm::vec3>& points) : points_(points) {
    const VoxelBox& b = window.box;
    const VoxelCoord size = b.size();
    const auto nz = static_cast<size_t>(size.z), nyz = static_cast<size_t>(size.y) * nz;
    const size_t words = (nz + 63) / 64;  // of a row
    const std::vector<uint64_t> inside = insides_of(window, words);
    const uint64_t* word = inside.data();
    for (int x = b.lo.x; x < b.hi.x; ++x)
      for (int y = b.lo.y; y < b.hi.y; ++y)
        for (int z = b.lo.z; z < b.hi.z; z += 64, ++word) {
          const Code* row = window.codes.data() + window.index(x, y, z);
          const glm::vec3 at(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
          if (x + 1 < b.hi.x)
            cross(row, nyz, *word ^ word[static_cast<size_t>(size.y) * words], at, {1.0F, 0.0F, 0.0F});
          if (y + 1 < b.hi.y) cross(row, nz, *word ^ word[words], at, {0.0F, 1.0F, 0.0F});
          const int next = std::min(64, b.hi.z - z - 1);
          const uint64_t known = next == 64 ? ~uint64_t{0} : (uint64_t{1} << next) - 1;
          const uint64_t beyond = next == 64 ? word[1] << 63 : 0;
          cross(row, 1, (*word ^ (*word >> 1 | beyond)) & known, at, {0.0F, 0.0F, 1.0F});
        }
  }

 private:
  /// inside_bits() of every row, in as many words each.
  static std::vector<uint64_t> insides_of(const Window& window, size_t words) {
    const auto nz = static_cast<size_t>(window.box.size().z);
    std::vector<uint64_t> inside;
    inside.reserve(window.codes.size() / nz * words);
    for (size_t row = 0; row < window.codes.size(); row += nz)
      for (size_t z = 0; z < nz; z += 64)
        inside.push_back(
            inside_bits(window.codes.data() + row + z, static_cast<int>(std::min<size_t>(64, nz - z))));
    return inside;
  }

  void cross(const Code* row, size_t step, uint64_t edges, glm::vec3 first, glm::vec3 along) {
    for (; edges != 0; edges &= edges - 1) {
      const int k = std::countr_zero(edges);
      const int a = row[k], c = row[static_cast<size_t>(k) + step];
      CHECK_DEBUG((a <= 0) != (c <= 0));
      points_.push_back(first + glm::vec3(0.0F, 0.0F, static_cast<float>(k)) +
                        along * (static_cast<float>(a) / static_cast<float>(a - c)));
    }
  }

  std::vector<glm::vec3>& points_;
};

std::vector<glm::vec3> surface_of(const Window& window) {
  std::vector<glm::vec3> points;
  SurfacePoints(window, points);
  return points;
}

/// Eight floats at a time, written as vectors: the compiler does not vectorise these loops by itself.
using Lanes = float __attribute__((vector_size(32)));
using IntLanes = int __attribute__((vector_size(32)));
constexpr size_t lanes = 8;

/// Lines of comparison between a hull and its shape: to the faces, edges and corners of a cube, and half-way
/// between those. Eight to a vector, with an array for each coordinate; unused lanes of the last are zero.
struct Lines {
  static constexpr size_t count = (6 + 12 + 8 + 24) / 2;
  static constexpr size_t vectors = (count + lanes - 1) / lanes;
  std::array<Lanes, vectors> x, y, z;
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
        found.x[count / lanes][count % lanes] = static_cast<float>(x) / length;
        found.y[count / lanes][count % lanes] = static_cast<float>(y) / length;
        found.z[count / lanes][count % lanes] = static_cast<float>(z) / length;
        ++count;
      }
  CHECK(count == Lines::count);
  return found;
}

const Lines& lines() {
  static const Lines all = make_lines();
  return all;
}

/// The least and greatest coordinate of some points along each line, and the points that have them.
struct Extent {
  std::array<Lanes, Lines::vectors> lows, highs;
  std::array<IntLanes, Lines::vectors> lowest_points{}, highest_points{};

  Extent() {
    lows.fill(Lanes{} + 1e30F);
    highs.fill(Lanes{} - 1e30F);
  }
  float low(size_t line) const { return lows[line / lanes][line % lanes]; }
  float high(size_t line) const { return highs[line / lanes][line % lanes]; }
  int lowest(size_t line) const { return lowest_points[line / lanes][line % lanes]; }
  int highest(size_t line) const { return highest_points[line / lanes][line % lanes]; }
  /// Whether the points are thick enough to collide along every line.
  bool is_solid() const {
    for (size_t i = 0; i < Lines::count; ++i)
      if (high(i) - low(i) < thickness_min_voxels) return false;
    return true;
  }
};

}  // namespace

SCREE_VECTOR_CLONES static void extend(Extent& extent, std::span<const glm::vec3> points) {
  const Lines& along = lines();
  for (size_t i = 0; i < Lines::vectors; ++i) {
    const Lanes x = along.x[i], y = along.y[i], z = along.z[i];
    Lanes low = extent.lows[i], high = extent.highs[i];
    IntLanes lowest = extent.lowest_points[i], highest = extent.highest_points[i], number{};
    for (const glm::vec3& p : points) {
      const Lanes r = p.x * x + p.y * y + p.z * z;
      const IntLanes above = r > high, below = r < low;
      high = above ? r : high;
      highest = above ? number : highest;
      low = below ? r : low;
      lowest = below ? number : lowest;
      number += 1;
    }
    extent.lows[i] = low;
    extent.highs[i] = high;
    extent.lowest_points[i] = lowest;
    extent.highest_points[i] = highest;
  }
}

namespace {

/// A few of the candidates whose hull is nearly that of all: each time the point farthest outside is added.
/// Empty when their hull is too thin to collide.
std::vector<glm::vec3> choose_corners(const std::vector<glm::vec3>& candidates) {
  Extent wanted, have;
  extend(wanted, candidates);
  std::vector<glm::vec3> corners;
  if (!wanted.is_solid()) return corners;
  while (corners.size() < static_cast<size_t>(hull_corners_max)) {
    float missed = -1.0F;
    int next = 0;
    for (size_t i = 0; i < Lines::count; ++i) {
      const float above = wanted.high(i) - have.high(i), below = have.low(i) - wanted.low(i);
      if (above > missed) missed = above, next = wanted.highest(i);
      if (below > missed) missed = below, next = wanted.lowest(i);
    }
    if (corners.size() >= 4 && missed < hull_error_voxels) break;
    corners.push_back(candidates[static_cast<size_t>(next)]);
    extend(have, std::span(&corners.back(), 1));
  }
  if (corners.size() < 4 || !have.is_solid()) corners.clear();
  return corners;
}

/// The points if their hull is thick enough to collide; else none.
std::vector<glm::vec3> if_solid(std::vector<glm::vec3> points) {
  Extent extent;
  extend(extent, points);
  if (points.size() < 4 || !extent.is_solid()) points.clear();
  return points;
}

std::vector<glm::vec3> simplified(const std::vector<glm::vec3>& surface, Simplifier simplifier) {
  constexpr float least_spacing_voxels = 0.5F;
  switch (simplifier) {
    case Simplifier::none:
      return if_solid(surface.size() <= whole_points_max
                          ? surface
                          : spread(surface, least_spacing_voxels, whole_points_max));
    case Simplifier::merge:
      return if_solid(merge_near(surface, merged_points_max));
    case Simplifier::hull:
      break;
  }
  return choose_corners(surface);
}

/// The block surrounded by air: rock at its edge has a surface half a voxel beyond.
Window alone(const Window& window, const VoxelBox& block) {
  Window part(block.grown(1));
  std::ranges::fill(part.codes, code_air);
  for (int x = block.lo.x; x < block.hi.x; ++x)
    for (int y = block.lo.y; y < block.hi.y; ++y)
      for (int z = block.lo.z; z < block.hi.z; ++z) part.codes[part.index(x, y, z)] = window.at(x, y, z);
  return part;
}

/// Corners of a cube of that mass, voxels: the hull of a volume that is too thin to collide.
std::vector<glm::vec3> cube_of(MassUnits mass) {
  const float half = 0.5F * std::cbrt(static_cast<float>(mass) / units_per_voxel);
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 4) != 0 ? half : -half, (i & 2) != 0 ? half : -half,
                         (i & 1) != 0 ? half : -half);
  return corners;
}

/// Sums over one row of voxels along z: of their units, and of units times z and times z².
struct RowSums {
  int64_t units = 0;
  int64_t z = 0;
  int64_t zz = 0;
};

RowSums sums_of_row(const Code* codes, int count) {
  RowSums sums;
  for (int from = 0; from < count; from += 64) {  // 64: sums of that many fit an int
    int units = 0, first = 0, second = 0;
    const int to = std::min(count - from, 64);
    for (int k = 0; k < to; ++k) {
      const int u = occupancy(codes[from + k]);
      units += u;
      first += u * k;
      second += u * k * k;
    }
    sums.units += units;
    sums.z += first + int64_t{from} * units;
    sums.zz += second + 2 * int64_t{from} * first + int64_t{from} * from * units;
  }
  return sums;
}

/// Inertia tensor of 1 kg about the centre of mass, in voxels²; every voxel counts as a small cube.
glm::mat3 inertia_of(const Volume& volume) {
  const VoxelBox& b = volume.window.box;
  const glm::dvec3 centre(volume.centre_voxels);
  const int count = b.size().z;
  const double low_z = b.lo.z - centre.z;
  glm::dvec3 squares(0.0), products(0.0);  // of x, y, z; of yz, xz, xy
  double mass = 0.0;
  const Code* codes = volume.window.codes.data();
  for (int x = b.lo.x; x < b.hi.x; ++x)
    for (int y = b.lo.y; y < b.hi.y; ++y, codes += count) {
      const RowSums sums = sums_of_row(codes, count);
      if (sums.units == 0) continue;
      const auto units = static_cast<double>(sums.units);
      const double off_x = x - centre.x, off_y = y - centre.y;
      const double first_z = static_cast<double>(sums.z) + low_z * units;
      products += glm::dvec3(off_y * first_z, off_x * first_z, off_x * off_y * units);
      squares.x += off_x * off_x * units;
      squares.y += off_y * off_y * units;
      squares.z += static_cast<double>(sums.zz) + low_z * (2.0 * static_cast<double>(sums.z) + low_z * units);
      mass += units;
    }
  CHECK_DEBUG(codes == volume.window.codes.data() + volume.window.codes.size());
  if (mass > 0.0) {
    squares /= mass;
    products /= mass;
  }
  squares += glm::dvec3(1.0 / 12.0);
  const glm::dvec3 moments(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y);
  return glm::mat3(glm::dmat3(moments.x, -products.z, -products.y,  //
                              -products.z, moments.y, -products.x,  //
                              -products.y, -products.x, moments.z));
}

/// Whether corners, relative to the centre of mass, lie between the window's outermost voxels.
bool lie_in(const Volume& volume, const std::vector<glm::vec3>& corners_voxels) {
  constexpr float rounding = 0.01F;
  const VoxelBox& b = volume.window.box;
  const glm::vec3 lo = glm::vec3(b.lo.x, b.lo.y, b.lo.z) - volume.centre_voxels - rounding;
  const glm::vec3 hi = glm::vec3(b.hi.x - 1, b.hi.y - 1, b.hi.z - 1) - volume.centre_voxels + rounding;
  return std::ranges::all_of(corners_voxels, [&](glm::vec3 p) {
    return p.x >= lo.x && p.y >= lo.y && p.z >= lo.z && p.x <= hi.x && p.y <= hi.y && p.z <= hi.z;
  });
}

}  // namespace

std::vector<std::vector<glm::vec3>> convex_parts(const Volume& volume, float voxel_size_m, size_t count_max) {
  CHECK(count_max > 0);
  const VoxelBox& all = volume.window.box;
  const VoxelCoord size = all.size();
  int side = 4;
  const auto blocks = [&] {
    const auto along = [&](int length) { return static_cast<size_t>((length + side - 1) / side); };
    return along(size.x) * along(size.y) * along(size.z);
  };
  while (blocks() > count_max) ++side;
  std::vector<std::vector<glm::vec3>> parts;
  for (int x = all.lo.x; x < all.hi.x; x += side)
    for (int y = all.lo.y; y < all.hi.y; y += side)
      for (int z = all.lo.z; z < all.hi.z; z += side) {
        const VoxelBox block{
            {x, y, z},
            {std::min(x + side, all.hi.x), std::min(y + side, all.hi.y), std::min(z + side, all.hi.z)}};
        std::vector<glm::vec3> corners = surface_of(alone(volume.window, block));
        for (glm::vec3& p : corners) p -= volume.centre_voxels;
        corners = choose_corners(corners);
        for (glm::vec3& p : corners) p *= voxel_size_m;
        if (!corners.empty()) parts.push_back(std::move(corners));
      }
  CHECK(parts.size() <= count_max);
  return parts;
}

std::vector<PieceHull> make_hulls(const Applied& applied, const PieceTable& pieces, float voxel_size_m,
                                  Simplifier simplifier) {
  std::vector<PieceHull> hulls;
  for (const CreatedPiece& created : applied.created) {
    const auto found = pieces.find(created.id);
    CHECK(found != pieces.end());
    hulls.push_back(make_hull(created.id, *found->second, voxel_size_m, simplifier));
  }
  return hulls;
}

std::vector<glm::vec3> surface_samples(const Volume& volume, float voxel_size_m, size_t count_max) {
  constexpr float spacing_voxels = 2.0F;
  std::vector<glm::vec3> samples = spread(surface_of(volume.window), spacing_voxels, count_max);
  for (glm::vec3& p : samples) p = (p - volume.centre_voxels) * voxel_size_m;
  return samples;
}

PieceHull make_hull(PieceId id, const Volume& volume, float voxel_size_m, Simplifier simplifier) {
  CHECK(volume.mass > 0);
  std::vector<glm::vec3> candidates = surface_of(volume.window);
  for (glm::vec3& p : candidates) p -= volume.centre_voxels;
  PieceHull hull;
  hull.id = id;
  hull.corners_m = simplified(candidates, simplifier);
  CHECK_DEBUG(lie_in(volume, hull.corners_m));
  if (hull.corners_m.empty()) hull.corners_m = cube_of(volume.mass);
  for (glm::vec3& corner : hull.corners_m) corner *= voxel_size_m;
  hull.inertia_m2 = inertia_of(volume) * (voxel_size_m * voxel_size_m);
  hull.size_m3 =
      static_cast<float>(volume.mass) / units_per_voxel * voxel_size_m * voxel_size_m * voxel_size_m;
  CHECK(hull.corners_m.size() >= 4 && hull.size_m3 > 0.0F);
  CHECK(hull.inertia_m2[0][0] > 0.0F && hull.inertia_m2[1][1] > 0.0F && hull.inertia_m2[2][2] > 0.0F);
  return hull;
}

}  // namespace scree
