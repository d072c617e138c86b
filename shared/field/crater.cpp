#include "shared/field/crater.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/redistance.h"
#include "shared/field/voxel_vector.h"

namespace scree {

namespace {

/// Side of a block in radii of the ball, and its bounds in voxels.
constexpr float block_side_in_radii = 0.5F;
constexpr int block_side_min = 3;
constexpr int block_side_max = 32;

/// Depth in the ball, in sides of a block, from which on points are of blocks that are taken out: the ball
/// then cuts few blocks, whose faces there would be its own.
constexpr float depth_in_sides = 0.25F;

/// Points lie on multiples of 1/16 voxel, so that squares of distances between them and voxels have no
/// rounding: up to 1.125 · 32 · 16 a side of three.
constexpr float steps_per_voxel = 16.0F;

/// A point lies in the middle three quarters of its cube. So all points within 9/8 of a side from a voxel are
/// those of its cube and of the 26 around.
constexpr int cubes_around = 27;

/// Voxels along z at a time, in one vector.
constexpr int row_width = 8;
using RowLanes = float __attribute__((vector_size(32)));

int floor_div(int a, int b) {
  const int quotient = a / b;
  return quotient - (a % b < 0 ? 1 : 0);
}

struct BlockPoint {
  glm::vec3 place;  ///< from the first voxel of the crater's box, in steps
  bool taken;
};

/// The points of all cubes that touch a box, and of those around.
class BlockPoints {
 public:
  BlockPoints(const Shape& ball, const VoxelBox& box, int side)
      : side_(side),
        first_{floor_div(box.lo.x, side) - 1, floor_div(box.lo.y, side) - 1, floor_div(box.lo.z, side) - 1},
        count_{floor_div(box.hi.x - 1, side) + 2 - first_.x, floor_div(box.hi.y - 1, side) + 2 - first_.y,
               floor_div(box.hi.z - 1, side) + 2 - first_.z} {
    const glm::vec3 centre = (ball.a - as_vector(box.lo)) * steps_per_voxel;
    const float reach = (ball.radius_m - depth_in_sides * static_cast<float>(side)) * steps_per_voxel;
    size_t nearest = 0;
    float nearest2 = std::numeric_limits<float>::max();
    points_.reserve(static_cast<size_t>(count_.x) * static_cast<size_t>(count_.y) *
                    static_cast<size_t>(count_.z));
    for (int x = 0; x < count_.x; ++x)
      for (int y = 0; y < count_.y; ++y)
        for (int z = 0; z < count_.z; ++z) {
          const glm::vec3 place = place_in(first_ + VoxelCoord{x, y, z}, box.lo);
          const glm::vec3 off = place - centre;
          const float distance2 = glm::dot(off, off);
          if (distance2 < nearest2) nearest = points_.size();
          nearest2 = std::min(nearest2, distance2);
          points_.push_back({place, reach > 0.0F && distance2 <= reach * reach});
        }
    points_[nearest].taken = true;  // the smallest crater takes out what it can of one block
  }

  VoxelCoord count() const { return count_; }
  /// The voxels of a cube, which are not at the border.
  VoxelBox voxels_of(int x, int y, int z) const {
    const VoxelCoord cube = first_ + VoxelCoord{x, y, z};
    const VoxelCoord lo{cube.x * side_, cube.y * side_, cube.z * side_};
    return {lo, lo + VoxelCoord{side_, side_, side_}};
  }
  /// The points that may be nearest to a voxel of the cube: those taken first. Returns how many are.
  int around(int x, int y, int z, std::array<glm::vec3, cubes_around>& places) const {
    int taken = 0, left = cubes_around;
    for (int i = x - 1; i <= x + 1; ++i)
      for (int j = y - 1; j <= y + 1; ++j)
        for (int k = z - 1; k <= z + 1; ++k) {
          const BlockPoint& point = points_[static_cast<size_t>((i * count_.y + j) * count_.z + k)];
          places[static_cast<size_t>(point.taken ? taken++ : --left)] = point.place;
        }
    return taken;
  }

 private:
  glm::vec3 place_in(VoxelCoord cube, VoxelCoord origin) const {
    const uint64_t bits = mixed_bits(cube);
    const auto along = [&](int at, int from, unsigned low_bit) {
      const auto share = static_cast<int>((bits >> low_bit) & 1023U);
      return static_cast<float>((at * side_ - from) * 16 + side_ * 2 + ((share * side_ * 12) >> 10));
    };
    return {along(cube.x, origin.x, 0), along(cube.y, origin.y, 20), along(cube.z, origin.z, 40)};
  }

  int side_;
  VoxelCoord first_;
  VoxelCoord count_;
  std::vector<BlockPoint> points_;
};

/// Squares of the distances from a row of voxels to the nearest of these points, in steps; `most` where none
/// is nearer.
inline void find_nearest2(const glm::vec3* places, int count, glm::vec3 first, float most2,
                          RowLanes& nearest) {
  const RowLanes along = {0.0F, 16.0F, 32.0F, 48.0F, 64.0F, 80.0F, 96.0F, 112.0F};
  nearest = RowLanes{} + most2;
  for (int i = 0; i < count; ++i) {
    const float x = first.x - places[i].x, y = first.y - places[i].y;
    const RowLanes z = (first.z - places[i].z) + along;
    const RowLanes distance2 = (x * x + y * y) + z * z;
    nearest = distance2 < nearest ? distance2 : nearest;
  }
}

/// A row's levels: below zero where the nearest point is of a block that is taken, and linear from there to
/// the block on the other side, so that faces are flat; and in the ball. The larger counts.
inline void wall_row(const RowLanes& taken2, const RowLanes& left2, const RowLanes& ball2, float scale,
                     float radius, float* levels) {
  const RowLanes wall = (taken2 - left2) * scale;
  float walls[row_width], balls[row_width];
  std::memcpy(walls, &wall, sizeof(walls));
  std::memcpy(balls, &ball2, sizeof(balls));
  for (int k = 0; k < row_width; ++k) {
    const float round = std::sqrt(balls[k]) - radius;
    levels[k] = walls[k] > round ? walls[k] : round;
  }
}

/// The crater's levels in one cube, or the part of it within the window.
SCREE_VECTOR_CLONES
void write_cube(const Shape& ball, const glm::vec3* places, int taken, int side, const VoxelBox& cube,
                const Window& window, float* out) {
  const RowLanes along = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F};
  const float x0 = static_cast<float>(window.box.lo.x), y0 = static_cast<float>(window.box.lo.y),
              z0 = static_cast<float>(window.box.lo.z);
  const float most = 1.125F * static_cast<float>(side) * steps_per_voxel, most2 = most * most;
  // This scale holds for points a side apart, and roughly for others.
  const float scale = 0.5F / (static_cast<float>(side) * steps_per_voxel * steps_per_voxel);
  for (int x = cube.lo.x; x < cube.hi.x; ++x)
    for (int y = cube.lo.y; y < cube.hi.y; ++y)
      for (int z = cube.lo.z; z < cube.hi.z; z += row_width) {
        const float vx = static_cast<float>(x), vy = static_cast<float>(y), vz = static_cast<float>(z);
        const glm::vec3 first{(vx - x0) * steps_per_voxel, (vy - y0) * steps_per_voxel,
                              (vz - z0) * steps_per_voxel};
        const float bx = vx - ball.a.x, by = vy - ball.a.y;
        const RowLanes bz = (vz - ball.a.z) + along;
        RowLanes taken2, left2;
        find_nearest2(places, taken, first, most2, taken2);
        find_nearest2(places + taken, cubes_around - taken, first, most2, left2);
        float levels[row_width];
        wall_row(taken2, left2, (bx * bx + by * by) + bz * bz, scale, ball.radius_m, levels);
        std::copy_n(levels, std::min(row_width, cube.hi.z - z), out + window.index(x, y, z));
      }
}

/// Distance from the ball's surface to the nearest place of a box, voxels; negative if it reaches in.
float gap(const Shape& ball, const VoxelBox& box) {
  const auto beyond = [](float at, int lo, int hi) {
    const float below = static_cast<float>(lo) - at, above = at - static_cast<float>(hi - 1);
    return std::max(0.0F, std::max(below, above));
  };
  const glm::vec3 off{beyond(ball.a.x, box.lo.x, box.hi.x), beyond(ball.a.y, box.lo.y, box.hi.y),
                      beyond(ball.a.z, box.lo.z, box.hi.z)};
  return std::sqrt(glm::dot(off, off)) - ball.radius_m;
}

/// The crater's codes over its own box.
Window own_codes(const Shape& crater) {
  Window out(band_box(crater));
  const int side = crater_block_side(crater.radius_m);
  const BlockPoints points(crater, out.box, side);
  std::vector<float> levels(out.codes.size(), band_voxels);
  std::array<glm::vec3, cubes_around> places;
  const VoxelCoord count = points.count();
  for (int x = 1; x + 1 < count.x; ++x)
    for (int y = 1; y + 1 < count.y; ++y)
      for (int z = 1; z + 1 < count.z; ++z) {
        const VoxelBox cube = common(points.voxels_of(x, y, z), out.box);
        // Farther than a voxel from the ball nothing is beside the wall: redistancing makes its distance.
        if (gap(crater, cube) > 1.0F) continue;
        const int taken = points.around(x, y, z, places);
        write_cube(crater, places.data(), taken, side, cube, out, levels.data());
      }
  distances_from_levels(levels, out);
  return out;
}

}  // namespace

int crater_block_side(float radius_voxels) {
  CHECK(radius_voxels > 0.0F);
  const float side = std::min(radius_voxels * block_side_in_radii, static_cast<float>(block_side_max));
  return std::max(static_cast<int>(side + 0.5F), block_side_min);
}

Window crater_codes(const Shape& crater_voxels, const VoxelBox& box) {
  CHECK(crater_voxels.kind == ShapeKind::crater);
  Window own = own_codes(crater_voxels);
  if (own.box == box) return own;
  Window out(box);
  const VoxelBox both = common(own.box, box);
  if (!both.empty()) put(part_of(own, both), out);
  return out;
}

}  // namespace scree
