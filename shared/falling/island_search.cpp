#include "shared/falling/island_search.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

/// The face of brick_faces that looks down.
constexpr size_t face_down = 3;
static_assert(brick_faces[face_down] == BrickCoord{0, -1, 0});

/// An island's bounds, and the blocks that it is cut into.
class BlockGrid {
 public:
  void add(BrickCoord brick) {
    if (empty_) lo_ = hi_ = brick;
    empty_ = false;
    lo_ = {std::min(lo_.x, brick.x), std::min(lo_.y, brick.y), std::min(lo_.z, brick.z)};
    hi_ = {std::max(hi_.x, brick.x), std::max(hi_.y, brick.y), std::max(hi_.z, brick.z)};
  }
  void divide(const BlockLimits& limits) {
    CHECK(limits.side_bricks > 0 && limits.bricks > 0);  // or the halving would never end
    sides_ = hi_ - lo_ + BrickCoord{1, 1, 1};
    for (;;) {
      int& longest = sides_.x >= std::max(sides_.y, sides_.z) ? sides_.x
                     : sides_.y >= sides_.z                   ? sides_.y
                                                              : sides_.z;
      if (longest <= limits.side_bricks && sides_.x * sides_.y * sides_.z <= limits.bricks) return;
      longest = (longest + 1) / 2;
    }
  }
  /// The block of a brick. Bricks next to the island may get the number of a block, too.
  BrickCoord block(BrickCoord brick) const {
    const BrickCoord at = brick - lo_;
    return {at.x / sides_.x, at.y / sides_.y, at.z / sides_.z};
  }

 private:
  bool empty_ = true;
  BrickCoord lo_, hi_, sides_;
};

/// An island, as its parts are told one by one.
struct Found {
  Island island;
  BrickCoord first;

  void add(BrickCoord brick, const BrickBits& bits) {
    const VoxelCoord origin = first_voxel(brick);
    const VoxelBox inner = bounds_of(bits);
    const VoxelBox box{inner.lo + origin, inner.hi + origin};
    const VoxelCoord start = origin + bounds_of(first_of(bits)).lo;
    const bool is_new = island.voxels == 0;
    const VoxelBox& b = is_new ? box : island.box;
    island.box = {{std::min(b.lo.x, box.lo.x), std::min(b.lo.y, box.lo.y), std::min(b.lo.z, box.lo.z)},
                  {std::max(b.hi.x, box.hi.x), std::max(b.hi.y, box.hi.y), std::max(b.hi.z, box.hi.z)}};
    if (is_new || brick < first || (brick == first && start < island.start)) {
      first = brick;
      island.start = start;
    }
    island.voxels += bits.count();
    CHECK_DEBUG(island.box.holds(island.start));
  }
};

}  // namespace

IslandSearch::IslandSearch(Field& field, std::span<const BrickCoord> changed, const SearchLimits& limits)
    : field_(field), ground_(field), limits_(limits) {
  sites_.reserve(changed.size() * 4);
  begin(changed);
}

IslandSearch::Site& IslandSearch::site(BrickCoord brick) {
  const auto [found, is_new] = sites_.try_emplace(brick);
  if (!is_new) return found->second;
  ++read_;
  const ChunkCoord chunk = chunk_of(brick);
  if (!field_.has_edits(chunk) && chunks_.insert(chunk).second && ground_.may_hold_surface(chunk))
    read_ += limits_.bricks_per_chunk;
  found->second.solid = solid_bits(field_.brick(brick));
  return found->second;
}

BrickBits IslandSearch::claimed_bits(const Site& site) const {
  BrickBits all;
  for (uint32_t i = site.first; i != none; i = parts_[i].next) all = all | parts_[i].bits;
  return all;
}

/// Starts a flood from each component of the brick that has solid voxels `among` these.
void IslandSearch::add_floods(BrickCoord brick, BrickBits among) {
  const Site& here = site(brick);
  for (among = among & here.solid & ~claimed_bits(here); among.any();) {
    const BrickBits bits = flooded(first_of(among), here.solid);
    CHECK_DEBUG(bits.any());
    const auto flood = static_cast<uint32_t>(floods_.size());
    floods_.push_back({flood, Verdict::open, 0, {}, {}});
    open_.push_back(flood);
    add_part(brick, bits, flood);
    among = among & ~bits;
  }
}

void IslandSearch::begin(std::span<const BrickCoord> changed) {
  for (const BrickCoord brick : changed) {
    const BrickBits solid = site(brick).solid;
    add_floods(brick, solid);
    for (size_t face = 0; face < brick_faces.size(); ++face) {
      const BrickBits bared = across(~solid, face);  // voxels that the brick may have held through this face
      if (bared.any()) add_floods(brick + brick_faces[face], bared);
    }
  }
}

bool IslandSearch::knows(std::span<const BrickCoord> bricks) const {
  CHECK(open_.empty());
  const auto is_claimed = [&](BrickCoord brick, const BrickBits& among) {
    const auto found = sites_.find(brick);
    return found != sites_.end() && !(among & found->second.solid & ~claimed_bits(found->second)).any();
  };
  return std::ranges::all_of(bricks, [&](BrickCoord brick) {
    const auto here = sites_.find(brick);
    if (here == sites_.end() || !is_claimed(brick, here->second.solid)) return false;
    for (size_t face = 0; face < brick_faces.size(); ++face) {
      const BrickBits bared = across(~here->second.solid, face);
      if (bared.any() && !is_claimed(brick + brick_faces[face], bared)) return false;
    }
    return true;
  });
}

bool IslandSearch::is_later(uint32_t a, uint32_t b) const {
  const auto key = [&](uint32_t part) {
    const BrickCoord& at = parts_[part].brick;
    return std::tuple(at.y, at.x, at.z, part);
  };
  return key(a) > key(b);
}

void IslandSearch::push(std::vector<uint32_t>& heap, uint32_t part) const {
  heap.push_back(part);
  std::ranges::push_heap(heap, [this](uint32_t a, uint32_t b) { return is_later(a, b); });
}

uint32_t IslandSearch::pop(std::vector<uint32_t>& heap) const {
  std::ranges::pop_heap(heap, [this](uint32_t a, uint32_t b) { return is_later(a, b); });
  const uint32_t part = heap.back();
  heap.pop_back();
  return part;
}

uint32_t IslandSearch::root(uint32_t flood) const {
  CHECK_DEBUG(flood < floods_.size());
  while (floods_[flood].parent != flood) flood = floods_[flood].parent;
  return flood;
}

void IslandSearch::add_part(BrickCoord brick, const BrickBits& bits, uint32_t flood) {
  Site& here = site(brick);
  CHECK_DEBUG(bits.any() && !(bits & ~here.solid).any() && !(bits & claimed_bits(here)).any());
  const auto part = static_cast<uint32_t>(parts_.size());
  parts_.push_back({brick, bits, flood, here.first});
  here.first = part;
  Flood& into = floods_[flood];
  push(into.ahead, part);
  if (++into.parts > limits_.parts_max) into.verdict = Verdict::too_large;
  if (limits_.holding != nullptr && limits_.holding->holds(brick, bits)) into.verdict = Verdict::ground;
}

/// Makes one flood of two that met. Returns it.
uint32_t IslandSearch::unite(uint32_t a, uint32_t b) {
  a = root(a);
  b = root(b);
  if (a == b) return a;
  if (floods_[a].parts < floods_[b].parts) std::swap(a, b);
  Flood& into = floods_[a];
  Flood& from = floods_[b];
  CHECK(into.verdict != Verdict::island &&
        from.verdict != Verdict::island);  // those have nothing left to meet
  from.parent = a;
  for (const uint32_t part : std::exchange(from.ahead, {})) push(into.ahead, part);
  for (const uint32_t part : std::exchange(from.aside, {})) push(into.aside, part);
  into.parts += from.parts;
  if (from.verdict != Verdict::open && into.verdict != Verdict::ground) into.verdict = from.verdict;
  if (into.verdict == Verdict::open && into.parts > limits_.parts_max) into.verdict = Verdict::too_large;
  return a;
}

void IslandSearch::cross(uint32_t part, size_t face) {
  parts_[part].crossed = static_cast<uint8_t>(parts_[part].crossed | (1U << face));
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
  CHECK_DEBUG(growing.parent == flood && !(growing.ahead.empty() && growing.aside.empty()));
  const bool down = !growing.ahead.empty();
  const uint32_t part = pop(down ? growing.ahead : growing.aside);
  if (down) push(growing.aside, part);
  const BrickCoord brick = parts_[part].brick;
  if (down && ground_.holds(brick)) growing.verdict = Verdict::ground;
  for (size_t face = 0; face < brick_faces.size(); ++face) {
    if (floods_[root(flood)].verdict != Verdict::open) return;
    if (((parts_[part].crossed >> face) & 1U) != 0) continue;
    if (!down || face == face_down || sites_.contains(brick + brick_faces[face])) cross(part, face);
  }
}

bool IslandSearch::advance(size_t& bricks) {
  while (!open_.empty()) {
    if (turn_ >= open_.size()) turn_ = 0;
    const uint32_t flood = open_[turn_];
    Flood& next = floods_[flood];
    if (next.parent == flood && next.verdict == Verdict::open && next.ahead.empty() && next.aside.empty())
      next.verdict = Verdict::island;
    if (next.parent != flood || next.verdict != Verdict::open) {
      open_[turn_] = open_.back();
      open_.pop_back();
      continue;
    }
    if (bricks == 0) return false;
    const size_t before = read_;
    grow(flood);
    bricks -= std::min(bricks, std::max<size_t>(1, read_ - before));
    ++turn_;
  }
  return true;
}

size_t IslandSearch::too_large() const {
  return static_cast<size_t>(std::ranges::count_if(floods_, [this](const Flood& flood) {
    return flood.verdict == Verdict::too_large && &floods_[flood.parent] == &flood;
  }));
}

std::vector<uint32_t> IslandSearch::parts_of_islands() const {
  std::vector<uint32_t> found;
  for (uint32_t part = 0; part < parts_.size(); ++part)
    if (floods_[root(parts_[part].flood)].verdict == Verdict::island) found.push_back(part);
  return found;
}

std::vector<Island> IslandSearch::islands(const BlockLimits& limits) const {
  CHECK(open_.empty());  // the search is finished
  const std::vector<uint32_t> parts = parts_of_islands();
  std::map<uint32_t, BlockGrid> grids;  // by flood
  for (const uint32_t part : parts) grids[root(parts_[part].flood)].add(parts_[part].brick);
  for (auto& [flood, grid] : grids) grid.divide(limits);
  // Parts that connect within a block have the same group: the first of them.
  std::vector<uint32_t> groups(parts_.size());
  std::iota(groups.begin(), groups.end(), 0U);
  const auto group = [&](uint32_t part) {
    while (groups[part] != part) part = groups[part] = groups[groups[part]];
    return part;
  };
  for (const uint32_t part : parts) {
    const BrickCoord brick = parts_[part].brick;
    const BlockGrid& grid = grids.at(root(parts_[part].flood));
    for (size_t face = 0; face < brick_faces.size(); face += 2) {
      const auto beyond = sites_.find(brick + brick_faces[face]);
      if (beyond == sites_.end() || grid.block(brick) != grid.block(beyond->first)) continue;
      const BrickBits reached = across(parts_[part].bits, face);
      for (uint32_t i = beyond->second.first; i != none; i = parts_[i].next)
        if ((parts_[i].bits & reached).any())
          groups[std::max(group(part), group(i))] = std::min(group(part), group(i));
    }
  }
  std::map<uint32_t, Found> found;
  for (const uint32_t part : parts) found[group(part)].add(parts_[part].brick, parts_[part].bits);
  std::vector<Island> islands;
  for (const auto& [first, entry] : found) islands.push_back(entry.island);
  std::ranges::sort(islands, {}, &Island::start);
  return islands;
}

}  // namespace scree
