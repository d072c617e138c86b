#include "shared/recombine/specks.h"

#include <algorithm>
#include <map>
#include <utility>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/falling/island.h"
#include "shared/field/brick_bits.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

bool is_solid(Field& field, VoxelCoord v) {
  return field.brick(brick_of(v)).codes[static_cast<size_t>(Brick::index(v.x & 7, v.y & 7, v.z & 7))] < 0;
}

/// The voxels that connect to one, in the order in which they were found; of a component too large for a
/// speck, the first speck_voxels_max + 1.
std::vector<VoxelCoord> connected(Field& field, VoxelCoord from) {
  std::vector<VoxelCoord> found{from};
  for (size_t i = 0; i < found.size(); ++i)
    for (const BrickCoord& face : brick_faces) {
      const VoxelCoord next = found[i] + VoxelCoord{face.x, face.y, face.z};
      if (!is_solid(field, next) || std::ranges::find(found, next) != found.end()) continue;
      found.push_back(next);
      if (found.size() > static_cast<size_t>(speck_voxels_max)) return found;
    }
  return found;
}

Island island_of(const std::vector<VoxelCoord>& voxels) {
  const VoxelCoord one{1, 1, 1};
  Island island{{voxels.front(), voxels.front() + one}, *std::ranges::min_element(voxels), 0};
  for (const VoxelCoord& v : voxels) {
    VoxelBox& box = island.box;
    box.lo = {std::min(box.lo.x, v.x), std::min(box.lo.y, v.y), std::min(box.lo.z, v.z)};
    box.hi = {std::max(box.hi.x, v.x + 1), std::max(box.hi.y, v.y + 1), std::max(box.hi.z, v.z + 1)};
  }
  island.voxels = static_cast<int64_t>(voxels.size());
  return island;
}

/// Components small enough for specks, by their first voxels.
using Candidates = std::map<VoxelCoord, std::vector<VoxelCoord>>;

/// The mass that the terrain would lose with the component, or a little more: that of its voxels, and of what
/// is no rock around them.
MassUnits weight_at_most(Field& field, const VoxelBox& box, const std::vector<VoxelCoord>& voxels) {
  const Window around = gather(field, box.grown(1));
  MassUnits mass = 0;
  for (const VoxelCoord v : voxels) mass += occupancy(around.at(v.x, v.y, v.z));
  for (const Code code : around.codes) mass += code >= 0 ? occupancy(code) : 0;
  return mass;
}

/// Whether the component weighs less than a piece. Lifting it tells, but takes a hundred times as long as a
/// bound does, which suffices for nearly all.
bool is_speck(Field& field, const Island& island, const std::vector<VoxelCoord>& voxels) {
  if (weight_at_most(field, island.box, voxels) < limits::piece_mass_min) return true;
  Window window = gather(field, lift_box(island.box));
  return lift(window, island.box, island.start).mass < limits::piece_mass_min;
}

/// The voxels whose six neighbours are solid, too, inside the brick. Such a group of seven weighs more than a
/// speck anywhere, as no other solid lies nearer to it than across an edge.
BrickBits interior(const BrickBits& solid) {
  constexpr uint64_t inner_z = 0x7E7E7E7E7E7E7E7EULL;
  BrickBits bits;
  for (size_t x = 1; x + 1 < solid.words.size(); ++x) {
    const uint64_t w = solid.words[x];
    bits.words[x] =
        w & solid.words[x - 1] & solid.words[x + 1] & (w << 8U) & (w >> 8U) & (w << 1U) & (w >> 1U) & inner_z;
  }
  return bits;
}

/// Components of the brick's solid voxels that hold one `among` these and are small within the brick.
void add_candidates(Field& field, BrickCoord brick, const BrickBits& among, Candidates& candidates) {
  const BrickBits solid = solid_bits(field.brick(brick));
  // Most of the ground at once: a flood from one voxel took four times as long.
  const BrickBits large = interior(solid);
  const BrickBits rest = large.any() ? solid & ~flooded(large, solid) : solid;
  for (BrickBits left = among & rest; left.any();) {
    const BrickBits bits = flooded(first_of(left), solid);
    left = left & ~bits;
    if (bits.count() > speck_voxels_max) continue;
    auto voxels = connected(field, first_voxel(brick) + bounds_of(first_of(bits)).lo);
    if (voxels.size() > static_cast<size_t>(speck_voxels_max)) continue;
    const VoxelCoord first = *std::ranges::min_element(voxels);
    candidates.try_emplace(first, std::move(voxels));
  }
}

}  // namespace

std::vector<Island> find_specks(Field& field, std::span<const BrickCoord> bricks) {
  CHECK(std::ranges::is_sorted(bricks));
  Candidates candidates;
  for (const BrickCoord brick : bricks) {
    const BrickBits solid = solid_bits(field.brick(brick));
    add_candidates(field, brick, solid, candidates);
    for (size_t face = 0; face < brick_faces.size(); ++face) {
      const BrickCoord beyond = brick + brick_faces[face];
      if (std::ranges::binary_search(bricks, beyond)) continue;
      const BrickBits bared = across(~solid, face);  // voxels that the brick may have held
      if (bared.any()) add_candidates(field, beyond, bared, candidates);
    }
  }
  std::vector<Island> specks;
  for (const auto& [first, voxels] : candidates) {
    const Island island = island_of(voxels);
    if (is_speck(field, island, voxels)) specks.push_back(island);
  }
  return specks;
}

}  // namespace scree
