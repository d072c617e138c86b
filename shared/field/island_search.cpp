#include "shared/field/island_search.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

IslandSearch::IslandSearch(Field& field, std::span<const BrickCoord> changed)
    : field_(field), ground_(field) {
  sites_.reserve(changed.size() * 4);
  start(changed);
}

IslandSearch::Site& IslandSearch::site(BrickCoord brick) {
  const auto [found, is_new] = sites_.try_emplace(brick);
  if (is_new) found->second.solid = solid_bits(field_.brick(brick));
  return found->second;
}

BrickBits IslandSearch::taken(const Site& site) const {
  BrickBits all;
  for (uint32_t i = site.first; i != none; i = parts_[i].next) all = all | parts_[i].bits;
  return all;
}

/// A flood from each component, within the brick, of what is solid `among` these voxels.
void IslandSearch::seed(BrickCoord brick, BrickBits among) {
  const Site& here = site(brick);
  for (among = among & here.solid & ~taken(here); among.any();) {
    const BrickBits bits = flooded(first_of(among), here.solid);
    const auto flood = static_cast<uint32_t>(floods_.size());
    floods_.push_back({flood, Verdict::open, brick, brick, {}});
    open_.push_back(flood);
    add_part(brick, bits, flood);
    among = among & ~bits;
  }
}

void IslandSearch::start(std::span<const BrickCoord> changed) {
  for (const BrickCoord brick : changed) {
    const BrickBits solid = site(brick).solid;
    seed(brick, solid);
    for (size_t face = 0; face < brick_faces.size(); ++face) {
      const BrickBits bared = across(~solid, face);  // what may have leant on the brick through this face
      if (bared.any()) seed(brick + brick_faces[face], bared);
    }
  }
}

bool IslandSearch::is_later(uint32_t a, uint32_t b) const {
  const auto key = [&](uint32_t part) {
    const BrickCoord& at = parts_[part].brick;
    return std::tuple(at.y, at.x, at.z, part);
  };
  return key(a) > key(b);
}

uint32_t IslandSearch::root(uint32_t flood) const {
  while (floods_[flood].parent != flood) flood = floods_[flood].parent;
  return flood;
}

void IslandSearch::add_part(BrickCoord brick, const BrickBits& bits, uint32_t flood) {
  Site& here = site(brick);
  const auto part = static_cast<uint32_t>(parts_.size());
  parts_.push_back({brick, bits, flood, here.first});
  here.first = part;
  Flood& into = floods_[flood];
  into.lo = {std::min(into.lo.x, brick.x), std::min(into.lo.y, brick.y), std::min(into.lo.z, brick.z)};
  into.hi = {std::max(into.hi.x, brick.x), std::max(into.hi.y, brick.y), std::max(into.hi.z, brick.z)};
  into.ahead.push_back(part);
  std::ranges::push_heap(into.ahead, [this](uint32_t a, uint32_t b) { return is_later(a, b); });
  const BrickCoord reach = into.hi - into.lo;
  if (std::max({reach.x, reach.y, reach.z}) >= limits::island_side_max_bricks) into.verdict = Verdict::ground;
}

/// Two floods met: they are one. Returns it.
uint32_t IslandSearch::unite(uint32_t a, uint32_t b) {
  a = root(a);
  b = root(b);
  if (a == b) return a;
  if (floods_[a].ahead.size() < floods_[b].ahead.size()) std::swap(a, b);
  Flood& into = floods_[a];
  Flood& from = floods_[b];
  CHECK(into.verdict != Verdict::island &&
        from.verdict != Verdict::island);  // those have nothing left to meet
  from.parent = a;
  into.lo = {std::min(into.lo.x, from.lo.x), std::min(into.lo.y, from.lo.y), std::min(into.lo.z, from.lo.z)};
  into.hi = {std::max(into.hi.x, from.hi.x), std::max(into.hi.y, from.hi.y), std::max(into.hi.z, from.hi.z)};
  for (const uint32_t part : from.ahead) {
    into.ahead.push_back(part);
    std::ranges::push_heap(into.ahead, [this](uint32_t x, uint32_t y) { return is_later(x, y); });
  }
  from.ahead = {};
  const BrickCoord reach = into.hi - into.lo;
  if (from.verdict == Verdict::ground ||
      std::max({reach.x, reach.y, reach.z}) >= limits::island_side_max_bricks)
    into.verdict = Verdict::ground;
  return a;
}

void IslandSearch::cross(uint32_t part, size_t face) {
  BrickBits reached = across(parts_[part].bits, face);
  if (!reached.any()) return;
  const BrickCoord beyond = parts_[part].brick + brick_faces[face];
  uint32_t flood = root(parts_[part].flood);
  if (ground_.holds(beyond)) {
    floods_[flood].verdict = Verdict::ground;
    return;
  }
  const Site& there = site(beyond);
  reached = reached & there.solid;
  for (uint32_t i = there.first; i != none; i = parts_[i].next) {
    if (!(parts_[i].bits & reached).any()) continue;
    flood = unite(flood, parts_[i].flood);
    reached = reached & ~parts_[i].bits;
  }
  if (reached.any()) add_part(beyond, flooded(reached, there.solid), flood);
}

void IslandSearch::grow(uint32_t flood) {
  Flood& growing = floods_[flood];
  std::ranges::pop_heap(growing.ahead, [this](uint32_t a, uint32_t b) { return is_later(a, b); });
  const uint32_t part = growing.ahead.back();
  growing.ahead.pop_back();
  if (ground_.holds(parts_[part].brick)) growing.verdict = Verdict::ground;
  for (size_t face = 0; face < brick_faces.size(); ++face) {
    if (floods_[root(flood)].verdict == Verdict::ground) return;
    cross(part, face);
  }
}

bool IslandSearch::advance(size_t& bricks) {
  while (!open_.empty()) {
    if (turn_ >= open_.size()) turn_ = 0;
    const uint32_t flood = open_[turn_];
    Flood& next = floods_[flood];
    if (next.parent == flood && next.verdict == Verdict::open && next.ahead.empty())
      next.verdict = Verdict::island;
    if (next.parent != flood || next.verdict != Verdict::open) {
      open_[turn_] = open_.back();
      open_.pop_back();
      continue;
    }
    if (bricks == 0) return false;
    --bricks;
    grow(flood);
    ++turn_;
  }
  return true;
}

std::vector<Island> IslandSearch::islands() const {
  struct Found {
    BrickCoord first;
    Island island;
  };
  std::map<uint32_t, Found> found;
  for (const Part& part : parts_) {
    const uint32_t flood = root(part.flood);
    if (floods_[flood].verdict != Verdict::island) continue;
    const VoxelCoord origin = first_voxel(part.brick);
    const VoxelBox inner = bounds_of(part.bits);
    const VoxelBox box{inner.lo + origin, inner.hi + origin};
    const VoxelCoord seed = origin + bounds_of(first_of(part.bits)).lo;
    const auto [entry, is_new] = found.try_emplace(flood, Found{part.brick, {box, seed, 0}});
    auto& [first, island] = entry->second;
    const VoxelBox& b = island.box;
    island.box = {{std::min(b.lo.x, box.lo.x), std::min(b.lo.y, box.lo.y), std::min(b.lo.z, box.lo.z)},
                  {std::max(b.hi.x, box.hi.x), std::max(b.hi.y, box.hi.y), std::max(b.hi.z, box.hi.z)}};
    if (part.brick < first || (part.brick == first && seed < island.seed)) {
      first = part.brick;
      island.seed = seed;
    }
    island.voxels += part.bits.count();
  }
  std::vector<Island> islands;
  for (const auto& [flood, entry] : found) islands.push_back(entry.island);
  std::ranges::sort(islands, {}, &Island::seed);
  return islands;
}

}  // namespace scree
