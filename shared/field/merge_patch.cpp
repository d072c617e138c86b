#include "shared/field/merge_patch.h"

#include <algorithm>
#include <cstring>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/stamp.h"

namespace scree {

namespace {

constexpr int roundness_half = (stamp_roundness_max + 1) / 2;

/// Edges and clefts give way by an eighth of the sum of the six differences at the most: 2^-8 a shift.
constexpr int curvature_bits = 8;
constexpr int curvature_max = 1016;  // its product with roundness_half fits 16 bits

/// Half a voxel over the second half of the shifts: 11/16 code each.
constexpr int uniform_sixteenths = 11;

/// A voxel farther than this from the piece's surface has no part in its edges or clefts.
constexpr int near_surface = 64;

/// Codes whose occupancy is a ramp: ±21. Those up to here can be moved onto an end of it unseen.
constexpr int ramp_end = 21;
constexpr int ramp_end_reach = 30;

/// Negative where a neighbour lies on the other side.
inline int8_t crossing_signs(const Code* c, ptrdiff_t step_x, ptrdiff_t step_y) {
  const int8_t own = c[0];
  return static_cast<int8_t>((own ^ c[-1]) | (own ^ c[1]) | (own ^ c[-step_y]) | (own ^ c[step_y]) |
                             (own ^ c[-step_x]) | (own ^ c[step_x]));
}

SCREE_VECTOR_CLONES
void unite(size_t count, const Code* __restrict terrain, const Code* __restrict piece,
           Code* __restrict united, uint8_t* __restrict touched) {
  for (size_t i = 0; i < count; ++i) {
    touched[i] =
        static_cast<uint8_t>((piece[i] < terrain[i] ? 0xFF : 0) & (piece[i] < near_surface ? 0xFF : 0));
    united[i] = std::min(piece[i], terrain[i]);
  }
}

/// Outside voxels next to what the piece changed that lie in a gap of less than a voxel, between rock on both
/// sides along an axis, become rock, just inside. Width of the gap: h / (h − low) + h / (h − high) < 1, which
/// is h² < low · high.
SCREE_VECTOR_CLONES
void fill_gaps(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
               const uint8_t* __restrict touched, Code* __restrict out) {
  constexpr Code too_far = 43;  // a voxel from either side by its own account
  const ptrdiff_t steps[3] = {1, step_y, step_x};
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = c[i];
    const auto square = static_cast<int16_t>(own * own);
    int8_t gap = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const ptrdiff_t step = steps[axis];
      const int8_t low = c[i - step], high = c[i + step];
      const auto product = static_cast<int16_t>(low * high);
      const auto narrow = static_cast<int8_t>(square < product ? -1 : 0);
      const auto touches = static_cast<int8_t>(touched[i - step] | touched[i] | touched[i + step]);
      gap = static_cast<int8_t>(gap | (low & high & narrow & touches));
    }
    const auto close = static_cast<int8_t>(gap & (own >= 0 ? -1 : 0) & (own < too_far ? -1 : 0));
    out[i] = close < 0 ? Code{-1} : own;
  }
}

inline int16_t bend(const Code* c, ptrdiff_t step_x, ptrdiff_t step_y) {
  return static_cast<int16_t>(c[-1] + c[1] + c[-step_y] + c[step_y] + c[-step_x] + c[step_x] - 6 * c[0]);
}

/// How much the piece's edges stand out, and the union's clefts lie back, near the surface.
SCREE_VECTOR_CLONES
void find_bends(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict piece,
                const Code* __restrict united, const uint8_t* __restrict touched, int16_t* __restrict convex,
                int16_t* __restrict concave) {
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = united[i];
    const auto near = static_cast<int16_t>((own <= near_surface ? -1 : 0) & (own >= -near_surface ? -1 : 0) &
                                           (piece[i] < near_surface ? -1 : 0));
    const uint8_t* t = touched + i;
    const auto touch =
        static_cast<int8_t>(t[0] | t[-1] | t[1] | t[-step_y] | t[step_y] | t[-step_x] | t[step_x]);
    const int16_t out = bend(piece + i, step_x, step_y);
    // Twice: what is left of seams must close before the surface moves (measured: bench seams).
    const auto back = static_cast<int16_t>(-2 * bend(united + i, step_x, step_y));
    convex[i] = static_cast<int16_t>(std::clamp<int16_t>(out, 0, curvature_max) & near &
                                     static_cast<int8_t>(touched[i]));
    concave[i] = static_cast<int16_t>(std::clamp<int16_t>(back, 0, curvature_max) & near & touch);
  }
}

struct Amounts {
  int16_t curved;
  int16_t uniform;  ///< codes
};

/// Clefts filled and the piece grown.
SCREE_VECTOR_CLONES
void grow(size_t count, Amounts by, const Code* __restrict united, const Code* __restrict piece,
          const int16_t* __restrict concave, Code* __restrict out) {
  for (size_t i = 0; i < count; ++i) {
    const auto filled =
        static_cast<int16_t>(united[i] - (static_cast<int16_t>(by.curved * concave[i]) >> curvature_bits));
    const auto grown = static_cast<int16_t>(piece[i] == code_air ? code_air : piece[i] - by.uniform);
    out[i] = static_cast<Code>(std::max<int16_t>(code_solid, std::min(filled, grown)));
  }
}

/// Edges rounded and the piece shrunk, where it changed the terrain.
SCREE_VECTOR_CLONES
void shrink(size_t count, Amounts by, const Code* __restrict united, const Code* __restrict terrain,
            const int16_t* __restrict convex, const uint8_t* __restrict touched, Code* __restrict out) {
  for (size_t i = 0; i < count; ++i) {
    const auto raise = static_cast<int16_t>((static_cast<int16_t>(by.curved * convex[i]) >> curvature_bits) +
                                            (by.uniform & static_cast<int8_t>(touched[i])));
    out[i] = static_cast<Code>(std::min<int16_t>(terrain[i], static_cast<int16_t>(united[i] + raise)));
  }
}

/// Fills voxels just outside, near the piece, that lie between rock along two axes or all three: what is left
/// of seams.
SCREE_VECTOR_CLONES
void fill_pits(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
               const uint8_t* __restrict core, Code* __restrict out) {
  constexpr Code shallow = 15;  // a third of a voxel
  for (ptrdiff_t i = 0; i < count; ++i) {
    const auto along_z = static_cast<int8_t>(c[i - 1] & c[i + 1]);
    const auto along_y = static_cast<int8_t>(c[i - step_y] & c[i + step_y]);
    const auto along_x = static_cast<int8_t>(c[i - step_x] & c[i + step_x]);
    const auto two = static_cast<int8_t>((along_x & along_y) | (along_y & along_z) | (along_x & along_z));
    const int8_t own = c[i];
    // By signs alone, not below zero and below shallow: comparisons became branches, four times the time.
    const auto pit = static_cast<int8_t>(two & ~own & (own - shallow) & core[i]);
    out[i] = pit < 0 ? Code{-1} : own;
  }
}

/// Σ occupancy as it will be once redistanced, of the inner voxels: one that touches no zero crossing will be
/// full, or empty.
SCREE_VECTOR_CLONES
int settled_sum(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
                const uint8_t* __restrict inner) {
  int sum = 0;
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = c[i];
    const auto signs =
        static_cast<int8_t>((own ^ c[i - 1]) | (own ^ c[i + 1]) | (own ^ c[i - step_y]) |
                            (own ^ c[i + step_y]) | (own ^ c[i - step_x]) | (own ^ c[i + step_x]));
    const auto settled = static_cast<int8_t>(own < 0 ? code_solid : code_air);
    const int8_t code = signs < 0 ? own : settled;
    // Sums of a byte, modulo 256: on the ramp that is all that there is.
    const auto ramp = static_cast<uint8_t>(127 - 6 * code);
    const auto below = static_cast<uint8_t>(code < -ramp_end ? units_per_voxel : ramp);
    const auto full = static_cast<uint8_t>(code > ramp_end ? 0 : below);
    sum += static_cast<uint8_t>(full & inner[i]);
  }
  return sum;
}

/// All ones for core voxels near the piece that touch a zero crossing, else 0.
SCREE_VECTOR_CLONES
void find_surface(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
                  const Code* __restrict piece, const uint8_t* __restrict core, uint8_t* __restrict surface) {
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = c[i];
    const auto signs =
        static_cast<int8_t>((own ^ c[i - 1]) | (own ^ c[i + 1]) | (own ^ c[i - step_y]) |
                            (own ^ c[i + step_y]) | (own ^ c[i - step_x]) | (own ^ c[i + step_x]));
    surface[i] =
        static_cast<uint8_t>((signs < 0 ? 0xFF : 0) & (piece[i] < near_surface ? 0xFF : 0) & core[i]);
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
  const ptrdiff_t step_y = window.box.size().z, step_x = step_y * window.box.size().y;
  const ptrdiff_t first = step_x + step_y + 1;
  const std::vector<uint8_t> inner = inner_mask(window.box, 1);
  const int settled = settled_sum(static_cast<ptrdiff_t>(window.codes.size()) - 2 * first, step_x, step_y,
                                  window.codes.data() + first, inner.data() + first);
  return settled - mass_of(part_of(window, window.box.grown(-1)));
}

MergePatch::MergePatch(const Window& terrain, const Window& piece)
    : box_(terrain.box), terrain_(terrain.codes), inner_(inner_mask(box_, 1)), core_(inner_mask(box_, 2)) {
  CHECK(box_ == piece.box.grown(margin));
  step_y_ = box_.size().z;
  step_x_ = step_y_ * box_.size().y;
  first_ = static_cast<size_t>(step_x_ + step_y_ + 1);
  const size_t all = terrain_.size();
  count_ = all - 2 * first_;
  before_ = mass_of(part_of(terrain, box_.grown(-1)));
  Window around(box_);
  put(piece, around);
  piece_ = std::move(around.codes);
  united_.resize(all);
  touched_.resize(all);
  shaped_.resize(all);
  unite(all, terrain_.data(), piece_.data(), shaped_.data(), touched_.data());
  united_ = shaped_;
  const auto count = static_cast<ptrdiff_t>(count_);
  fill_gaps(count, step_x_, step_y_, shaped_.data() + first_, touched_.data() + first_,
            united_.data() + first_);
  convex_.assign(all, 0);
  concave_.assign(all, 0);
  find_bends(count, step_x_, step_y_, piece_.data() + first_, united_.data() + first_,
             touched_.data() + first_, convex_.data() + first_, concave_.data() + first_);
  codes_ = united_;
  list_surface();
  single_codes_ = 3 * static_cast<MassUnits>(surface_.size());
}

MassUnits MergePatch::shape(int roundness) {
  const int size = roundness < 0 ? -roundness : roundness;
  const int curved = std::min(size, roundness_half);
  const Amounts by{static_cast<int16_t>(curved),
                   static_cast<int16_t>((size - curved) * uniform_sixteenths / 16)};
  const size_t all = terrain_.size();
  if (roundness >= 0)
    grow(all, by, united_.data(), piece_.data(), concave_.data(), shaped_.data());
  else
    shrink(all, by, united_.data(), terrain_.data(), convex_.data(), touched_.data(), shaped_.data());
  const auto count = static_cast<ptrdiff_t>(count_);
  fill_pits(count, step_x_, step_y_, shaped_.data() + first_, core_.data() + first_, codes_.data() + first_);
  return settled_sum(count, step_x_, step_y_, codes_.data() + first_, inner_.data() + first_) - before_;
}

/// Voxels of the surface near the piece, in order. Moving codes without changing their signs keeps it.
void MergePatch::list_surface() {
  std::vector<uint8_t> marks(terrain_.size() + sizeof(uint64_t), 0);
  find_surface(static_cast<ptrdiff_t>(count_), step_x_, step_y_, codes_.data() + first_,
               piece_.data() + first_, core_.data() + first_, marks.data() + first_);
  surface_.clear();
  for (size_t i = 0; i < terrain_.size(); i += sizeof(uint64_t)) {
    uint64_t eight = 0;
    std::memcpy(&eight, marks.data() + i, sizeof(eight));
    if (eight == 0) continue;
    for (size_t k = i; k < i + sizeof(eight); ++k)
      if (marks[k] != 0) surface_.push_back(static_cast<uint32_t>(k));
  }
}

/// Which voxels of the surface move first, and where these are spent the next, and the next.
void MergePatch::list_movable(int direction, Tier tier) {
  // Where filling, or rounding, lets it lie better: what is left of seams fades (measured: bench seams).
  constexpr int bent_min = 10;
  const Code near = tier == Tier::around ? near_surface : ramp_end + 1;
  movable_.clear();
  for (const uint32_t i : surface_) {
    if (piece_[i] >= near) continue;
    if (tier == Tier::bent && bend(codes_.data() + i, step_x_, step_y_) * direction > -bent_min) continue;
    movable_.push_back(i);
  }
}

/// Moves up to `count` of the movable voxels by one code each, spread evenly over all that can. Returns how
/// many it moved.
MassUnits MergePatch::move_some(int direction, MassUnits count) {
  // Deeper from 21 to −20 and not across zero, or the same outward.
  const auto can = [&](uint32_t i) {
    const int c = codes_[i] * direction;
    return c > -ramp_end && c <= ramp_end && codes_[i] != (direction > 0 ? 0 : -1);
  };
  const MassUnits able = std::ranges::count_if(movable_, can);
  const MassUnits moved = std::min(able, count);
  MassUnits due = 0;
  for (const uint32_t i : movable_) {
    if (!can(i)) continue;
    due += moved;
    if (due < able) continue;
    due -= able;
    codes_[i] = static_cast<Code>(codes_[i] - direction);
  }
  return moved;
}

/// Single units: voxels just beyond an end of the ramp move onto it, or its last step. Returns how many.
int MergePatch::move_ramp_ends(int units) {
  int moved = 0;
  for (const uint32_t i : surface_) {
    if (moved == units) break;
    const int c = codes_[i];
    if (c > ramp_end && c <= ramp_end_reach)
      codes_[i] = ramp_end;
    else if (c == -ramp_end)
      codes_[i] = -ramp_end - 1;
    else
      continue;
    ++moved;
  }
  return moved;
}

MassUnits MergePatch::place(MassUnits units) {
  constexpr int step = 6;  // units a code on the ramp
  list_surface();
  const int direction = units < 0 ? -1 : 1;
  // Rounded down: what is left is for single units, which only add.
  MassUnits steps = units < 0 ? (step - 1 - units) / step : units / step;
  MassUnits placed = 0;
  for (const Tier tier : {Tier::bent, Tier::piece, Tier::around}) {
    if (steps == 0) break;
    list_movable(direction, tier);
    const int moves_max = tier == Tier::around ? 8 : 4;  // of a voxel
    for (int move = 0; move < moves_max && steps > 0; ++move) {
      const MassUnits moved = move_some(direction, steps);
      steps -= moved;
      placed += direction * step * moved;
    }
  }
  if (units - placed > 0 && units - placed < step) placed += move_ramp_ends(static_cast<int>(units - placed));
  return placed;
}

}  // namespace scree
