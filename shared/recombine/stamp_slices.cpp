#include "shared/recombine/stamp_slices.h"

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "shared/base/check.h"
#include "shared/field/redistance.h"
#include "shared/recombine/merge_patch.h"
#include "shared/recombine/shift_search.h"
#include "shared/surface/surface_nets.h"

namespace scree {

namespace {

constexpr int steps_per_voxel = 256;

/// Codes between two pixels.
constexpr int code_gap = 42;

/// A vertex in 1/256 voxel from the box's first voxel.
struct GridPoint {
  int64_t x;
  int64_t y;
  int64_t z;
};

int32_t rounded(float value) {
  return static_cast<int32_t>(value + (value < 0.0F ? -0.5F : 0.5F));
}

std::vector<GridPoint> posed_vertices(const SurfaceMesh& mesh, const Volume& volume,
                                      const QuantisedPose& quantised, float voxel_size_m, VoxelCoord first) {
  const Pose pose = dequantise(quantised);
  const glm::mat3 to_world = glm::mat3_cast(pose.rotation);
  const glm::vec3 origin = glm::vec3(mesh.origin.x, mesh.origin.y, mesh.origin.z) - volume.centre_voxels;
  const glm::vec3 place = pose.position_m / voxel_size_m - glm::vec3(first.x, first.y, first.z);
  std::vector<GridPoint> points;
  points.reserve(mesh.vertices.size());
  for (const SurfaceVertex& vertex : mesh.vertices) {
    const glm::vec3 local =
        glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]) / surface_steps_per_voxel +
        origin;
    const glm::vec3 p = (to_world * local + place) * static_cast<float>(steps_per_voxel);
    points.push_back({rounded(p.x), rounded(p.y), rounded(p.z)});
  }
  return points;
}

/// Twice the area of the triangle a, b, (x, y), seen along z; positive when it turns left.
int64_t turn(const GridPoint& a, const GridPoint& b, int64_t x, int64_t y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// Whether (x, y) lies to the left of a → b. On the line it counts as shifted by an infinitesimal step along
/// y and a smaller one against x, so that two triangles never both claim their common edge, nor neither.
bool is_left(const GridPoint& a, const GridPoint& b, int64_t turned) {
  if (turned != 0) return turned > 0;
  return b.x != a.x ? b.x > a.x : b.y > a.y;
}

int64_t ceil_div(int64_t number, int64_t by) {
  return number > 0 ? (number + by - 1) / by : -(-number / by);
}

using Triangle = std::array<GridPoint, 3>;

/// Where the column of voxels through (x, y) enters or leaves the piece by this triangle: the first voxel
/// beyond; nothing where the triangle does not cover the column.
std::optional<int64_t> crossing(const Triangle& t, int64_t area, int64_t x, int64_t y) {
  const int64_t ab = turn(t[0], t[1], x, y), bc = turn(t[1], t[2], x, y), ca = turn(t[2], t[0], x, y);
  const bool left = area > 0;
  if (is_left(t[0], t[1], ab) != left || is_left(t[1], t[2], bc) != left || is_left(t[2], t[0], ca) != left)
    return std::nullopt;
  const int64_t height = bc * t[0].z + ca * t[1].z + ab * t[2].z;
  return left ? ceil_div(height, area * steps_per_voxel) : ceil_div(-height, -area * steps_per_voxel);
}

/// Marks the voxel after each crossing of a triangle with a column.
void cross_columns(const Triangle& t, const VoxelCoord& size, std::vector<uint8_t>& crossings) {
  const int64_t area = turn(t[0], t[1], t[2].x, t[2].y);
  if (area == 0) return;
  const auto first = [](int64_t low) { return std::max<int64_t>(ceil_div(low, steps_per_voxel), 0); };
  const auto [x_low, x_high] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [y_low, y_high] = std::minmax({t[0].y, t[1].y, t[2].y});
  for (int64_t x = first(x_low); x < size.x && x * steps_per_voxel <= x_high; ++x)
    for (int64_t y = first(y_low); y < size.y && y * steps_per_voxel <= y_high; ++y) {
      const auto z = crossing(t, area, x * steps_per_voxel, y * steps_per_voxel);
      if (!z || *z >= size.z) continue;
      crossings[static_cast<size_t>((x * size.y + y) * size.z + std::max<int64_t>(*z, 0))] ^= 1U;
    }
}

/// A voxel of rock in the slices, or one of air beside it, and the shift at which it rounds.
struct Drawn {
  uint32_t at;
  uint32_t rounding;
  bool rock;
};

constexpr uint32_t shifts = 2 * stamp_shift_max;

/// `slices` are those of the window's box, and reach its border nowhere.
std::vector<Drawn> drawn_voxels(const std::vector<uint8_t>& slices, const VoxelBox& box) {
  const auto step_y = static_cast<ptrdiff_t>(box.size().z);
  const ptrdiff_t step_x = step_y * box.size().y;
  const VoxelBox inner = box.grown(-1);
  std::vector<Drawn> drawn;
  for (int x = inner.lo.x; x < inner.hi.x; ++x)
    for (int y = inner.lo.y; y < inner.hi.y; ++y) {
      const auto row = (x - box.lo.x) * step_x + (y - box.lo.y) * step_y - box.lo.z;
      for (int z = inner.lo.z; z < inner.hi.z; ++z) {
        const uint8_t* s = slices.data() + row + z;
        const int beside = s[-1] | s[1] | s[-step_y] | s[step_y] | s[-step_x] | s[step_x];
        if ((s[0] | beside) == 0) continue;
        const auto rounding = static_cast<uint32_t>(mixed_bits(VoxelCoord{x, y, z}) % shifts);
        drawn.push_back({static_cast<uint32_t>(row + z), rounding, s[0] != 0});
      }
    }
  return drawn;
}

/// Unites the slices with the window.
void draw(Window& window, const std::vector<Drawn>& drawn, int shift) {
  CHECK(std::abs(shift) <= stamp_shift_max);
  const auto from_rock = static_cast<uint32_t>(stamp_shift_max + shift);
  for (const Drawn& voxel : drawn) {
    CHECK_DEBUG(voxel.at < window.codes.size() && voxel.rounding < shifts);
    const auto depth = static_cast<int>((code_gap * from_rock + voxel.rounding) / shifts);
    const int code = voxel.rock ? -std::max(depth, 1) : code_gap - depth;
    window.codes[voxel.at] = static_cast<Code>(std::min<int>(window.codes[voxel.at], code));
  }
}

}  // namespace

std::vector<uint8_t> draw_slices(const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                                 const VoxelBox& box) {
  const SurfaceMesh mesh = surface_nets_closed(volume.window);
  const std::vector<GridPoint> points = posed_vertices(mesh, volume, pose, voxel_size_m, box.lo);
  const VoxelCoord size = box.size();
  std::vector<uint8_t> slices(Window::count(box), 0);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    cross_columns({points[mesh.indices[i]], points[mesh.indices[i + 1]], points[mesh.indices[i + 2]]}, size,
                  slices);
  const auto columns = slices.size() / static_cast<size_t>(size.z);
  for (size_t column = 0; column < columns; ++column) {
    uint8_t* pixel = slices.data() + column * static_cast<size_t>(size.z);
    for (int z = 1; z < size.z; ++z) pixel[z] ^= pixel[z - 1];
  }
  return slices;
}

void stamp_slices(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                  int shift) {
  if (shift == -stamp_shift_max) return;
  draw(window, drawn_voxels(draw_slices(volume, pose, voxel_size_m, window.box), window.box), shift);
  redistance(window);
}

StampPlan plan_slices(const Window& window, const Volume& volume, const QuantisedPose& pose,
                      float voxel_size_m, MassUnits budget, const MergeFills& fills) {
  const auto voxels = drawn_voxels(draw_slices(volume, pose, voxel_size_m, window.box), window.box);
  const auto gain_of = [&](int shift) -> MassUnits {
    if (shift == -stamp_shift_max) return 0;
    Window drawn = window;
    draw(drawn, voxels, shift);
    return merge_gain(window, drawn, fills);
  };
  return search_shift(-stamp_shift_max, stamp_shift_max, budget, gain_of);
}

}  // namespace scree
