#include "shared/recombine/merge_patch.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/occupancy_byte.h"
#include "shared/recombine/stamp.h"

namespace scree {

namespace {

constexpr int roundness_half = (stamp_roundness_max + 1) / 2;

/// Edges and clefts give way by an eighth of the sum of the six differences at the most: 2^-8 a shift.
constexpr int curvature_bits = 8;
constexpr int curvature_max = 1016;
static_assert(curvature_max * roundness_half <= INT16_MAX);

/// Half a voxel over the second half of the shifts: 11/16 code each.
constexpr int uniform_sixteenths = 11;

/// Half a voxel over all shifts, where edges are kept.
constexpr int keeping_sixteenths = 5;

/// A voxel over all shifts, where what is brought has pores: it takes more room than the piece did.
constexpr int swelling_sixteenths = 11;

/// A voxel farther than this from the piece's surface has no part in its edges or clefts.
constexpr int near_surface = 64;

/// Codes whose occupancy is a ramp: ±21. Those up to here can be moved onto an end of it unseen.
constexpr int ramp_end = 21;
constexpr int ramp_end_reach = 30;

/// The longest vectors of a clone. Loops take whole ones: the rest would be done voxel by voxel, and a window
/// is some fifty vectors.
constexpr size_t vector_bytes = 32;

constexpr size_t whole_vectors(size_t bytes) {
  return (bytes + vector_bytes - 1) / vector_bytes * vector_bytes;
}

uint64_t eight_marks(const uint8_t* marks) {
  uint64_t eight = 0;
  std::memcpy(&eight, marks, sizeof(eight));
  return eight;
}

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

/// Outside voxels next to changed ones that lie in a gap of less than a voxel, between rock on both
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
    // Twice: the rest of a seam must close before the surface moves (measured: bench seams).
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

/// Fills voxels just outside, near the piece, that lie between rock along two axes or all three: the rest of
/// a seam.
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
    // Not below zero, and below `shallow`, by signs alone: comparisons became branches, four times as slow.
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
    const int8_t signs = crossing_signs(c + i, step_x, step_y);
    const auto settled = static_cast<int8_t>(own < 0 ? code_solid : code_air);
    const int8_t code = signs < 0 ? own : settled;
    sum += static_cast<uint8_t>(occupancy_byte(code) & inner[i]);
  }
  return sum;
}

/// The same of voxels that have pores (MergeFills), as mass.
SCREE_VECTOR_CLONES
int settled_mass(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
                 const Code* __restrict terrain, const uint8_t* __restrict were,
                 const uint8_t* __restrict brought, const uint8_t* __restrict inner) {
  int sum = 0;
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = c[i], was = terrain[i];
    const int8_t signs = crossing_signs(c + i, step_x, step_y);
    const auto settled = static_cast<int8_t>(own < 0 ? code_solid : code_air);
    const uint8_t is = occupancy_byte(signs < 0 ? own : settled);
    const auto stays = static_cast<uint8_t>((was < 0 ? 0xFF : 0) | (is == occupancy_byte(was) ? 0xFF : 0));
    const auto fill = static_cast<uint8_t>((were[i] & stays) | (brought[i] & ~stays));
    sum += static_cast<uint8_t>(mass_in_voxel(is, fill) & inner[i]);
  }
  return sum;
}

/// Σ mass of the inner voxels, of these fills.
SCREE_VECTOR_CLONES
int filled_sum(size_t count, const Code* __restrict codes, const uint8_t* __restrict fills,
               const uint8_t* __restrict inner) {
  int sum = 0;
  for (size_t i = 0; i < count; ++i)
    sum += static_cast<uint8_t>(mass_in_voxel(occupancy_byte(codes[i]), fills[i]) & inner[i]);
  return sum;
}

/// All ones for core voxels near the piece that touch a zero crossing, else 0.
SCREE_VECTOR_CLONES
void find_surface(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
                  const Code* __restrict piece, const uint8_t* __restrict core, uint8_t* __restrict surface) {
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t signs = crossing_signs(c + i, step_x, step_y);
    surface[i] =
        static_cast<uint8_t>((signs < 0 ? 0xFF : 0) & (piece[i] < near_surface ? 0xFF : 0) & core[i]);
  }
}

SCREE_VECTOR_CLONES
int count_marks(size_t count, const uint8_t* __restrict marks) {
  int sum = 0;
  for (size_t i = 0; i < count; ++i) sum += marks[i] & 1;
  return sum;
}

/// Σ occupancy of the inner voxels.
SCREE_VECTOR_CLONES
int inner_sum(size_t count, const Code* __restrict codes, const uint8_t* __restrict inner) {
  int sum = 0;
  for (size_t i = 0; i < count; ++i) sum += static_cast<uint8_t>(occupancy_byte(codes[i]) & inner[i]);
  return sum;
}

/// All ones for every voxel but those of the outermost layers. The mask holds zeros.
void mark_inner(const VoxelCoord& size, int layers, uint8_t* mask) {
  const ptrdiff_t plane = static_cast<ptrdiff_t>(size.y) * size.z;
  uint8_t* first = mask + layers * plane;
  for (int y = layers; y + layers < size.y; ++y)
    std::memset(first + static_cast<ptrdiff_t>(y) * size.z + layers, 0xFF,
                static_cast<size_t>(size.z - 2 * layers));
  for (int x = layers + 1; x + layers < size.x; ++x)
    std::memcpy(mask + x * plane, first, static_cast<size_t>(plane));
}

}  // namespace

MassUnits merge_gain(const Window& terrain, const Window& merged, const MergeFills& fills) {
  const VoxelCoord size = terrain.box.size();
  CHECK(terrain.box == merged.box && std::min({size.x, size.y, size.z}) >= 3);
  const ptrdiff_t step_y = size.z, step_x = step_y * size.y, first = step_x + step_y + 1;
  const size_t voxels = merged.codes.size();
  const auto count = static_cast<ptrdiff_t>(voxels) - 2 * first;
  std::vector<uint8_t> inner(voxels);
  mark_inner(size, 1, inner.data());
  if (fills.are_solid())
    return mass_of(merged) - mass_of(terrain) +
           settled_sum(count, step_x, step_y, merged.codes.data() + first, inner.data() + first) -
           inner_sum(voxels, merged.codes.data(), inner.data());
  MassUnits gain = 0;
  const auto settled_occupancy = [&](size_t i) {
    const Code own = merged.codes[i];
    if (inner[i] == 0) return occupancy(own);
    const bool crosses = crossing_signs(merged.codes.data() + i, step_x, step_y) < 0;
    return crosses ? occupancy(own) : (own < 0 ? units_per_voxel : 0);
  };
  for (size_t i = 0; i < voxels; ++i) {
    const int is = settled_occupancy(i);
    gain += mass_in_voxel(is, fills.after(i, terrain.codes[i], is)) -
            mass_in_voxel(occupancy(terrain.codes[i]), fills.were.at(i));
  }
  return gain;
}

MergePatch::MergePatch(const Window& terrain, const Window& piece, Edges edges, const MergeFills& fills)
    : box_(terrain.box),
      edges_(edges),
      step_x_(static_cast<ptrdiff_t>(box_.size().y) * box_.size().z),
      step_y_(box_.size().z),
      voxels_(terrain.codes.size()),
      all_(whole_vectors(voxels_ + vector_bytes - 1)),
      first_(static_cast<size_t>(step_x_ + step_y_ + 1)),
      count_(whole_vectors(voxels_ - 2 * first_)),
      code_room_(5 * all_, code_air),
      byte_room_(4 * all_),
      bend_room_(2 * all_),
      terrain_(code_room_.data()),
      piece_(terrain_ + all_),
      united_(piece_ + all_),
      shaped_(united_ + all_),
      codes_(shaped_ + all_),
      touched_(byte_room_.data()),
      inner_(touched_ + all_),
      core_(inner_ + all_),
      marks_(core_ + all_),
      convex_(bend_room_.data()),
      concave_(convex_ + all_) {
  CHECK(box_ == piece.box.grown(margin) && !piece.box.empty());
  CHECK(voxels_ <= size_t{1} << 23U);  // sums of 254 units a voxel fit an int
  std::ranges::copy(terrain.codes, terrain_);
  mark_inner(box_.size(), 1, inner_);
  mark_inner(box_.size(), 2, core_);
  enter_fills(fills);
  before_ =
      fill_room_.empty() ? inner_sum(all_, terrain_, inner_) : filled_sum(all_, terrain_, were_, inner_);
  const VoxelCoord size = piece.box.size();
  const Code* row = piece.codes.data();
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y, row += size.z)
      std::memcpy(piece_ + (x + margin) * step_x_ + (y + margin) * step_y_ + margin, row,
                  static_cast<size_t>(size.z));
  unite(all_, terrain_, piece_, shaped_, touched_);
  std::memcpy(united_, shaped_, all_);
  const auto count = static_cast<ptrdiff_t>(count_);
  fill_gaps(count, step_x_, step_y_, shaped_ + first_, touched_ + first_, united_ + first_);
  find_bends(count, step_x_, step_y_, piece_ + first_, united_ + first_, touched_ + first_, convex_ + first_,
             concave_ + first_);
  std::memcpy(codes_, united_, all_);
  mark_surface();
  single_codes_ = MassUnits{3} * count_marks(all_, marks_) * fill_ / fill_solid;
}

void MergePatch::enter_fills(const MergeFills& fills) {
  if (fills.are_solid()) return;
  fill_room_.assign(2 * all_, fill_solid);
  were_ = fill_room_.data();
  brought_ = were_ + all_;
  const auto enter = [&](const FillWindow& from, uint8_t* to) {
    CHECK(from.each.empty() || from.each.size() == voxels_);
    if (from.each.empty())
      std::memset(to, from.all, voxels_);
    else
      std::memcpy(to, from.each.data(), voxels_);
  };
  enter(fills.were, were_);
  enter(fills.brought, brought_);
  fill_ = *std::min_element(brought_, brought_ + voxels_);
}

/// As the patch stands, once redistanced, of the inner voxels.
MassUnits MergePatch::mass() const {
  const auto count = static_cast<ptrdiff_t>(count_);
  if (fill_room_.empty()) return settled_sum(count, step_x_, step_y_, codes_ + first_, inner_ + first_);
  return settled_mass(count, step_x_, step_y_, codes_ + first_, terrain_ + first_, were_ + first_,
                      brought_ + first_, inner_ + first_);
}

MassUnits MergePatch::shape(int roundness) {
  const int size = roundness < 0 ? -roundness : roundness;
  CHECK(size <= stamp_roundness_max + 1);
  const int curved = edges_ == Edges::round ? std::min(size, roundness_half) : 0;
  const Amounts by{static_cast<int16_t>(curved),
                   static_cast<int16_t>(
                       edges_ == Edges::round
                           ? (size - curved) * uniform_sixteenths / 16
                           : size * (fill_ == fill_solid ? keeping_sixteenths : swelling_sixteenths) / 16)};
  if (roundness >= 0)
    grow(all_, by, united_, piece_, concave_, shaped_);
  else
    shrink(all_, by, united_, terrain_, convex_, touched_, shaped_);
  const auto count = static_cast<ptrdiff_t>(count_);
  fill_pits(count, step_x_, step_y_, shaped_ + first_, core_ + first_, codes_ + first_);
  return mass() - before_;
}

void MergePatch::mark_surface() {
  find_surface(static_cast<ptrdiff_t>(count_), step_x_, step_y_, codes_ + first_, piece_ + first_,
               core_ + first_, marks_ + first_);
}

/// Voxels of the surface near the piece, in order. Moving codes without changing their signs keeps it.
void MergePatch::list_surface() {
  mark_surface();
  surface_.clear();
  for (size_t i = 0; i < all_; i += sizeof(uint64_t))
    for (uint64_t eight = eight_marks(marks_ + i); eight != 0;) {
      const auto bit = static_cast<unsigned>(std::countr_zero(eight));
      surface_.push_back(static_cast<uint32_t>(i + bit / 8));
      eight &= ~(uint64_t{0xFF} << bit);
    }
}

/// Lists the voxels of the surface that a tier moves.
void MergePatch::list_movable(int direction, Tier tier) {
  // Clefts are filled and edges rounded first, so that the rest of a seam fades (measured: bench seams).
  constexpr int bent_min = 10;
  const Code near = tier == Tier::around ? near_surface : ramp_end + 1;
  movable_.clear();
  for (const uint32_t i : surface_) {
    if (piece_[i] >= near) continue;
    if (tier == Tier::bent && bend(codes_ + i, step_x_, step_y_) * direction > -bent_min) continue;
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
  CHECK(due == 0);  // exactly `moved` voxels were moved
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

MassUnits MergePatch::place_steps(MassUnits units) {
  constexpr int step = 6;  // units a code on the ramp
  list_surface();
  const int direction = units < 0 ? -1 : 1;
  // Rounded down: the rest is met by single units, which only add.
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
  CHECK(units < 0 ? placed > units - step : placed <= units);
  return placed;
}

MassUnits MergePatch::place(MassUnits units) {
  if (fill_room_.empty()) return place_steps(units);
  // A step weighs what its voxel's material fills, so the steps are counted again after they were taken. What
  // is too much goes at last.
  constexpr int rounds_max = 8, rounds_up = 4;
  constexpr MassUnits near_enough = 4;
  const MassUnits start = mass(), wanted = start + units;
  for (int round = 0; round < rounds_max; ++round) {
    const MassUnits left = wanted - mass();
    if (left >= 0 && (left <= near_enough || round >= rounds_up)) break;
    if (place_steps(left < 0 ? left : left * fill_solid / std::max(fill_, 1)) == 0) break;
  }
  return mass() - start;
}

}  // namespace scree
