#include "shared/falling/span_bodies.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "shared/base/check.h"
#include "shared/field/material_window.h"

namespace scree {

namespace {

/// So many massive bricks that hang together hold, whatever they hang on.
constexpr size_t massive_bricks_min = 64;
/// Voxels of a face of 64: what a part must lie on, and what it may carry at most, to hold as well.
constexpr int lying_voxels_min = 38;
/// Height up to which parts that lie on each other are one body: a beam of 3 m at 0.25 m, and the rest of a
/// brick in which a post meets it.
constexpr int stack_height_max = 20;

constexpr uint32_t reached = UINT32_MAX - 1;  ///< stands for a body until there are some

VoxelBox bounds(const SpanPart& part) {
  const VoxelBox box = bounds_of(part.bits);
  return {box.lo + first_voxel(part.brick), box.hi + first_voxel(part.brick)};
}

/// Columns along y that have a voxel.
int footprint(const BrickBits& bits) {
  int count = 0;
  for (uint64_t word : bits.words) {
    word |= word >> 32U;
    word |= word >> 16U;
    word |= word >> 8U;
    count += std::popcount(word & 0xFFU);
  }
  return count;
}

glm::dvec3 sum_of_places(const SpanPart& part) {
  glm::dvec3 sum(0.0);
  const VoxelCoord first = first_voxel(part.brick);
  for (size_t x = 0; x < part.bits.words.size(); ++x)
    for (uint64_t left = part.bits.words[x]; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      sum +=
          glm::dvec3(first.x + static_cast<int>(x), first.y + bit / brick_size, first.z + bit % brick_size);
    }
  return sum;
}

}  // namespace

SpanBodies::SpanBodies(const Field& field, const Palette& palette, std::span<const BrickCoord> changed,
                       size_t parts_max, const Holding* holding)
    : field_(field), palette_(palette), ground_(field), parts_max_(parts_max), holding_(holding) {
  const auto start = [&](BrickCoord brick) {
    if (brick_holds(brick)) return;
    for (uint32_t i = first_part(brick); i != SpanPart::none; i = parts_[i].next) reach(i);
  };
  for (const BrickCoord brick : changed) {
    start(brick);
    for (const BrickCoord face : brick_faces) start(brick + face);
  }
  for (size_t i = 0; i < free_.size(); ++i) expand(free_[i]);
  for (const uint32_t part : free_) connect(part);
  stack();
  make_bodies();
}

SpanBodies::Entry& SpanBodies::entry(BrickCoord brick) {
  const auto [found, is_new] = bricks_.try_emplace(brick);
  Entry& entry = found->second;
  if (!is_new) return entry;
  const Brick& codes = field_.brick(brick);
  if (&codes == &air_brick() || &codes == &solid_brick()) {
    entry.codes = &codes;
    entry.is_full = &codes == &solid_brick();
    if (entry.is_full) entry.solid = ~BrickBits{};
    return entry;
  }
  entry.own = codes;
  entry.codes = &entry.own;
  entry.solid = solid_bits(codes);
  entry.is_full = entry.solid == ~BrickBits{};
  return entry;
}

bool SpanBodies::is_ground(BrickCoord brick) {
  const auto [found, is_new] = ground_chunks_.try_emplace(chunk_of(brick), false);
  if (is_new) found->second = ground_.holds(brick);
  return found->second;
}

bool SpanBodies::is_massive(BrickCoord brick) {
  Entry& own = entry(brick);
  if (own.massive != Known::unknown) return own.massive == Known::yes;
  const auto full = [&](int x, int y, int z) { return entry(brick + BrickCoord{x, y, z}).is_full; };
  bool massive = false;
  for (int corner = 0; corner < 8 && own.is_full && !massive; ++corner) {
    const int x = (corner & 1) * 2 - 1, y = (corner & 2) - 1, z = (corner & 4) / 2 - 1;
    massive = full(x, 0, 0) && full(0, y, 0) && full(0, 0, z) && full(x, y, 0) && full(x, 0, z) &&
              full(0, y, z) && full(x, y, z);
  }
  own.massive = massive ? Known::yes : Known::no;
  return massive;
}

/// Floods massive bricks, downward first, until enough of them or ground are found.
bool SpanBodies::brick_holds(BrickCoord brick) {
  Entry& own = entry(brick);
  if (own.holds != Known::unknown) return own.holds == Known::yes;
  if (is_ground(brick)) {
    own.holds = Known::yes;
    return true;
  }
  own.holds = Known::no;
  if (!is_massive(brick)) return false;
  std::vector<BrickCoord> ahead{brick}, seen{brick};
  bool holds = false;
  while (!ahead.empty() && !holds) {
    const BrickCoord at = ahead.back();
    ahead.pop_back();
    for (const size_t face : {size_t{0}, size_t{1}, size_t{4}, size_t{5}, size_t{2}, size_t{3}}) {
      const BrickCoord next = at + brick_faces[face];
      Entry& other = entry(next);
      holds = holds || is_ground(next) || other.holds == Known::yes || seen.size() >= massive_bricks_min;
      if (holds) break;
      if (other.holds != Known::unknown || !is_massive(next)) continue;
      other.holds = Known::no;
      seen.push_back(next);
      ahead.push_back(next);
    }
  }
  for (const BrickCoord one : seen) entry(one).holds = holds ? Known::yes : Known::no;
  return holds;
}

uint32_t SpanBodies::first_part(BrickCoord brick) {
  Entry& own = entry(brick);
  if (own.divided) return own.first;
  own.divided = true;
  for (BrickBits left = own.solid; left.any();) {
    SpanPart part;
    part.brick = brick;
    part.codes = own.codes;
    part.bits = own.is_full ? own.solid : flooded(first_of(left), own.solid);
    part.voxels = part.bits.count();
    part.next = own.first;
    read_materials(part);
    left = left & ~part.bits;
    own.first = static_cast<uint32_t>(parts_.size());
    parts_.push_back(part);
  }
  return own.first;
}

void SpanBodies::read_materials(SpanPart& part) const {
  if (const auto one = one_material_of(field_, part.brick)) {
    part.density_kg_m3 = static_cast<double>(palette_.row_or_first(*one).density_kg_m3);
    part.bending_pa = static_cast<double>(palette_.row_or_first(*one).bearing.bending_pa);
    return;
  }
  const BrickRock each = materials_of(field_, part.brick);
  for (size_t x = 0; x < part.bits.words.size(); ++x)
    for (uint64_t left = part.bits.words[x]; left != 0; left &= left - 1) {
      const MaterialRow& row =
          palette_.row_or_first(each[x * 64 + static_cast<size_t>(std::countr_zero(left))]);
      part.density_kg_m3 += static_cast<double>(row.density_kg_m3) / part.voxels;
      part.bending_pa += static_cast<double>(row.bearing.bending_pa) / part.voxels;
    }
}

/// A slope's skin, or a wall's foot: what continues beyond is no wider than what it may carry.
bool SpanBodies::lies_on_what_holds(uint32_t part) {
  const BrickCoord brick = parts_[part].brick;
  const BrickBits bits = parts_[part].bits;
  const auto contact = [&](size_t face) {
    return (across(bits, face) & entry(brick + brick_faces[face]).solid).count();
  };
  for (size_t face = 0; face < brick_faces.size(); ++face)
    if (contact(face) >= lying_voxels_min && contact(face ^ 1U) < lying_voxels_min &&
        brick_holds(brick + brick_faces[face]))
      return true;
  return false;
}

void SpanBodies::reach(uint32_t number) {
  if (parts_[number].body != SpanPart::none) return;
  parts_[number].body = reached;
  const bool holds = free_.size() >= parts_max_ || brick_holds(parts_[number].brick) ||
                     lies_on_what_holds(number) ||
                     (holding_ != nullptr && holding_->holds(parts_[number].brick, parts_[number].bits));
  parts_[number].holds = holds;
  if (!holds) free_.push_back(number);
}

void SpanBodies::expand(uint32_t number) {
  for (size_t face = 0; face < brick_faces.size(); ++face) {
    const BrickBits beyond = across(parts_[number].bits, face);
    if (!beyond.any()) continue;
    for (uint32_t i = first_part(parts_[number].brick + brick_faces[face]); i != SpanPart::none;
         i = parts_[i].next)
      if ((parts_[i].bits & beyond).any()) reach(i);
  }
}

/// Each contact once: from the lower part, or from the upper one when the lower holds.
void SpanBodies::connect(uint32_t number) {
  for (size_t face = 0; face < brick_faces.size(); ++face) {
    const BrickBits beyond = across(parts_[number].bits, face);
    if (!beyond.any()) continue;
    const bool up = face % 2 == 0;
    for (uint32_t i = first_part(parts_[number].brick + brick_faces[face]); i != SpanPart::none;
         i = parts_[i].next) {
      if (!(parts_[i].bits & beyond).any() || (!up && !parts_[i].holds)) continue;
      contacts_.push_back({up ? number : i, up ? i : number, static_cast<int>(face / 2)});
    }
  }
}

/// Joins parts that lie on each other, from below.
void SpanBodies::stack() {
  stack_.resize(parts_.size());
  for (uint32_t i = 0; i < stack_.size(); ++i) stack_[i] = i;
  std::vector<SpanContact> upright;
  for (const SpanContact& contact : contacts_)
    if (contact.axis == 1 && !parts_[contact.lower].holds && !parts_[contact.upper].holds)
      upright.push_back(contact);
  std::ranges::stable_sort(upright, std::ranges::less{},
                           [&](const SpanContact& contact) { return parts_[contact.lower].brick.y; });
  std::map<uint32_t, std::pair<int, int>> heights;  // of stacks of several
  const auto height_of = [&](uint32_t root) {
    const auto found = heights.find(root);
    if (found != heights.end()) return found->second;
    const VoxelBox box = bounds(parts_[root]);
    return std::pair(box.lo.y, box.hi.y);
  };
  const auto root_of = [&](uint32_t part) {
    while (stack_[part] != part) part = stack_[part];
    return part;
  };
  for (const SpanContact& contact : upright) {
    const SpanPart &lower = parts_[contact.lower], &upper = parts_[contact.upper];
    const int both = (across(lower.bits, 2) & upper.bits).count();
    if (2 * both < std::max(footprint(lower.bits), footprint(upper.bits))) continue;
    const uint32_t a = root_of(contact.lower), b = root_of(contact.upper);
    const auto of_a = height_of(a), of_b = height_of(b);
    const std::pair all(std::min(of_a.first, of_b.first), std::max(of_a.second, of_b.second));
    if (a == b || all.second - all.first > stack_height_max) continue;
    stack_[std::max(a, b)] = std::min(a, b);
    heights[std::min(a, b)] = all;
  }
  // What holds is one body as far as it is one above the other, so that no section at its face is divided.
  std::map<std::tuple<int, int, int>, uint32_t> holding;
  for (uint32_t i = 0; i < parts_.size(); ++i)
    if (parts_[i].holds) holding.try_emplace({parts_[i].brick.x, parts_[i].brick.z, parts_[i].brick.y}, i);
  for (uint32_t i = 0; i < parts_.size(); ++i) {
    if (!parts_[i].holds) continue;
    const BrickCoord brick = parts_[i].brick;
    for (const int y : {brick.y, brick.y - 1}) {
      const auto found = holding.find({brick.x, brick.z, y});
      if (found == holding.end()) continue;
      const uint32_t a = root_of(i), b = root_of(found->second);
      stack_[std::max(a, b)] = std::min(a, b);
    }
  }
  for (uint32_t i = 0; i < stack_.size(); ++i) stack_[i] = root_of(i);
}

void SpanBodies::make_bodies() {
  const auto enter = [&](uint32_t number) {
    SpanPart& first = parts_[stack_[number]];
    if (first.body == reached) {
      first.body = static_cast<uint32_t>(bodies_.size());
      bodies_.push_back({});
      bodies_.back().holds = first.holds;
      bodies_.back().is_massive = first.holds;
    }
    parts_[number].body = first.body;
    SpanBody& body = bodies_[first.body];
    body.parts.push_back(number);
    body.centre += sum_of_places(parts_[number]);
    body.voxels += parts_[number].voxels;
    body.is_massive = body.is_massive && parts_[number].voxels == brick_voxels;
  };
  for (const uint32_t number : free_) enter(number);
  for (uint32_t number = 0; number < parts_.size(); ++number)
    if (parts_[number].holds) enter(number);
  for (SpanBody& body : bodies_) body.centre /= static_cast<double>(body.voxels);
  std::erase_if(contacts_, [&](const SpanContact& contact) {
    return parts_[contact.lower].body == parts_[contact.upper].body;
  });
}

}  // namespace scree
