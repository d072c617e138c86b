#include "shared/falling/punch.h"

#include <algorithm>

#include "shared/falling/span_section.h"
#include "shared/field/material_window.h"

namespace scree {

namespace {

/// Least side of a plug.
constexpr int side_min = 3;
/// How far before the foremost place that is struck its rock may begin.
constexpr int before = 2;

/// The bounds of what is struck, at least side_min wide across the blow.
VoxelBox struck_box(const BlowLoad& load, int axis) {
  VoxelBox box{load.on.front(), load.on.front()};
  for (const VoxelCoord& voxel : load.on)
    for (int k = 0; k < 3; ++k) {
      along_axis(box.lo, k) = std::min(along_axis(box.lo, k), along_axis(voxel, k));
      along_axis(box.hi, k) = std::max(along_axis(box.hi, k), along_axis(voxel, k));
    }
  for (int k = 0; k < 3; ++k) {
    int &lo = along_axis(box.lo, k), &hi = along_axis(box.hi, k);
    hi += 1;
    if (k == axis) continue;
    while (hi - lo < side_min) (hi - lo) % 2 == 0 ? ++hi : --lo;
  }
  return box;
}

class Punch {
 public:
  Punch(const Field& field, const VoxelBox& struck, LoadDirection direction)
      : axis_(direction.axis),
        step_(direction.up ? 1 : -1),
        u_((axis_ + 1) % 3),
        v_((axis_ + 2) % 3),
        box_(deep(struck)),
        codes_(gather(field, box_.grown(1))) {}

  /// The rock of all columns, or an empty box: nothing, or some column is too thick.
  VoxelBox plug() {
    VoxelBox plug{box_.hi, box_.lo};
    VoxelCoord at;
    for (along_axis(at, u_) = along_axis(box_.lo, u_); along_axis(at, u_) < along_axis(box_.hi, u_);
         ++along_axis(at, u_))
      for (along_axis(at, v_) = along_axis(box_.lo, v_); along_axis(at, v_) < along_axis(box_.hi, v_);
           ++along_axis(at, v_))
        if (!enter(at, plug)) return {};
    return voxels_ >= overload_voxels_min ? plug : VoxelBox{};
  }
  int64_t voxels() const { return voxels_; }

  /// Pairs of rock inside and outside, across the blow.
  int64_t sheared(const VoxelBox& plug) const {
    int64_t faces = 0;
    for (int x = plug.lo.x; x < plug.hi.x; ++x)
      for (int y = plug.lo.y; y < plug.hi.y; ++y)
        for (int z = plug.lo.z; z < plug.hi.z; ++z) {
          if (codes_.at(x, y, z) >= 0) continue;
          for (const int k : {u_, v_})
            for (const int side : {-1, 1}) {
              VoxelCoord next{x, y, z};
              along_axis(next, k) += side;
              if (!contains(plug, next) && codes_.at(next.x, next.y, next.z) < 0) ++faces;
            }
        }
    return faces;
  }

 private:
  static bool contains(const VoxelBox& box, VoxelCoord v) {
    return v.x >= box.lo.x && v.y >= box.lo.y && v.z >= box.lo.z && v.x < box.hi.x && v.y < box.hi.y &&
           v.z < box.hi.z;
  }
  /// From a little before the foremost place to as far as a plug may reach.
  VoxelBox deep(VoxelBox box) const {
    int &lo = along_axis(box.lo, axis_), &hi = along_axis(box.hi, axis_);
    if (step_ > 0) {
      hi = std::max(hi, lo + plug_thickness_max);
      lo -= before;
    } else {
      lo = std::min(lo, hi - plug_thickness_max);
      hi += before;
    }
    return box;
  }
  /// Grows the plug by a column's first rock along the blow. False when no air follows it.
  bool enter(VoxelCoord at, VoxelBox& plug) {
    const int first = step_ > 0 ? along_axis(box_.lo, axis_) : along_axis(box_.hi, axis_) - 1;
    const int count = along_axis(box_.hi, axis_) - along_axis(box_.lo, axis_);
    bool inside = false;
    for (int i = 0; i <= count; ++i) {
      along_axis(at, axis_) = first + i * step_;  // at last one beyond the box, which was gathered, too
      const bool rock = codes_.at(at.x, at.y, at.z) < 0;
      if (inside && !rock) return true;
      if (!rock) continue;
      if (i == count) return false;
      inside = true;
      ++voxels_;
      plug = hull_of(plug, {at, at + VoxelCoord{1, 1, 1}});
    }
    return true;
  }

  int axis_, step_, u_, v_;
  VoxelBox box_;
  Window codes_;
  int64_t voxels_ = 0;
};

}  // namespace

std::optional<Plug> find_plug(const Field& field, const Palette& palette, const BlowLoad& load,
                              LoadDirection direction) {
  const VoxelBox struck = struck_box(load, direction.axis);
  const VoxelCoord size = struck.size();
  if (std::max({size.x, size.y, size.z}) > plug_side_max) return std::nullopt;
  Punch punch(field, struck, direction);
  const VoxelBox box = punch.plug();
  if (box.empty()) return std::nullopt;
  const float dx = field.source().voxel_size_m;
  const VoxelCoord on = load.on.front();
  const glm::vec3 at_m =
      glm::vec3(static_cast<float>(on.x), static_cast<float>(on.y), static_cast<float>(on.z)) * dx;
  const MaterialRow& row = palette.row_or_first(material_at(field, at_m));
  Plug plug;
  const int64_t faces = punch.sheared(box);
  plug.newtons = static_cast<double>(faces) * static_cast<double>(row.bearing.sideways_pa) *
                 static_cast<double>(dx * dx);
  plug.overload.voxels = punch.voxels();
  plug.overload.start = box.lo;
  plug.overload.necks.push_back({box, std::max<int64_t>(faces, 1)});
  return plug;
}

}  // namespace scree
