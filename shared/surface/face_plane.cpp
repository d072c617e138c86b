#include "shared/surface/face_plane.h"

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"

namespace scree {
namespace {

/// The 27 points around, padded to whole vectors.
constexpr size_t points = 32;
/// Points of the 26 around that lie on the plane: with fewer, rock is rounded there.
constexpr int supporters_least = 10;
/// Codes that a point may lie off the plane: a little more than two roundings.
constexpr int16_t off_most = 1;
/// A distance grows by a voxel in a voxel; steeper or flatter slopes mix faces.
constexpr float flattest = 0.88F * codes_per_voxel, steepest = 1.12F * codes_per_voxel;
/// Rises of points that say no distance: no plane agrees with them.
constexpr int16_t no_distance = 1 << 12;

struct PlaceTable {
  std::array<int16_t, points> x{}, y{}, z{};
};

constexpr PlaceTable make_place_table() {
  PlaceTable table;
  for (int i = 0; i < 27; ++i) {
    const auto at = static_cast<size_t>(i);
    table.x[at] = static_cast<int16_t>(i / 9 - 1);
    table.y[at] = static_cast<int16_t>(i / 3 % 3 - 1);
    table.z[at] = static_cast<int16_t>(i % 3 - 1);
  }
  return table;
}
constexpr PlaceTable place_table = make_place_table();

bool says_no_distance(Code code) {
  return (static_cast<int>(code == code_air) | static_cast<int>(code == code_solid)) != 0;
}

/// The codes' slope along an axis of that stride, from the side on which they bend less.
int slope_at(const Code* at, std::ptrdiff_t stride) {
  const int here = *at, below = at[-stride], above = at[stride];
  const int down = here - below, up = above - here;
  const int bend_down = down - (below - at[-2 * stride]), bend_up = (at[2 * stride] - above) - up;
  return std::abs(bend_down) <= std::abs(bend_up) ? down : up;
}

/// How many of the 26 points around lie on the plane with these slopes, in codes a voxel.
SCREE_VECTOR_CLONES int supporters_of(const std::array<int16_t, points>& rises, int16_t x, int16_t y,
                                      int16_t z) {
  int16_t count = 0;
  for (size_t i = 0; i < points; ++i) {
    const auto plane =
        static_cast<int16_t>(x * place_table.x[i] + y * place_table.y[i] + z * place_table.z[i]);
    const auto off = static_cast<int16_t>(rises[i] - plane);
    count = static_cast<int16_t>(
        count + (static_cast<int16_t>(off <= off_most) & static_cast<int16_t>(off >= -off_most)));
  }
  return count - 1;  // the point itself
}

}  // namespace

FacePlane face_plane_at(const Window& window, VoxelCoord point) {
  CHECK_DEBUG(window.box.covers(VoxelBox{point, point + VoxelCoord{1, 1, 1}}.grown(face_plane_reach)));
  const VoxelCoord size = window.box.size();
  const std::ptrdiff_t step_y = size.z, step_x = step_y * size.y;
  return face_plane_at(&window.codes[window.index(point.x, point.y, point.z)], step_x, step_y);
}

FacePlane face_plane_at(const Code* at, std::ptrdiff_t step_x, std::ptrdiff_t step_y) {
  FacePlane plane;
  plane.code = *at;
  if (says_no_distance(*at)) return plane;
  const int x = slope_at(at, step_x), y = slope_at(at, step_y), z = slope_at(at, 1);
  const auto squared = static_cast<float>(x * x + y * y + z * z);
  if (squared < flattest * flattest || squared > steepest * steepest) return plane;
  std::array<int16_t, points> rises;
  for (std::ptrdiff_t row = 0; row < 9; ++row) {
    const Code* from = at + (row / 3 - 1) * step_x + (row % 3 - 1) * step_y - 1;
    for (std::ptrdiff_t i = 0; i < 3; ++i)
      // Without a branch: all of them would be mispredicted.
      rises[static_cast<size_t>(row * 3 + i)] =
          static_cast<int16_t>(from[i] - *at + no_distance * static_cast<int>(says_no_distance(from[i])));
  }
  for (size_t i = 27; i < points; ++i) rises[i] = no_distance;
  const int supporters =
      supporters_of(rises, static_cast<int16_t>(x), static_cast<int16_t>(y), static_cast<int16_t>(z));
  if (supporters < supporters_least) return plane;
  const float scale = 127.0F / std::sqrt(squared);
  const auto whole = [scale](int v) {
    const float scaled = static_cast<float>(v) * scale;
    return static_cast<int8_t>(scaled + (scaled < 0.0F ? -0.5F : 0.5F));
  };
  plane.normal = {whole(x), whole(y), whole(z)};
  return plane;
}

}  // namespace scree
