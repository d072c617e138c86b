#include "shared/falling/span_section.h"

#include <algorithm>

#include "shared/base/check.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

double share_of(Code code) {
  return static_cast<double>(occupancy(code)) / units_per_voxel;
}

bool is_set(const BrickBits& bits, VoxelCoord at) {
  return ((bits.words[static_cast<size_t>(at.x)] >> static_cast<unsigned>(at.y * brick_size + at.z)) & 1U) !=
         0;
}

/// A bar of some length in each line of cells: exact where the surface crosses the line.
struct Bars {
  double area = 0.0, first = 0.0, second = 0.0;
  double lo = 1e30, hi = -1e30;

  void add(double from, double to, double width) {
    area += width * (to - from);
    first += width * 0.5 * (to * to - from * from);
    second += width * (to * to * to - from * from * from) / 3.0;
    lo = std::min(lo, from);
    hi = std::max(hi, to);
  }
  double centre() const { return first / area; }
  double about_centre() const { return second - first * first / area; }
};

/// Cells of one line; `share(k)` of the k-th, whose middle lies at `origin` + k. Where the line lies at the
/// section's side, all of its cells hold less: then the bar is as much narrower.
template <typename F>
void add_line(Bars& bars, int count, int origin, F&& share) {
  for (int k = 0; k < count; ++k) {
    if (share(k) <= 0.0) continue;
    const int from = k;
    double width = share(k);
    while (k + 1 < count && share(k + 1) > 0.0) width = std::max(width, share(++k));
    const double first = origin + from, last = origin + k;
    if (from == k)
      bars.add(first - 0.5 * width, first + 0.5 * width, 1.0);
    else
      bars.add(first + 0.5 - share(from) / width, last - 0.5 + share(k) / width, width);
  }
}

}  // namespace

size_t SpanSections::cell(VoxelCoord voxel) const {
  const int u = along_axis(voxel, (axis_ + 1) % 3) - along_axis(lo_, (axis_ + 1) % 3);
  const int v = along_axis(voxel, (axis_ + 2) % 3) - along_axis(lo_, (axis_ + 2) % 3);
  CHECK_DEBUG(u >= 0 && v >= 0 && u < wide_ && v < high_);
  return static_cast<size_t>(u * high_ + v);
}

void SpanSections::begin(const VoxelBox& box, int axis) {
  axis_ = axis;
  lo_ = box.lo;
  wide_ = along_axis(box.size(), (axis + 1) % 3);
  high_ = along_axis(box.size(), (axis + 2) % 3);
  shares_.assign(static_cast<size_t>(wide_ * high_), 0.0);
  own_.assign(shares_.size(), false);
}

void SpanSections::enter(VoxelCoord voxel, double share) {
  const size_t at = cell(voxel);
  shares_[at] = share;
  own_[at] = true;
}

SpanSection SpanSections::measure() const {
  Bars along_u, along_v;
  const int u0 = along_axis(lo_, (axis_ + 1) % 3), v0 = along_axis(lo_, (axis_ + 2) % 3);
  const auto at = [&](int u, int v) { return shares_[static_cast<size_t>(u * high_ + v)]; };
  for (int v = 0; v < high_; ++v) add_line(along_u, wide_, u0, [&](int u) { return at(u, v); });
  for (int u = 0; u < wide_; ++u) add_line(along_v, high_, v0, [&](int v) { return at(u, v); });
  SpanSection out;
  if (along_u.area <= 0.0 || along_v.area <= 0.0) return out;
  out.area = 0.5 * (along_u.area + along_v.area);
  out.u = along_u.centre();
  out.v = along_v.centre();
  out.uu = along_u.about_centre();
  out.vv = along_v.about_centre();
  out.u_lo = along_u.lo;
  out.u_hi = along_u.hi;
  out.v_lo = along_v.lo;
  out.v_hi = along_v.hi;
  return out;
}

SpanSection SpanSections::layer(const SpanBody& body, int axis, int layer) {
  VoxelBox box{};
  std::vector<const SpanPart*> there;
  for (const uint32_t number : body.parts) {
    const SpanPart& part = bodies_.parts()[number];
    const VoxelCoord first = first_voxel(part.brick);
    const int k = layer - along_axis(first, axis);
    if (k < 0 || k >= brick_size) continue;
    const VoxelBox own{first, first + VoxelCoord{brick_size, brick_size, brick_size}};
    box = there.empty() ? own : hull_of(box, own);
    there.push_back(&part);
  }
  if (there.empty()) return {};
  begin(box.grown(1), axis);
  for (const SpanPart* part : there) {
    const VoxelCoord first = first_voxel(part->brick);
    VoxelCoord at{};
    along_axis(at, axis) = layer - along_axis(first, axis);
    int &i = along_axis(at, (axis + 1) % 3), &j = along_axis(at, (axis + 2) % 3);
    for (i = 0; i < brick_size; ++i)
      for (j = 0; j < brick_size; ++j)
        if (is_set(part->bits, at))
          enter(first + at,
                share_of(part->codes->codes[static_cast<size_t>(Brick::index(at.x, at.y, at.z))]));
  }
  // Voxels beside them whose middle lies outside, but which hold some.
  for (const SpanPart* part : there) {
    const VoxelCoord first = first_voxel(part->brick);
    VoxelCoord at{};
    along_axis(at, axis) = layer - along_axis(first, axis);
    int &i = along_axis(at, (axis + 1) % 3), &j = along_axis(at, (axis + 2) % 3);
    for (i = -1; i <= brick_size; ++i)
      for (j = -1; j <= brick_size; ++j) {
        const bool i_out = i < 0 || i == brick_size, j_out = j < 0 || j == brick_size;
        const size_t here = cell(first + at);
        if ((i_out && j_out) || own_[here] || shares_[here] > 0.0) continue;
        const auto wide = static_cast<size_t>(high_);
        const bool beside = (i > -1 && own_[here - wide]) || (i < brick_size && own_[here + wide]) ||
                            (j > -1 && own_[here - 1]) || (j < brick_size && own_[here + 1]);
        if (!beside) continue;
        const VoxelCoord voxel = first + at;
        const BrickCoord brick = brick_of(voxel);
        const Brick& codes = brick == part->brick ? *part->codes : bodies_.codes(brick);
        const VoxelCoord in = voxel - first_voxel(brick);
        const Code code = codes.codes[static_cast<size_t>(Brick::index(in.x, in.y, in.z))];
        if (code >= 0) shares_[here] = share_of(code);
      }
  }
  return measure();
}

SpanSection SpanSections::face(std::span<const SpanContact> contacts, int axis, int layer) {
  VoxelBox box{};
  for (const SpanContact& contact : contacts) {
    const VoxelCoord first = first_voxel(bodies_.parts()[contact.upper].brick);
    const VoxelBox own{first, first + VoxelCoord{brick_size, brick_size, brick_size}};
    box = &contact == contacts.data() ? own : hull_of(box, own);
  }
  begin(box.grown(1), axis);
  for (const SpanContact& contact : contacts) {
    const SpanPart &lower = bodies_.parts()[contact.lower], &upper = bodies_.parts()[contact.upper];
    const VoxelCoord first = first_voxel(upper.brick);
    const BrickBits both = across(lower.bits, 2 * static_cast<size_t>(axis)) & upper.bits;
    VoxelCoord at{};
    int &i = along_axis(at, (axis + 1) % 3), &j = along_axis(at, (axis + 2) % 3);
    for (i = 0; i < brick_size; ++i)
      for (j = 0; j < brick_size; ++j)
        if (is_set(both, at)) enter(first + at, 1.0);
  }
  // The mean of both sides, and of what lies beside them: so a sloping beam's section is not too small.
  const auto code = [&](VoxelCoord voxel) {
    const BrickCoord brick = brick_of(voxel);
    const VoxelCoord in = voxel - first_voxel(brick);
    return bodies_.codes(brick).codes[static_cast<size_t>(Brick::index(in.x, in.y, in.z))];
  };
  VoxelCoord step{};
  along_axis(step, axis) = 1;
  VoxelCoord voxel = box.lo;
  along_axis(voxel, axis) = layer;
  int &i = along_axis(voxel, (axis + 1) % 3), &j = along_axis(voxel, (axis + 2) % 3);
  const int i_lo = i - 1, j_lo = j - 1;
  for (i = i_lo; i < i_lo + wide_; ++i)
    for (j = j_lo; j < j_lo + high_; ++j) {
      const size_t here = cell(voxel);
      const auto wide = static_cast<size_t>(high_);
      const bool beside = (i > i_lo && own_[here - wide]) || (i < i_lo + wide_ - 1 && own_[here + wide]) ||
                          (j > j_lo && own_[here - 1]) || (j < j_lo + high_ - 1 && own_[here + 1]);
      if (!own_[here] && !beside) continue;
      // Beside it, rock on both sides belongs to other contacts.
      const Code low = code(voxel - step), high = code(voxel);
      if (own_[here] || low >= 0 || high >= 0) shares_[here] = 0.5 * (share_of(low) + share_of(high));
    }
  return measure();
}

}  // namespace scree
