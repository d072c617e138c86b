#include "server/fracture/hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "server/fracture/cells.h"
#include "shared/base/check.h"
#include "shared/field/window_sample.h"

namespace scree {

namespace {

/// Corners are added until the hull lies this near to the shape in every direction looked at, voxels.
constexpr float hull_error_voxels = 0.12F;

/// Thinnest that a hull may be, voxels: what Bullet still tells apart from a plane.
constexpr float thickness_min_voxels = 0.3F;

float distance_at(const Window& window, glm::vec3 p) {
  return covers(window, p) ? sample_covered(window, p).distance_voxels : band_voxels;
}

/// `corner` where it lies in the volume; else where the way to the centre first enters it. False if never.
bool pull_inside(const Window& window, glm::vec3 centre, glm::vec3& corner) {
  float outside = distance_at(window, corner);
  if (outside <= 0.0F) return true;
  const glm::vec3 way = centre - corner;
  const float length = std::sqrt(glm::dot(way, way));
  constexpr float step_voxels = 0.5F;
  const int steps = static_cast<int>(length / step_voxels) + 1;
  glm::vec3 last = corner;
  for (int i = 1; i <= steps; ++i) {
    const glm::vec3 p = corner + way * (static_cast<float>(i) / static_cast<float>(steps));
    const float inside = distance_at(window, p);
    if (inside <= 0.0F) {
      corner = last + (p - last) * (outside / (outside - inside));
      return true;
    }
    last = p;
    outside = inside;
  }
  return false;
}

/// Where the volume's surface crosses the edges of the voxel lattice.
void add_surface(const Window& window, std::vector<glm::vec3>& points) {
  const VoxelBox& b = window.box;
  const VoxelCoord size = b.size();
  const auto nz = static_cast<size_t>(size.z), nyz = static_cast<size_t>(size.y) * nz;
  const auto cross = [&](const Code* from, size_t step, glm::vec3 at, glm::vec3 along) {
    const int a = from[0], c = from[step];
    if ((a <= 0) == (c <= 0)) return;
    points.push_back(at + along * (static_cast<float>(a) / static_cast<float>(a - c)));
  };
  const Code* code = window.codes.data();
  for (int x = b.lo.x; x < b.hi.x; ++x)
    for (int y = b.lo.y; y < b.hi.y; ++y)
      for (int z = b.lo.z; z < b.hi.z; ++z, ++code) {
        const glm::vec3 at(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        if (x + 1 < b.hi.x) cross(code, nyz, at, {1.0F, 0.0F, 0.0F});
        if (y + 1 < b.hi.y) cross(code, nz, at, {0.0F, 1.0F, 0.0F});
        if (z + 1 < b.hi.z) cross(code, 1, at, {0.0F, 0.0F, 1.0F});
      }
}

/// Four at a time, spelt out: the compiler alone does not find these loops' vectors.
using Lanes = float __attribute__((vector_size(16)));
using IntLanes = int __attribute__((vector_size(16)));

/// Lines along which a hull is compared with its shape: to the faces, edges and corners of a cube, and
/// half-way between those. Four to a vector, coordinates apart; what is left over of the last vector is zero.
struct Lines {
  static constexpr size_t count = (6 + 12 + 8 + 24) / 2;
  static constexpr size_t vectors = (count + 3) / 4;
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
        found.x[count / 4][count % 4] = static_cast<float>(x) / length;
        found.y[count / 4][count % 4] = static_cast<float>(y) / length;
        found.z[count / 4][count % 4] = static_cast<float>(z) / length;
        ++count;
      }
  CHECK(count == Lines::count);
  return found;
}

const Lines& lines() {
  static const Lines all = make_lines();
  return all;
}

/// How far some points reach along each line, both ways, and which of them do.
class Extent {
 public:
  Extent() {
    low_.fill(Lanes{} + 1e30F);
    high_.fill(Lanes{} - 1e30F);
  }

  float low(size_t line) const { return low_[line / 4][line % 4]; }
  float high(size_t line) const { return high_[line / 4][line % 4]; }
  int lowest(size_t line) const { return lowest_[line / 4][line % 4]; }
  int highest(size_t line) const { return highest_[line / 4][line % 4]; }

  void add(glm::vec3 p, int number) {
    const Lines& along = lines();
    const IntLanes own = IntLanes{} + number;
    for (size_t i = 0; i < Lines::vectors; ++i) {
      const Lanes r = p.x * along.x[i] + p.y * along.y[i] + p.z * along.z[i];
      const IntLanes above = r > high_[i], below = r < low_[i];
      high_[i] = above ? r : high_[i];
      highest_[i] = above ? own : highest_[i];
      low_[i] = below ? r : low_[i];
      lowest_[i] = below ? own : lowest_[i];
    }
  }
  bool is_solid() const {
    for (size_t i = 0; i < Lines::count; ++i)
      if (high(i) - low(i) < thickness_min_voxels) return false;
    return true;
  }

 private:
  std::array<Lanes, Lines::vectors> low_, high_;
  std::array<IntLanes, Lines::vectors> lowest_{}, highest_{};
};

/// A few of the candidates, whose hull is nearly that of all: always the one that the hull misses most.
/// Empty when their hull is too thin to collide.
std::vector<glm::vec3> choose_corners(const std::vector<glm::vec3>& candidates) {
  Extent wanted, have;
  for (size_t i = 0; i < candidates.size(); ++i) wanted.add(candidates[i], static_cast<int>(i));
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
    have.add(corners.back(), 0);
  }
  if (corners.size() < 4 || !have.is_solid()) corners.clear();
  return corners;
}

/// A cube of that mass: what a volume that is all edge collides as. Half its side, voxels.
std::vector<glm::vec3> cube_of(MassUnits mass) {
  const float half = 0.5F * std::cbrt(static_cast<float>(mass) / units_per_voxel);
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 4) != 0 ? half : -half, (i & 2) != 0 ? half : -half,
                         (i & 1) != 0 ? half : -half);
  return corners;
}

/// Of 1 kg, about the centre of mass, in voxels²; every voxel counts as a small cube.
glm::vec3 inertia_of(const Volume& volume) {
  const VoxelBox& b = volume.window.box;
  glm::dvec3 squares(0.0);
  double mass = 0.0;
  const Code* code = volume.window.codes.data();
  for (int x = b.lo.x; x < b.hi.x; ++x)
    for (int y = b.lo.y; y < b.hi.y; ++y)
      for (int z = b.lo.z; z < b.hi.z; ++z, ++code) {
        const int units = occupancy(*code);
        if (units == 0) continue;
        const glm::dvec3 off = glm::dvec3(x, y, z) - glm::dvec3(volume.centre_voxels);
        squares += off * off * static_cast<double>(units);
        mass += units;
      }
  if (mass > 0.0) squares /= mass;
  squares += glm::dvec3(1.0 / 12.0);
  return {squares.y + squares.z, squares.x + squares.z, squares.x + squares.y};
}

PieceHull finish(PieceId id, const Volume& volume, std::vector<glm::vec3> candidates, float voxel_size_m) {
  for (glm::vec3& p : candidates) p -= volume.centre_voxels;
  PieceHull hull;
  hull.id = id;
  hull.corners_m = choose_corners(candidates);
  if (hull.corners_m.empty()) hull.corners_m = cube_of(volume.mass);
  for (glm::vec3& corner : hull.corners_m) corner *= voxel_size_m;
  hull.inertia_m2 = inertia_of(volume) * (voxel_size_m * voxel_size_m);
  hull.size_m3 =
      static_cast<float>(volume.mass) / units_per_voxel * voxel_size_m * voxel_size_m * voxel_size_m;
  return hull;
}

}  // namespace

std::vector<PieceHull> make_hulls(const Applied& applied, const PieceTable& pieces, float voxel_size_m) {
  std::vector<PieceHull> hulls;
  glm::vec3 lo(1e30F), hi(-1e30F);
  std::vector<const Volume*> volumes;
  for (const CreatedPiece& created : applied.created) {
    const auto found = pieces.find(created.id);
    CHECK(found != pieces.end());
    const VoxelBox& b = found->second->window.box;
    lo = glm::min(lo, glm::vec3(b.lo.x, b.lo.y, b.lo.z));
    hi = glm::max(hi, glm::vec3(b.hi.x, b.hi.y, b.hi.z));
    volumes.push_back(found->second.get());
  }
  const auto cells = cell_corners(applied.seeds_voxels, lo, hi);
  for (size_t i = 0; i < volumes.size(); ++i) {
    const Volume& volume = *volumes[i];
    std::vector<glm::vec3> candidates;
    for (const uint32_t seed : applied.created[i].seeds)
      for (glm::vec3 corner : cells[seed])
        if (pull_inside(volume.window, volume.centre_voxels, corner)) candidates.push_back(corner);
    add_surface(volume.window, candidates);
    hulls.push_back(finish(applied.created[i].id, volume, std::move(candidates), voxel_size_m));
  }
  return hulls;
}

std::vector<glm::vec3> surface_samples(const Volume& volume, float voxel_size_m, size_t count_max) {
  std::vector<glm::vec3> surface;
  add_surface(volume.window, surface);
  std::vector<glm::vec3> samples;
  for (float spacing_voxels = 2.0F;; spacing_voxels *= 1.25F) {
    std::set<std::tuple<int, int, int>> taken;
    samples.clear();
    for (const glm::vec3& p : surface) {
      const auto cube = [&](float x) { return floor_to_int(x / spacing_voxels); };
      if (!taken.emplace(cube(p.x), cube(p.y), cube(p.z)).second) continue;
      samples.push_back((p - volume.centre_voxels) * voxel_size_m);
      if (samples.size() > count_max) break;
    }
    if (samples.size() <= count_max) return samples;
  }
}

PieceHull make_hull(PieceId id, const Volume& volume, float voxel_size_m) {
  std::vector<glm::vec3> candidates;
  add_surface(volume.window, candidates);
  return finish(id, volume, std::move(candidates), voxel_size_m);
}

}  // namespace scree
