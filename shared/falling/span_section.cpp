#include "shared/falling/span_section.h"

#include <algorithm>
#include <bit>

#include "shared/base/check.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

double share_of(Code code) {
  return static_cast<double>(occupancy(code)) / units_per_voxel;
}

/// One layer of a brick across an axis: bit i·8 + j for the voxel at i along the next axis, j along the one
/// after that.
uint64_t plane_of(const BrickBits& bits, int axis, int k) {
  if (axis == 0) return bits.words[static_cast<size_t>(k)];
  uint64_t plane = 0;
  for (unsigned x = 0; x < brick_size; ++x) {
    const uint64_t word = bits.words[x];
    if (axis == 2) {  // x, then y: the bits of one z
      uint64_t row = (word >> static_cast<unsigned>(k)) & 0x0101010101010101U;
      row = (row * 0x0102040810204080U) >> 56U;
      plane |= row << (8 * x);
    } else {  // z, then x
      const uint64_t row = (word >> static_cast<unsigned>(8 * k)) & 0xFFU;
      for (unsigned z = 0; z < brick_size; ++z) plane |= ((row >> z) & 1U) << (8 * z + x);
    }
  }
  return plane;
}

/// The voxel of a brick at those places along the axis, the next one, and the one after that.
VoxelCoord voxel_at(int axis, int k, int i, int j) {
  return axis == 0 ? VoxelCoord{k, i, j} : axis == 1 ? VoxelCoord{j, k, i} : VoxelCoord{i, j, k};
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
  own_.assign(shares_.size(), 0);
}

void SpanSections::enter(VoxelCoord voxel, double share) {
  const size_t at = cell(voxel);
  shares_[at] = share;
  own_[at] = 1;
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

void SpanSections::enter_own(const SpanPart& part, int k) {
  const VoxelCoord first = first_voxel(part.brick);
  for (uint64_t left = plane_of(part.bits, axis_, k); left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    const VoxelCoord at = voxel_at(axis_, k, bit / brick_size, bit % brick_size);
    enter(first + at, share_of(part.codes->codes[static_cast<size_t>(Brick::index(at.x, at.y, at.z))]));
  }
}

Code SpanSections::code(VoxelCoord voxel) {
  const BrickCoord brick = brick_of(voxel);
  const VoxelCoord in = voxel - first_voxel(brick);
  return bodies_.codes(brick).codes[static_cast<size_t>(Brick::index(in.x, in.y, in.z))];
}

void SpanSections::enter_beside(const SpanPart& part, int k) {
  constexpr uint64_t low_j = 0x0101010101010101U, high_j = low_j << 7U;
  const VoxelCoord first = first_voxel(part.brick);
  const uint64_t own = plane_of(part.bits, axis_, k);
  const uint64_t beside =
      ((own << 8U) | (own >> 8U) | ((own & ~high_j) << 1U) | ((own & ~low_j) >> 1U)) & ~own;
  for (uint64_t left = beside; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    const VoxelCoord at = voxel_at(axis_, k, bit / brick_size, bit % brick_size);
    const Code there = part.codes->codes[static_cast<size_t>(Brick::index(at.x, at.y, at.z))];
    if (there >= 0) shares_[cell(first + at)] = share_of(there);
  }
  const auto across_face = [&](int i, int j) {
    const VoxelCoord voxel = first + voxel_at(axis_, k, i, j);
    const size_t here = cell(voxel);
    if (own_[here] != 0 || shares_[here] > 0.0) return;
    const Code there = code(voxel);
    if (there >= 0) shares_[here] = share_of(there);
  };
  for (int n = 0; n < brick_size; ++n) {
    if (((own >> static_cast<unsigned>(n)) & 1U) != 0) across_face(-1, n);
    if (((own >> static_cast<unsigned>(56 + n)) & 1U) != 0) across_face(brick_size, n);
    if (((own >> static_cast<unsigned>(8 * n)) & 1U) != 0) across_face(n, -1);
    if (((own >> static_cast<unsigned>(8 * n + 7)) & 1U) != 0) across_face(n, brick_size);
  }
}

SpanSection SpanSections::layer(const SpanBody& body, int axis, int layer) {
  VoxelBox box{};
  there_.clear();
  for (const uint32_t number : body.parts) {
    const SpanPart& part = bodies_.parts()[number];
    const VoxelCoord first = first_voxel(part.brick);
    const int k = layer - along_axis(first, axis);
    if (k < 0 || k >= brick_size) continue;
    const VoxelBox own{first, first + VoxelCoord{brick_size, brick_size, brick_size}};
    box = there_.empty() ? own : hull_of(box, own);
    there_.push_back(&part);
  }
  if (there_.empty()) return {};
  begin(box.grown(1), axis);
  const auto place = [&](const SpanPart* part) { return layer - along_axis(first_voxel(part->brick), axis); };
  for (const SpanPart* part : there_) enter_own(*part, place(part));
  for (const SpanPart* part : there_) enter_beside(*part, place(part));
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
    for (uint64_t left = plane_of(both, axis, 0); left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      enter(first + voxel_at(axis, 0, bit / brick_size, bit % brick_size), 1.0);
    }
  }
  // The mean of both sides, and of what lies beside them: so a sloping beam's section is not too small.
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
      const bool beside = (i > i_lo && own_[here - wide] != 0) ||
                          (i < i_lo + wide_ - 1 && own_[here + wide] != 0) ||
                          (j > j_lo && own_[here - 1] != 0) || (j < j_lo + high_ - 1 && own_[here + 1] != 0);
      if (own_[here] == 0 && !beside) continue;
      // Beside it, rock on both sides belongs to other contacts.
      const Code low = code(voxel - step), high = code(voxel);
      if (own_[here] != 0 || low >= 0 || high >= 0) shares_[here] = 0.5 * (share_of(low) + share_of(high));
    }
  return measure();
}

}  // namespace scree
