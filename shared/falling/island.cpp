#include "shared/falling/island.h"

#include <algorithm>
#include <array>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/redistance.h"

namespace scree {

namespace {

constexpr int band = 3;               ///< voxels that the narrow band reaches
constexpr int margin = 2 * band + 2;  ///< the island's band, the band around that, and room to redistance
constexpr Code code_at_cut = -21;     ///< half a voxel deep
constexpr Code code_beyond_cut = 21;  ///< half a voxel outside
using Marks = std::vector<uint8_t>;   ///< of a window's voxels, in its order

/// Steps from a voxel to its neighbours in a window's codes.
std::array<ptrdiff_t, 3> strides(const Window& window) {
  const VoxelCoord size = window.box.size();
  return {static_cast<ptrdiff_t>(size.y) * size.z, size.z, 1};
}

template <typename F>
void for_each_voxel(const VoxelBox& box, F&& f) {
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) f(x, y, z);
}

/// Marks the solid voxels that connect to the start by faces, within the box.
Marks component(const Window& window, const VoxelBox& box, VoxelCoord start) {
  Marks marks(window.codes.size(), 0);
  std::vector<VoxelCoord> ahead;
  const auto reach = [&](VoxelCoord v) {
    CHECK_DEBUG(box.holds(v));
    const size_t at = window.index(v.x, v.y, v.z);
    if (window.codes[at] >= 0 || marks[at] != 0) return;
    marks[at] = 1;
    ahead.push_back(v);
  };
  reach(start);
  while (!ahead.empty()) {
    const VoxelCoord v = ahead.back();
    ahead.pop_back();
    if (v.x > box.lo.x) reach({v.x - 1, v.y, v.z});
    if (v.y > box.lo.y) reach({v.x, v.y - 1, v.z});
    if (v.z > box.lo.z) reach({v.x, v.y, v.z - 1});
    if (v.x + 1 < box.hi.x) reach({v.x + 1, v.y, v.z});
    if (v.y + 1 < box.hi.y) reach({v.x, v.y + 1, v.z});
    if (v.z + 1 < box.hi.z) reach({v.x, v.y, v.z + 1});
  }
  return marks;
}

/// Marks what lies `step` beyond a mark, both ways, in a row of `count`.
SCREE_VECTOR_CLONES
void mark_beyond(ptrdiff_t count, ptrdiff_t step, const uint8_t* __restrict from, uint8_t* __restrict to) {
  for (ptrdiff_t i = 0; i + step < count; ++i) to[i + step] |= from[i];
  for (ptrdiff_t i = 0; i + step < count; ++i) to[i] |= from[i + step];
}

/// Spreads the marks by `by` voxels of that stride, both ways, within each of the rows of `count` bytes. Each
/// round spreads twice as far as the last one, and one more, as no gap may be left.
void spread(Marks& marks, ptrdiff_t stride, size_t count, int by) {
  CHECK_DEBUG(marks.size() % count == 0);
  for (int reached = 0; reached < by;) {
    const int next = std::min(by, 2 * reached + 1);
    const Marks from = marks;
    for (size_t row = 0; row < marks.size(); row += count)
      mark_beyond(static_cast<ptrdiff_t>(count), (next - reached) * stride, from.data() + row,
                  marks.data() + row);
    reached = next;
  }
}

/// Adds the voxels within `by` voxels of a marked one along every axis.
Marks grown(Marks marks, const Window& window, int by) {
  const auto [step_x, step_y, step_z] = strides(window);
  spread(marks, step_z, static_cast<size_t>(step_y), by);
  spread(marks, step_y, static_cast<size_t>(step_x), by);
  spread(marks, step_x, marks.size(), by);
  return marks;
}

/// Adds the voxels at the faces of marked ones.
Marks beside_of(const Window& window, const Marks& marks) {
  const VoxelCoord size = window.box.size();
  const auto [step_x, step_y, step_z] = strides(window);
  Marks beside(marks.size(), 0);
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y)
      for (int z = 0; z < size.z; ++z) {
        const ptrdiff_t at = x * step_x + y * step_y + z * step_z;
        if (marks[static_cast<size_t>(at)] == 0) continue;
        uint8_t* mark = beside.data() + at;
        *mark = 1;
        if (x > 0) mark[-step_x] = 1;
        if (x + 1 < size.x) mark[step_x] = 1;
        if (y > 0) mark[-step_y] = 1;
        if (y + 1 < size.y) mark[step_y] = 1;
        if (z > 0) mark[-step_z] = 1;
        if (z + 1 < size.z) mark[step_z] = 1;
      }
  return beside;
}

/// Marks the solid voxels that are not gone, and the voxels at their faces.
Marks near_rest(const Window& window, const Marks& gone) {
  Marks rest(gone.size());
  for (size_t i = 0; i < rest.size(); ++i) rest[i] = window.codes[i] < 0 && gone[i] == 0 ? 1 : 0;
  return beside_of(window, rest);
}

/// Bounds of the voxels that are solid, not gone, and marked in `within`.
VoxelBox rest_box(const Window& window, const Marks& gone, const Marks& within) {
  VoxelBox box{window.box.hi, window.box.lo};
  size_t at = 0;
  for_each_voxel(window.box, [&](int x, int y, int z) {
    const size_t i = at++;
    if (window.codes[i] >= 0 || gone[i] != 0 || within[i] == 0) return;
    box.lo = {std::min(box.lo.x, x), std::min(box.lo.y, y), std::min(box.lo.z, z)};
    box.hi = {std::max(box.hi.x, x + 1), std::max(box.hi.y, y + 1), std::max(box.hi.z, z + 1)};
  });
  return box;
}

/// Gives the remaining solid a face at the cut: halfway between its last voxels and the first that are gone.
/// Returns the solid voxels whose distances change: those within the band of the cut.
Marks bare_cut(Window& window, const Marks& gone, const Marks& near) {
  Marks cut(window.codes.size(), 0);
  bool any = false;
  for (size_t i = 0; i < cut.size(); ++i) {
    cut[i] = gone[i] != 0 && near[i] != 0 ? 1 : 0;
    any = any || cut[i] != 0;
  }
  if (!any) return {};
  const Marks beside = beside_of(window, cut);
  Marks bared = grown(std::move(cut), window, band);
  for (size_t i = 0; i < bared.size(); ++i) {
    if (gone[i] != 0 || window.codes[i] >= 0) bared[i] = 0;
    if (bared[i] != 0 && beside[i] != 0) window.codes[i] = std::max(window.codes[i], code_at_cut);
  }
  return bared;
}

/// Removes the marked solids, and gives their voxels and their band the distances to the remaining solid.
void strip(Window& window, const Marks& gone) {
  CHECK_EQ(gone.size(), window.codes.size());
  const Marks within = grown(gone, window, 2 * band);
  const VoxelBox rest = rest_box(window, gone, within);
  const Marks near = near_rest(window, gone);
  const Marks bared = bare_cut(window, gone, near);
  Marks touched = grown(gone, window, band);
  for (size_t i = 0; i < touched.size(); ++i) {
    if (gone[i] == 0 && (window.codes[i] < 0 || near[i] != 0)) touched[i] = 0;
    if (touched[i] != 0) window.codes[i] = gone[i] != 0 && near[i] != 0 ? code_beyond_cut : code_air;
  }
  if (rest.empty()) return;
  Window part = part_of(window, common(rest.grown(band + 2), window.box));
  redistance(part);
  size_t at = 0;
  for_each_voxel(part.box, [&](int x, int y, int z) {
    const size_t to = window.index(x, y, z);
    if (touched[to] != 0) window.codes[to] = part.codes[at];
    if (!bared.empty() && bared[to] != 0) window.codes[to] = std::max(window.codes[to], part.codes[at]);
    ++at;
  });
}

/// The field of the marked voxels alone, which lie in the box.
Window alone(const Window& window, const VoxelBox& box, const Marks& marks) {
  // Solids just outside the island's band have a band of their own, which reaches inside.
  Window own = part_of(window, box.grown(2 * band));
  Marks others(own.codes.size(), 0);
  size_t at = 0;
  for_each_voxel(own.box, [&](int x, int y, int z) {
    others[at] = own.codes[at] < 0 && marks[window.index(x, y, z)] == 0 ? 1 : 0;
    ++at;
  });
  strip(own, others);
  return part_of(own, box.grown(band));
}

glm::vec3 centre_of_mass(const Window& window) {
  int64_t sum = 0, sum_x = 0, sum_y = 0, sum_z = 0;
  size_t at = 0;
  const VoxelCoord origin = window.box.lo;
  for_each_voxel(window.box, [&](int x, int y, int z) {
    const int units = occupancy(window.codes[at++]);
    sum += units;
    sum_x += int64_t{units} * (x - origin.x);
    sum_y += int64_t{units} * (y - origin.y);
    sum_z += int64_t{units} * (z - origin.z);
  });
  CHECK(sum > 0);
  const auto mean = [&](int64_t total, int from) {
    return static_cast<float>(static_cast<double>(total) / static_cast<double>(sum) + from);
  };
  return {mean(sum_x, origin.x), mean(sum_y, origin.y), mean(sum_z, origin.z)};
}

}  // namespace

VoxelBox lift_box(const VoxelBox& island) {
  return island.grown(margin);
}

Volume lift(Window& window, const VoxelBox& box, VoxelCoord start) {
  CHECK(window.box.covers(lift_box(box)) && box.holds(start));
  Volume volume;
  if (window.at(start.x, start.y, start.z) >= 0) return volume;
  const Marks marks = component(window, box, start);
  volume.window = alone(window, box, marks);
  volume.centre_voxels = centre_of_mass(volume.window);
  volume.mass = mass_of(window);
  strip(window, marks);
  volume.mass -= mass_of(window);
  CHECK(window.at(start.x, start.y, start.z) >= 0);
  CHECK_DEBUG(volume.mass >= 0);
  return volume;
}

}  // namespace scree
