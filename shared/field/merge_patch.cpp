#include "shared/field/merge_patch.h"

#include <algorithm>
#include <cstring>

#include "shared/base/vector_clones.h"
#include "shared/field/stamp.h"

namespace scree {

namespace {

constexpr int shift_half = (stamp_shift_max + 1) / 2;

/// Codes are shifted in fractions of 2^15; curvature counts an eighth of the sum of the six differences.
constexpr int fraction_bits = 15;

/// Half a voxel over the second half of the shifts: 21.2 codes · 2^15 / 4096.
constexpr int uniform_step = 168;

/// A voxel farther than this from the piece's surface has no part in its edges or clefts.
constexpr int near_surface = 64;

/// Copies the rows of a part of one window's box to another array of box `to_box`.
void copy_rows(const Code* from, const VoxelBox& from_box, Code* to, const VoxelBox& to_box,
               const VoxelBox& part) {
  const auto index = [](const VoxelBox& box, int x, int y, int z) {
    const VoxelCoord s = box.size();
    return (static_cast<ptrdiff_t>(x - box.lo.x) * s.y + (y - box.lo.y)) * s.z + (z - box.lo.z);
  };
  for (int x = part.lo.x; x < part.hi.x; ++x)
    for (int y = part.lo.y; y < part.hi.y; ++y)
      std::memcpy(to + index(to_box, x, y, part.lo.z), from + index(from_box, x, y, part.lo.z),
                  static_cast<size_t>(part.hi.z - part.lo.z));
}

/// Σ occupancy as it will be once redistanced, of `count` voxels from these pointers on that are inner: one
/// that touches no zero crossing will be full, or empty. No branch: it runs in vectors.
SCREE_VECTOR_CLONES
int settled_sum(const Code* __restrict c, const uint8_t* __restrict inner, ptrdiff_t count, ptrdiff_t step_x,
                ptrdiff_t step_y) {
  int sum = 0;
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = c[i];
    const auto signs =
        static_cast<int8_t>((own ^ c[i - 1]) | (own ^ c[i + 1]) | (own ^ c[i - step_y]) |
                            (own ^ c[i + step_y]) | (own ^ c[i - step_x]) | (own ^ c[i + step_x]));
    const auto settled = static_cast<int8_t>(own < 0 ? -127 : 127);
    int8_t code = signs < 0 ? own : settled;
    code = code < -22 ? int8_t{-22} : code;
    code = code > 22 ? int8_t{22} : code;
    auto full = static_cast<int16_t>(127 - 6 * code);
    full = full < 0 ? int16_t{0} : full;
    full = full > units_per_voxel ? int16_t{units_per_voxel} : full;
    sum += static_cast<int16_t>(full & inner[i]);
  }
  return sum;
}

MassUnits settled_mass(const std::vector<Code>& codes, const std::vector<uint8_t>& inner, size_t first,
                       size_t last, ptrdiff_t step_x, ptrdiff_t step_y) {
  return settled_sum(codes.data() + first, inner.data() + first, static_cast<ptrdiff_t>(last - first), step_x,
                     step_y);
}

/// All ones where a voxel just outside, near the piece, lies between rock along two axes or all three: what
/// is left of seams.
SCREE_VECTOR_CLONES
void find_pits(const Code* __restrict c, const uint8_t* __restrict core, ptrdiff_t count, ptrdiff_t step_x,
               ptrdiff_t step_y, uint8_t* __restrict pits) {
  constexpr Code shallow = 15;  // a third of a voxel
  for (ptrdiff_t i = 0; i < count; ++i) {
    const auto along_z = static_cast<int8_t>(c[i - 1] & c[i + 1]);
    const auto along_y = static_cast<int8_t>(c[i - step_y] & c[i + step_y]);
    const auto along_x = static_cast<int8_t>(c[i - step_x] & c[i + step_x]);
    const auto two = static_cast<int8_t>((along_x & along_y) | (along_y & along_z) | (along_x & along_z));
    pits[i] = static_cast<uint8_t>((two < 0 ? 0xFF : 0) & (c[i] >= 0 ? 0xFF : 0) &
                                   (c[i] < shallow ? 0xFF : 0) & core[i]);
  }
}

struct Amounts {
  int curved;
  int uniform;
};

/// Clefts filled and the piece grown.
SCREE_VECTOR_CLONES
void grow(size_t count, Amounts by, const Code* __restrict united, const Code* __restrict piece,
          const int16_t* __restrict concave, const uint16_t* __restrict rounding, Code* __restrict out) {
  for (size_t i = 0; i < count; ++i) {
    const int filled = united[i] - ((by.curved * concave[i] + rounding[i]) >> fraction_bits);
    const int grown = piece[i] == code_air ? 127 : piece[i] - ((by.uniform + rounding[i]) >> fraction_bits);
    out[i] = static_cast<Code>(std::max(-127, std::min(filled, grown)));
  }
}

/// Edges rounded and the piece shrunk, where it changed the terrain.
SCREE_VECTOR_CLONES
void shrink(size_t count, Amounts by, const Code* __restrict united, const Code* __restrict terrain,
            const int16_t* __restrict convex, const uint8_t* __restrict touched,
            const uint16_t* __restrict rounding, Code* __restrict out) {
  for (size_t i = 0; i < count; ++i) {
    const int raise = by.curved * convex[i] + by.uniform * touched[i] + rounding[i];
    out[i] = static_cast<Code>(std::min<int>(terrain[i], united[i] + (raise >> fraction_bits)));
  }
}

/// All ones for every voxel but those of the outermost layers.
std::vector<uint8_t> inner_mask(const VoxelBox& box, int layers) {
  std::vector<uint8_t> mask(Window::count(box), 0);
  const VoxelCoord size = box.size();
  for (int x = layers; x + layers < size.x; ++x)
    for (int y = layers; y + layers < size.y; ++y)
      std::memset(mask.data() + (static_cast<ptrdiff_t>(x) * size.y + y) * size.z + layers, 0xFF,
                  static_cast<size_t>(size.z - 2 * layers));
  return mask;
}

}  // namespace

MassUnits settling_gain(const Window& window) {
  const std::vector<uint8_t> inner = inner_mask(window.box, 1);
  const ptrdiff_t step_y = window.box.size().z, step_x = step_y * window.box.size().y;
  const auto first = static_cast<size_t>(step_x + step_y + 1);
  const size_t last = window.codes.size() - first;
  int plain = 0;
  for (size_t i = first; i < last; ++i) plain += occupancy(window.codes[i]) & inner[i];
  return settled_mass(window.codes, inner, first, last, step_x, step_y) - plain;
}

MergePatch::MergePatch(const Window& window, const Window& piece) : box_(piece.box.grown(3)) {
  const VoxelCoord size = box_.size();
  step_y_ = size.z;
  step_x_ = step_y_ * size.y;
  const size_t count = Window::count(box_);
  first_ = static_cast<size_t>(step_x_ + step_y_ + 1);
  last_ = count - first_;
  terrain_.resize(count);
  copy_rows(window.codes.data(), window.box, terrain_.data(), box_, box_);
  piece_.assign(count, code_air);
  copy_rows(piece.codes.data(), piece.box, piece_.data(), box_, piece.box);
  inner_ = inner_mask(box_, 1);
  core_ = inner_mask(box_, 2);
  before_ = settled_mass(terrain_, inner_, first_, last_, step_x_, step_y_);
  unite();
  close_gaps();
  find_curvature();
}

void MergePatch::unite() {
  const size_t count = terrain_.size();
  united_.resize(count);
  touched_.resize(count);
  for (size_t i = 0; i < count; ++i) {
    touched_[i] = piece_[i] < terrain_[i] && piece_[i] < near_surface ? 1 : 0;
    united_[i] = std::min(piece_[i], terrain_[i]);
  }
  codes_ = united_;
  pits_.assign(count, 0);
}

/// Outside voxels next to what the piece changed that lie in a gap of less than a voxel become rock, just
/// inside.
void MergePatch::close_gaps() {
  constexpr Code too_far = 43;  // a voxel from either side by its own account
  const ptrdiff_t steps[3] = {step_x_, step_y_, 1};
  std::vector<size_t> gaps;
  for (size_t i = first_; i < last_; ++i) {
    const int here = united_[i];
    if (here < 0 || here >= too_far || core_[i] == 0) continue;
    const Code* c = united_.data() + i;
    const uint8_t* t = touched_.data() + i;
    for (const ptrdiff_t step : steps) {
      const int low = c[-step], high = c[step];
      if (low >= 0 || high >= 0 || (t[0] | t[-step] | t[step]) == 0) continue;
      // Width of the gap: here / (here − low) + here / (here − high) < 1, without the divisions.
      if (here * (here - high) + here * (here - low) >= (here - low) * (here - high)) continue;
      gaps.push_back(i);
      break;
    }
  }
  for (const size_t i : gaps) united_[i] = -1;
}

void MergePatch::find_curvature() {
  const size_t count = terrain_.size();
  convex_.assign(count, 0);
  concave_.assign(count, 0);
  rounding_.assign(count, 0);
  const auto bend = [&](const std::vector<Code>& codes, size_t i) {
    const Code* c = codes.data() + i;
    return c[-1] + c[1] + c[-step_y_] + c[step_y_] + c[-step_x_] + c[step_x_] - 6 * c[0];
  };
  const VoxelCoord size = box_.size();
  for (size_t i = first_; i < last_; ++i) {
    if (inner_[i] == 0 || piece_[i] >= near_surface) continue;
    const auto x = static_cast<ptrdiff_t>(i) / step_x_, y = (static_cast<ptrdiff_t>(i) / step_y_) % size.y,
               z = static_cast<ptrdiff_t>(i) % size.z;
    const uint32_t place = (static_cast<uint32_t>(box_.lo.x + x) * 73856093U) ^
                           (static_cast<uint32_t>(box_.lo.y + y) * 19349663U) ^
                           (static_cast<uint32_t>(box_.lo.z + z) * 83492791U);
    rounding_[i] = static_cast<uint16_t>((place * 2654435761U) >> 17U);
    const int u = united_[i];
    if (u > near_surface || u < -near_surface) continue;
    if (touched_[i] != 0) convex_[i] = static_cast<int16_t>(std::max(0, bend(piece_, i)));
    const uint8_t* t = touched_.data() + i;
    const int touch = t[0] | t[-1] | t[1] | t[-step_y_] | t[step_y_] | t[-step_x_] | t[step_x_];
    // Twice: what is left of seams must close before the surface moves (measured: bench seams).
    if (touch != 0) concave_[i] = static_cast<int16_t>(2 * std::max(0, -bend(united_, i)));
  }
}

void MergePatch::shape(int shift) {
  const int size = shift < 0 ? -shift : shift;
  const int curved = std::min(size, shift_half);
  const Amounts by{curved, (size - curved) * uniform_step};
  const size_t count = terrain_.size();
  if (shift >= 0)
    grow(count, by, united_.data(), piece_.data(), concave_.data(), rounding_.data(), codes_.data());
  else
    shrink(count, by, united_.data(), terrain_.data(), convex_.data(), touched_.data(), rounding_.data(),
           codes_.data());
}

MassUnits MergePatch::gain(int shift) {
  shape(shift);
  find_pits(codes_.data() + first_, core_.data() + first_, static_cast<ptrdiff_t>(last_ - first_), step_x_,
            step_y_, pits_.data() + first_);
  for (size_t i = first_; i < last_; ++i) codes_[i] = pits_[i] != 0 ? Code{-1} : codes_[i];
  return settled_mass(codes_, inner_, first_, last_, step_x_, step_y_) - before_;
}

void MergePatch::write(Window& window) const {
  copy_rows(codes_.data(), box_, window.codes.data(), window.box, box_.grown(-1));
}

}  // namespace scree
