#include "shared/recombine/merge_patch.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "shared/base/check.h"
#include "shared/recombine/merge_kernels.h"
#include "shared/recombine/stamp.h"

namespace scree {

namespace {

namespace kernels = merge_kernels;

constexpr int roundness_half = (stamp_roundness_max + 1) / 2;
static_assert(kernels::curvature_max * roundness_half <= INT16_MAX);

/// Half a voxel over the second half of the shifts: 11/16 code each.
constexpr int uniform_sixteenths = 11;

/// Half a voxel over all shifts, where edges are kept.
constexpr int keeping_sixteenths = 5;

/// A voxel over all shifts, where what is brought has pores: it takes more room than the piece did.
constexpr int swelling_sixteenths = 11;

/// Codes whose occupancy is a ramp: ±21. Those up to here can be moved onto an end of it unseen.
constexpr int ramp_end = 21;
constexpr int ramp_end_reach = 30;

uint64_t eight_marks(const uint8_t* marks) {
  uint64_t eight = 0;
  std::memcpy(&eight, marks, sizeof(eight));
  return eight;
}

}  // namespace

MassUnits merge_gain(const Window& terrain, const Window& merged, const MergeFills& fills) {
  const VoxelCoord size = terrain.box.size();
  CHECK(terrain.box == merged.box && std::min({size.x, size.y, size.z}) >= 3);
  const ptrdiff_t step_y = size.z, step_x = step_y * size.y, first = step_x + step_y + 1;
  const size_t voxels = merged.codes.size();
  const auto count = static_cast<ptrdiff_t>(voxels) - 2 * first;
  std::vector<uint8_t> inner(voxels);
  kernels::mark_inner(size, 1, inner.data());
  if (fills.are_solid())
    return mass_of(merged) - mass_of(terrain) +
           kernels::settled_sum(count, step_x, step_y, merged.codes.data() + first, inner.data() + first) -
           kernels::inner_sum(voxels, merged.codes.data(), inner.data());
  MassUnits gain = 0;
  const auto settled_occupancy = [&](size_t i) {
    const Code own = merged.codes[i];
    if (inner[i] == 0) return occupancy(own);
    const bool crosses = kernels::crossing_signs(merged.codes.data() + i, step_x, step_y) < 0;
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
      all_(kernels::whole_vectors(voxels_ + kernels::vector_bytes - 1)),
      first_(static_cast<size_t>(step_x_ + step_y_ + 1)),
      count_(kernels::whole_vectors(voxels_ - 2 * first_)),
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
  kernels::mark_inner(box_.size(), 1, inner_);
  kernels::mark_inner(box_.size(), 2, core_);
  enter_fills(fills);
  before_ = fill_room_.empty() ? kernels::inner_sum(all_, terrain_, inner_)
                               : kernels::filled_sum(all_, terrain_, were_, inner_);
  const VoxelCoord size = piece.box.size();
  const Code* row = piece.codes.data();
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y, row += size.z)
      std::memcpy(piece_ + (x + margin) * step_x_ + (y + margin) * step_y_ + margin, row,
                  static_cast<size_t>(size.z));
  kernels::unite(all_, terrain_, piece_, shaped_, touched_);
  std::memcpy(united_, shaped_, all_);
  const auto count = static_cast<ptrdiff_t>(count_);
  kernels::fill_gaps(count, step_x_, step_y_, shaped_ + first_, touched_ + first_, united_ + first_);
  kernels::find_bends(count, step_x_, step_y_, piece_ + first_, united_ + first_, touched_ + first_,
                      convex_ + first_, concave_ + first_);
  std::memcpy(codes_, united_, all_);
  mark_surface();
  single_codes_ = MassUnits{3} * kernels::count_marks(all_, marks_) * fill_ / fill_solid;
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
  if (fill_room_.empty())
    return kernels::settled_sum(count, step_x_, step_y_, codes_ + first_, inner_ + first_);
  return kernels::settled_mass(count, step_x_, step_y_, codes_ + first_, terrain_ + first_, were_ + first_,
                               brought_ + first_, inner_ + first_);
}

MassUnits MergePatch::shape(int roundness) {
  const int size = roundness < 0 ? -roundness : roundness;
  CHECK(size <= stamp_roundness_max + 1);
  const int curved = edges_ == Edges::round ? std::min(size, roundness_half) : 0;
  const kernels::Amounts by{
      static_cast<int16_t>(curved),
      static_cast<int16_t>(edges_ == Edges::round
                               ? (size - curved) * uniform_sixteenths / 16
                               : size * (fill_ == fill_solid ? keeping_sixteenths : swelling_sixteenths) /
                                     16)};
  if (roundness >= 0)
    kernels::grow(all_, by, united_, piece_, concave_, shaped_);
  else
    kernels::shrink(all_, by, united_, terrain_, convex_, touched_, shaped_);
  const auto count = static_cast<ptrdiff_t>(count_);
  kernels::fill_pits(count, step_x_, step_y_, shaped_ + first_, core_ + first_, codes_ + first_);
  return mass() - before_;
}

void MergePatch::mark_surface() {
  kernels::find_surface(static_cast<ptrdiff_t>(count_), step_x_, step_y_, codes_ + first_, piece_ + first_,
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
  const Code near = tier == Tier::around ? kernels::near_surface : ramp_end + 1;
  movable_.clear();
  for (const uint32_t i : surface_) {
    if (piece_[i] >= near) continue;
    if (tier == Tier::bent && kernels::bend(codes_ + i, step_x_, step_y_) * direction > -bent_min) continue;
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
