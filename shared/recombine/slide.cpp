#include "shared/recombine/slide.h"

#include <algorithm>
#include <cstdlib>

#include "shared/base/check.h"
#include "shared/field/material_changes.h"
#include "shared/field/redistance.h"
#include "shared/recombine/slide_mass.h"

namespace scree {

namespace {

/// Mass times height by which a slide must sink: four voxels of rock by a voxel. The mass of a world is
/// finite, and has a lowest place.
constexpr int64_t sink_min = int64_t{4} * units_per_voxel;

/// Codes just beyond the ends of the ramp: a face halfway between a full voxel and an empty one.
constexpr int face_code = 22;

/// Voxels above a surface in which the distance is to it.
constexpr int above = 5;

/// Columns around those that move in which distances change.
constexpr int reach = 3;

/// Times that the volume is corrected before its mass is met.
constexpr int corrections = 8;

/// By how much more must be raised than is lowered for the mass to stay: what lies half in a face that goes
/// is no height. False position, from the volume of the mass that is missing.
class Correction {
 public:
  /// So much height weighs so much.
  Correction(int64_t height, MassUnits weighs) : height_(height), weighs_(weighs) {}

  int64_t more() const { return more_; }
  /// What was gained by the last.
  void heed(MassUnits gain) {
    const int64_t last = more_, step = more_ - before_;
    const MassUnits gained = gain - gain_before_;
    const bool is_known = step != 0 && (gained > 0) == (step > 0) && gained != 0;
    more_ -= is_known ? gain * step / gained : gain * height_ / weighs_;
    before_ = last;
    gain_before_ = gain;
  }

 private:
  int64_t height_;
  MassUnits weighs_;
  int64_t more_ = 0, before_ = 0;
  MassUnits gain_before_ = 0;
};

/// The rubble's surface moves, and the distances above and below with it.
void shift_codes(const Window& before, const SlideColumns& columns, Window& after) {
  const VoxelCoord size = before.box.size();
  const ptrdiff_t step = size.z;
  for (int x = 0; x < size.x; ++x)
    for (int z = 0; z < size.z; ++z) {
      const SlideColumn& column = columns.at(x, z);
      if (column.shift == 0) continue;
      const size_t foot = before.index(before.box.lo.x + x, before.box.lo.y, before.box.lo.z + z);
      const int lowest = std::min(column.last, column.top);
      const auto at = [&](int y) -> int {
        if (y < lowest) return code_solid;
        return before.codes[foot + static_cast<size_t>(std::min(y, size.y - 1) * step)];
      };
      // Beyond the band above it, distances are to something else. The outermost layer stays.
      const int end = (column.height + std::max(column.shift, 0)) / slide_steps + above;
      for (int y = column.last; y < std::min(end, size.y - 1); ++y) {
        const int from = y * slide_steps - column.shift;
        const int below = from >= 0 ? from / slide_steps : -((slide_steps - 1 - from) / slide_steps);
        const int part = from - below * slide_steps;
        const int sum = at(below) * (slide_steps - part) + at(below + 1) * part;
        const int half = sum < 0 ? -slide_steps / 2 : slide_steps / 2;
        int code = (sum + half) / slide_steps;
        if (sum < 0 && code == 0) code = -1;
        after.codes[foot + static_cast<size_t>(y * step)] = static_cast<Code>(code);
      }
    }
}

/// What rubble left bare, and did not move itself, has its face halfway between the voxels.
void bare_faces(const Window& before, const SlideColumns& columns, Window& after) {
  const VoxelBox& box = before.box;
  const VoxelCoord size = box.size();
  constexpr VoxelCoord sides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}};
  for (int x = 1; x + 1 < size.x; ++x)
    for (int z = 1; z + 1 < size.z; ++z) {
      const SlideColumn& column = columns.at(x, z);
      if (column.shift >= 0) continue;
      for (int y = column.last; y <= column.top; ++y) {
        const VoxelCoord v = box.lo + VoxelCoord{x, y, z};
        const size_t at = before.index(v.x, v.y, v.z);
        if (after.codes[at] < 0) continue;
        for (const VoxelCoord& side : sides) {
          const VoxelCoord n = v + side;
          const size_t beside = before.index(n.x, n.y, n.z);
          const SlideColumn& other = columns.at(x + side.x, z + side.z);
          const int height = n.y - box.lo.y;
          const bool moves = other.shift != 0 && height >= other.last && height <= other.top;
          if (moves || before.codes[beside] >= 0 || after.codes[beside] >= 0) continue;
          after.codes[beside] = static_cast<Code>(std::max<int>(after.codes[beside], -face_code));
          after.codes[at] = static_cast<Code>(std::min<int>(after.codes[at], face_code));
        }
      }
    }
}

/// Which solid voxels hang together with those of the outermost layers, as far as a slide goes down. One byte
/// each.
std::vector<uint8_t> held(const Window& window, int lowest) {
  const VoxelCoord size = window.box.size();
  const ptrdiff_t step_y = size.z, step_x = step_y * size.y;
  std::vector<uint8_t> is_held(window.codes.size(), 0);
  std::vector<VoxelCoord> found;
  const auto enter = [&](int x, int y, int z) {
    const auto at = static_cast<size_t>(x * step_x + y * step_y + z);
    if (window.codes[at] >= 0 || is_held[at] != 0) return;
    is_held[at] = 1;
    found.push_back({x, y, z});
  };
  for (int x = 0; x < size.x; ++x)
    for (int z = 0; z < size.z; ++z) {
      const bool rim = x == 0 || z == 0 || x + 1 == size.x || z + 1 == size.z;
      for (int y = lowest; y < size.y; ++y)
        if (rim || y == lowest || y + 1 == size.y) enter(x, y, z);
    }
  while (!found.empty()) {
    const VoxelCoord v = found.back();
    found.pop_back();
    if (v.x > 0) enter(v.x - 1, v.y, v.z);
    if (v.x + 1 < size.x) enter(v.x + 1, v.y, v.z);
    if (v.y > lowest) enter(v.x, v.y - 1, v.z);
    if (v.y + 1 < size.y) enter(v.x, v.y + 1, v.z);
    if (v.z > 0) enter(v.x, v.y, v.z - 1);
    if (v.z + 1 < size.z) enter(v.x, v.y, v.z + 1);
  }
  return is_held;
}

/// Crumbs of the rubble that nothing holds any more run down with the rest.
void drop_crumbs(const SlideColumns& columns, Window& after) {
  const VoxelCoord size = after.box.size();
  int lowest = size.y - 1;
  for (int x = 0; x < size.x; ++x)
    for (int z = 0; z < size.z; ++z)
      if (columns.at(x, z).shift != 0) lowest = std::min(lowest, columns.at(x, z).last);
  lowest = std::max(1, lowest - 2);
  const std::vector<uint8_t> is_held = held(after, lowest);
  for (int x = 0; x < size.x; ++x)
    for (int z = 0; z < size.z; ++z) {
      const SlideColumn& column = columns.at(x, z);
      if (column.shift == 0) continue;
      for (int y = std::max(column.last, lowest); y + 1 < size.y; ++y) {
        const size_t at = after.index(after.box.lo.x + x, after.box.lo.y + y, after.box.lo.z + z);
        if (after.codes[at] < 0 && is_held[at] == 0) after.codes[at] = face_code;
      }
    }
}

/// A byte for each column: whether one moves within `reach`.
std::vector<uint8_t> near_columns(const SlideColumns& columns) {
  const int nx = columns.size_x(), nz = columns.size_z();
  std::vector<uint8_t> near(static_cast<size_t>(nx) * static_cast<size_t>(nz), 0);
  for (int x = 0; x < nx; ++x)
    for (int z = 0; z < nz; ++z) {
      if (!columns.wants_to_move(x, z)) continue;
      for (int i = std::max(0, x - reach); i <= std::min(nx - 1, x + reach); ++i)
        for (int k = std::max(0, z - reach); k <= std::min(nz - 1, z + reach); ++k)
          near[static_cast<size_t>(i) * static_cast<size_t>(nz) + static_cast<size_t>(k)] = 1;
    }
  return near;
}

/// f(the place of a voxel, whether its column is near) of all inner voxels.
template <typename F>
void for_each_inner(const Window& window, const std::vector<uint8_t>& near, F&& f) {
  const VoxelCoord size = window.box.size();
  for (int x = 1; x + 1 < size.x; ++x)
    for (int y = 1; y + 1 < size.y; ++y) {
      const size_t row = window.index(window.box.lo.x + x, window.box.lo.y + y, window.box.lo.z);
      for (int z = 1; z + 1 < size.z; ++z)
        f(row + static_cast<size_t>(z),
          near[static_cast<size_t>(x) * static_cast<size_t>(size.z) + static_cast<size_t>(z)] != 0);
    }
}

/// Voxels that touch no zero crossing become full or empty, as redistancing will make them.
void settle(const std::vector<uint8_t>& near, Window& window) {
  const VoxelCoord size = window.box.size();
  const ptrdiff_t step_y = size.z, step_x = step_y * size.y;
  const std::vector<Code> codes = window.codes;
  for_each_inner(window, near, [&](size_t at, bool is_near) {
    const Code* c = &codes[at];
    const int own = c[0];
    const int signs = (own ^ c[-1]) | (own ^ c[1]) | (own ^ c[-step_y]) | (own ^ c[step_y]) |
                      (own ^ c[-step_x]) | (own ^ c[step_x]);
    if (is_near && signs >= 0) window.codes[at] = own < 0 ? code_solid : code_air;
  });
}

void make_distances(const Window& before, const std::vector<uint8_t>& near, Window& after) {
  redistance(after);
  for_each_inner(after, near, [&](size_t at, bool is_near) {
    if (!is_near) after.codes[at] = before.codes[at];
  });
}

AddedMaterials added_by(const MaterialReader& were, const SlideMass& mass) {
  MaterialChanges changes(were);
  changes.change(mass.becomes(),
                 [&](VoxelCoord, size_t at, Material) { return material_of(mass.becomes()[at]); });
  AddedMaterials added;
  added.says = changes.says();
  return added;
}

}  // namespace

std::optional<Slid> slide(const MaterialReader& were, const RubbleRows& rows, const Window& before,
                          const SlideTerms& terms) {
  SlideColumns columns(were, before, terms);
  if (!columns.run()) return std::nullopt;
  const std::vector<uint8_t> near = near_columns(columns);
  SlideMass mass(were, rows, before, terms.material, near);
  const MassUnits unit = int64_t{units_per_voxel} * rows.fill[row_number(terms.material)];
  Correction correction(slide_steps * fill_solid, unit);
  Window after;
  for (int round = 0; round < corrections; ++round) {
    if (round > 0 && !columns.share_out(correction.more())) return std::nullopt;
    after = before;
    shift_codes(before, columns, after);
    bare_faces(before, columns, after);
    drop_crumbs(columns, after);
    settle(near, after);
    mass.assign(after);
    if (std::abs(mass.gain_of_rubble()) <= mass.reach_of_rubble()) break;
    correction.heed(mass.gain_of_rubble());
  }
  if (!mass.meet(after)) return std::nullopt;
  make_distances(before, near, after);
  if (!mass.is_met(after) || mass.lifted(after) > -sink_min) return std::nullopt;
  return Slid{std::move(after), added_by(were, mass)};
}

}  // namespace scree
