#include "shared/recombine/slide_mass.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Codes by which a voxel of the surface may be moved in all: a quarter of a voxel.
constexpr int moves_max = 10;

/// Codes by which a voxel is moved at once, to meet the last units; and the most that this weighs.
constexpr int last_moves = 6;
constexpr int last_mass = last_moves * 6;

bool is_crossing(const Window& window, size_t at, ptrdiff_t step_x, ptrdiff_t step_y) {
  const Code* c = &window.codes[at];
  const int own = c[0];
  return ((own ^ c[-1]) | (own ^ c[1]) | (own ^ c[-step_y]) | (own ^ c[step_y]) | (own ^ c[-step_x]) |
          (own ^ c[step_x])) < 0;
}

/// Whether moving that code keeps its side.
bool keeps_side(int code, int by) {
  const int moved = code + by;
  return (code < 0) == (moved < 0) && moved <= 127 && moved >= -127;
}

}  // namespace

SlideMass::SlideMass(const MaterialReader& were, const RubbleRows& rows, const Window& before,
                     Material material, const std::vector<uint8_t>& near)
    : were_(were), rows_(rows), before_(before), material_(material), near_(near) {
  const VoxelCoord size = before.box.size();
  CHECK(were.box() == before.box);
  CHECK_EQ(near.size(), static_cast<size_t>(size.x) * static_cast<size_t>(size.z));
}

int SlideMass::mass(int code, Material material) const {
  return mass_in_voxel(occupancy(code), rows_.fill[row_number(material)]);
}

/// f(voxel, its place) for each inner voxel of the columns in question.
template <typename F>
void SlideMass::for_each_near(F&& f) const {
  const VoxelBox& box = before_.box;
  const VoxelCoord size = box.size();
  for (int x = 1; x + 1 < size.x; ++x)
    for (int y = 1; y + 1 < size.y; ++y) {
      const size_t row = before_.index(box.lo.x + x, box.lo.y + y, box.lo.z);
      const uint8_t* near = &near_[static_cast<size_t>(x) * static_cast<size_t>(size.z)];
      for (int z = 1; z + 1 < size.z; ++z)
        if (near[z] != 0)
          f(VoxelCoord{box.lo.x + x, box.lo.y + y, box.lo.z + z}, row + static_cast<size_t>(z));
    }
}

Material SlideMass::is_of(VoxelCoord voxel, size_t at) const {
  return becomes_[at] != ground_own ? material_of(becomes_[at]) : were_.at(voxel);
}

void SlideMass::assign(const Window& after) {
  becomes_.assign(after.codes.size(), ground_own);
  Gains converted{};
  std::vector<Open> open;
  for_each_near([&](VoxelCoord voxel, size_t at) {
    const int had = occupancy(before_.codes[at]), has = occupancy(after.codes[at]);
    if (had == has) return;
    const Material was = were_.at(voxel);
    if (was == material_) return;
    if (before_.codes[at] >= 0 && had == 0) {
      becomes_[at] = said(material_);
    } else if (before_.codes[at] >= 0 && has > had) {
      open.push_back({at, was, mass(before_.codes[at], was), mass(after.codes[at], was)});
    } else {
      converted[row_number(was)] += mass(after.codes[at], was) - mass(before_.codes[at], was);
    }
  });
  assign_open(open, converted);
  gains_ = gains_of(after);
  list_surface(after);
}

void SlideMass::assign_open(const std::vector<Open>& open, Gains& converted) {
  for (const Open& one : open) {
    MassUnits& sum = converted[row_number(one.was)];
    const MassUnits kept = sum + one.has - one.had, left = sum - one.had;
    const bool is_rubble = std::abs(left) <= std::abs(kept);
    if (is_rubble) becomes_[one.at] = said(material_);
    sum = is_rubble ? left : kept;
  }
}

SlideMass::Gains SlideMass::gains_of(const Window& after) const {
  Gains gains{};
  for_each_near([&](VoxelCoord voxel, size_t at) {
    const int was = before_.codes[at], is = after.codes[at];
    if (becomes_[at] == ground_own && occupancy(was) == occupancy(is)) return;
    const Material had = were_.at(voxel), has = is_of(voxel, at);
    gains[row_number(rows_.stones[row_number(had)])] -= mass(was, had);
    gains[row_number(rows_.stones[row_number(has)])] += mass(is, has);
  });
  return gains;
}

void SlideMass::list_surface(const Window& after) {
  const VoxelCoord size = after.box.size();
  const ptrdiff_t step_y = size.z, step_x = step_y * size.y;
  surface_.clear();
  for_each_near([&](VoxelCoord voxel, size_t at) {
    if (is_crossing(after, at, step_x, step_y)) surface_.push_back({at, is_of(voxel, at)});
  });
}

MassUnits SlideMass::reach_of_rubble() const {
  constexpr int usual = 6;  // a code
  const auto count = std::ranges::count_if(
      surface_, [this](Material material) { return material == material_; }, &Surface::material);
  return count * usual * rows_.fill[row_number(material_)] / fill_solid;
}

bool SlideMass::meet(Window& after) {
  for (size_t stones = 0; stones < gains_.size(); ++stones)
    if (gains_[stones] != 0 && !meet_one(after, stones)) return false;
  return true;
}

bool SlideMass::meet_one(Window& after, size_t stones) {
  const bool of_rubble = stones == row_number(rows_.stones[row_number(material_)]);
  std::vector<Surface*> movable;
  for (Surface& one : surface_)
    if (of_rubble ? one.material == material_ : row_number(rows_.stones[row_number(one.material)]) == stones)
      movable.push_back(&one);
  MassUnits wanted = -gains_[stones];
  spread(after, movable, wanted);
  return finish(after, movable, wanted);
}

/// By one code after the other, all over the surface, until few units are left.
void SlideMass::spread(Window& after, std::vector<Surface*>& movable, MassUnits& wanted) const {
  const auto few = static_cast<MassUnits>(last_mass);
  for (int move = 0; move < moves_max && std::abs(wanted) > few; ++move) {
    const int by = wanted > 0 ? -1 : 1;
    const auto gain = [&](const Surface& one) {
      const int code = after.codes[one.at];
      return keeps_side(code, by) ? mass(code + by, one.material) - mass(code, one.material) : 0;
    };
    MassUnits able = 0;
    for (const Surface* one : movable) able += std::abs(gain(*one));
    if (able == 0) return;
    const MassUnits share = std::min(able, std::abs(wanted));
    MassUnits due = 0;
    for (Surface* one : movable) {
      const MassUnits gained = gain(*one);
      due += std::abs(gained) * share;
      if (gained == 0 || due < std::abs(gained) * able) continue;
      due -= std::abs(gained) * able;
      after.codes[one->at] = static_cast<Code>(after.codes[one->at] + by);
      wanted -= gained;
    }
  }
}

/// The last units: by one voxel or two that together weigh them.
bool SlideMass::finish(Window& after, const std::vector<Surface*>& movable, MassUnits wanted) const {
  struct Move {
    size_t at = 0;
    int by = 0;
  };
  constexpr int rounds = 8;
  for (int round = 0; round < rounds; ++round) {
    if (wanted == 0) return true;
    if (std::abs(wanted) > 2 * last_mass) return false;
    std::array<std::array<std::optional<Move>, 2>, 2 * last_mass + 1> moves{};  // by what they weigh
    for (const Surface* one : movable) {
      const int code = after.codes[one->at];
      for (int by = -last_moves; by <= last_moves; ++by) {
        if (by == 0 || !keeps_side(code, by)) continue;
        const int gained = mass(code + by, one->material) - mass(code, one->material);
        auto& place = moves.at(static_cast<size_t>(gained + last_mass));
        if (!place[0])
          place[0] = Move{one->at, by};
        else if (!place[1] && place[0]->at != one->at)
          place[1] = Move{one->at, by};
      }
    }
    const auto carry_out = [&](const Move& move) {
      after.codes[move.at] = static_cast<Code>(after.codes[move.at] + move.by);
    };
    const auto of = [&](MassUnits gained, size_t which) -> const std::optional<Move>& {
      static const std::optional<Move> none;
      if (std::abs(gained) > last_mass) return none;
      return moves.at(static_cast<size_t>(gained + last_mass)).at(which);
    };
    if (const auto& one = of(wanted, 0)) {
      carry_out(*one);
      return true;
    }
    for (int first = -last_mass; first <= last_mass; ++first)
      for (size_t which = 0; which < 2; ++which) {
        const auto &one = of(first, 0), &other = of(wanted - first, which);
        if (first == 0 || !one || !other || one->at == other->at) continue;
        carry_out(*one);
        carry_out(*other);
        return true;
      }
    bool moved = false;
    for (int size = 1; size <= last_mass && !moved; ++size)
      for (const int first : {size, -size}) {
        if (size % 6 == 0 || !of(first, 0)) continue;
        carry_out(*of(first, 0));
        wanted -= first;
        moved = true;
        break;
      }
    if (!moved) return false;
  }
  return false;
}

bool SlideMass::is_met(const Window& after) const {
  return std::ranges::all_of(gains_of(after), [](MassUnits gain) { return gain == 0; });
}

int64_t SlideMass::lifted(const Window& after) const {
  int64_t sum = 0;
  for_each_near([&](VoxelCoord voxel, size_t at) {
    const int was = before_.codes[at], is = after.codes[at];
    if (becomes_[at] == ground_own && occupancy(was) == occupancy(is)) return;
    sum += int64_t{mass(is, is_of(voxel, at)) - mass(was, were_.at(voxel))} * (voxel.y - before_.box.lo.y);
  });
  return sum;
}

}  // namespace scree
