#include "shared/fracture/seeds.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/field/eight_bytes.h"
#include "shared/field/mass.h"
#include "shared/field/voxel_vector.h"

namespace scree {

namespace {

/// Positions tried for a seed, on average: those too near to others or rejected by the draw are lost.
constexpr uint32_t tries_per_seed = 32;
/// A part of a volume is cut plainly where the uniform seeds due are more than so many times the dense ones.
/// Chosen by the bench sizes at 3 m and 5 m; at 4 m the gradient in stages is steeper by a quarter.
constexpr double plain_ratio = 7.0;
/// In this last part of the tries every pattern becomes uniform.
constexpr double uniform_tries = 0.25;
constexpr float spacing_voxels = 1.0F;

/// Seeds by unit cell, so that a seed's neighbours are found in constant time. They lie in voxels of a box.
class SpacedSeeds {
 public:
  explicit SpacedSeeds(const VoxelBox& voxels)
      : low_(voxels.lo - VoxelCoord{2, 2, 2}),  // a voxel's lowest corner, and a neighbour of that cell
        size_(voxels.size() + VoxelCoord{4, 4, 4}),
        numbers_(Window::count({{}, size_})) {}

  bool add(glm::vec3 p) {
    const VoxelCoord home = cell(p) - low_;
    for (int i = 0; i < 27; ++i) {
      const uint16_t number = numbers_[index(home + VoxelCoord{i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1})];
      if (number == 0) continue;
      const glm::vec3 off = seeds[number - 1U] - p;
      if (glm::dot(off, off) < spacing_voxels * spacing_voxels) return false;
    }
    // Two seeds of one cell can be a voxel apart; keeping only one of them makes the look-up simple.
    uint16_t& own = numbers_[index(home)];
    if (own != 0) return false;
    seeds.push_back(p);
    CHECK(seeds.size() <= UINT16_MAX);
    own = static_cast<uint16_t>(seeds.size());
    return true;
  }

  std::vector<glm::vec3> seeds;

 private:
  static VoxelCoord cell(glm::vec3 p) { return {floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)}; }
  size_t index(VoxelCoord at) const {
    CHECK_DEBUG((VoxelBox{{}, size_}.holds(at)));
    return (static_cast<size_t>(at.x) * static_cast<size_t>(size_.y) + static_cast<size_t>(at.y)) *
               static_cast<size_t>(size_.z) +
           static_cast<size_t>(at.z);
  }

  VoxelCoord low_, size_;
  std::vector<uint16_t> numbers_;  ///< of each cell's seed, from 1 on; 0: none
};
static_assert(limits::seeds_max <= UINT16_MAX);

std::vector<VoxelCoord> solid_voxels(const Window& volume) {
  std::vector<VoxelCoord> out;
  out.reserve(volume.codes.size() / 4);
  const VoxelBox& box = volume.box;
  const int count = box.size().z;
  const Code* row = volume.codes.data();
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y, row += count)
      for (int z = 0; z < count; z += 8) {
        const int end = std::min(z + 8, count);
        if (end == z + 8 && !any_solid(row + z)) continue;
        for (int k = z; k < end; ++k)
          if (row[k] < 0) out.push_back({x, y, box.lo.z + k});
      }
  return out;
}

/// The density of seeds: ∝ 1/d² from the nearest of the places, or uniform if there are none.
class Density {
 public:
  Density(std::vector<glm::vec3> places, const std::vector<VoxelCoord>& solid) : places_(std::move(places)) {
    if (places_.empty()) return;
    float nearest2 = distance2(as_vector(solid.front()));
    for (const VoxelCoord& voxel : solid) nearest2 = std::min(nearest2, distance2(as_vector(voxel)));
    // Within a voxel of a place the density is that at one voxel: 1/d² has no bound.
    nearest2_ = std::max(1.0F, nearest2);
  }

  bool wants(glm::vec3 p, float draw) const { return places_.empty() || draw * distance2(p) < nearest2_; }

 private:
  float distance2(glm::vec3 p) const {
    const auto to = [&](glm::vec3 place) { return glm::dot(p - place, p - place); };
    float nearest2 = to(places_.front());
    for (const glm::vec3& place : places_) nearest2 = std::min(nearest2, to(place));
    return nearest2;
  }

  std::vector<glm::vec3> places_;
  float nearest2_ = 0.0F;
};

/// Puts seeds to one place along the axes of a pattern: the middle of the solid voxels.
class Flattening {
 public:
  Flattening(Flattened flattened, const std::vector<VoxelCoord>& solid) {
    if (flattened == Flattened::none) return;
    VoxelBox box{solid.front(), solid.front()};
    for (const VoxelCoord& v : solid) {
      box.lo = {std::min(box.lo.x, v.x), std::min(box.lo.y, v.y), std::min(box.lo.z, v.z)};
      box.hi = {std::max(box.hi.x, v.x), std::max(box.hi.y, v.y), std::max(box.hi.z, v.z)};
    }
    middle_ = 0.5F * (as_vector(box.lo) + as_vector(box.hi));
    const VoxelCoord side = box.size();
    if (flattened == Flattened::shortest) {
      const int least = std::min({side.x, side.y, side.z});
      flattened = side.x == least ? Flattened::x : side.y == least ? Flattened::y : Flattened::z;
    }
    for (int axis = 0; axis < 3; ++axis) flat_[axis] = ((static_cast<unsigned>(flattened) >> axis) & 1U) != 0;
  }

  glm::vec3 operator()(glm::vec3 p) const {
    for (int axis = 0; axis < 3; ++axis)
      if (flat_[axis]) p[axis] = middle_[axis];
    return p;
  }

 private:
  glm::vec3 middle_{0.0F};
  std::array<bool, 3> flat_{};
};

bool all_apart(const std::vector<glm::vec3>& seeds) {
  for (size_t i = 0; i < seeds.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (glm::dot(seeds[i] - seeds[j], seeds[i] - seeds[j]) < spacing_voxels * spacing_voxels) return false;
  return true;
}

constexpr uint32_t seeds_per_cluster = 8;
/// Bounds the cost of a seed's draw.
constexpr size_t clusters_max = 64;

int rounded(float x) {
  return floor_to_int(x + 0.5F);
}

/// Σ 1/d² over the solid voxels, within a voxel 1, by their mass; and the least d² so far.
double density_sum(const Window& window, glm::vec3 impact_voxels, double& nearest2) {
  double sum = 0.0;
  const VoxelBox& box = window.box;
  const Code* code = window.codes.data();
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z, ++code) {
        if (*code >= 0) continue;
        const glm::vec3 off = as_vector(VoxelCoord{x, y, z}) - impact_voxels;
        const auto distance2 = static_cast<double>(glm::dot(off, off));
        nearest2 = std::min(nearest2, distance2);
        sum += static_cast<double>(occupancy(*code)) / units_per_voxel / std::max(1.0, distance2);
      }
  return sum;
}

}  // namespace

std::vector<glm::vec3> at_impact(uint32_t /*count*/, glm::vec3 impact_voxels,
                                 const std::vector<VoxelCoord>& /*solid*/, Random& /*random*/) {
  return {impact_voxels};
}

std::vector<glm::vec3> at_clusters(uint32_t count, glm::vec3 /*impact_voxels*/,
                                   const std::vector<VoxelCoord>& solid, Random& random) {
  std::vector<glm::vec3> places;
  for (uint32_t i = 0; i < count && places.size() < clusters_max; i += seeds_per_cluster)
    places.push_back(as_vector(solid[random.below(static_cast<uint32_t>(solid.size()))]));
  return places;
}

std::vector<glm::vec3> scatter_seeds(const Window& volume, SeedPattern pattern, uint32_t count,
                                     uint32_t random_seed, glm::vec3 impact_voxels) {
  CHECK(is_drawn(pattern));
  CHECK(count > 0 && count <= limits::seeds_max);
  const std::vector<VoxelCoord> solid = solid_voxels(volume);
  if (solid.empty()) return {};
  Random random(random_seed);
  DensePlaces* const places = traits_of(pattern).places;
  const Density density(
      places == nullptr ? std::vector<glm::vec3>() : places(count, impact_voxels, solid, random), solid);
  const Flattening flattened(traits_of(pattern).flattened, solid);
  SpacedSeeds out(volume.box);
  const uint64_t tries_max = static_cast<uint64_t>(count) * tries_per_seed;
  for (uint64_t tries = 0; tries < tries_max && out.seeds.size() < count; ++tries) {
    const VoxelCoord voxel = solid[random.below(static_cast<uint32_t>(solid.size()))];
    const float dx = random.unit() - 0.5F, dy = random.unit() - 0.5F, dz = random.unit() - 0.5F;
    const glm::vec3 p = as_vector(voxel) + glm::vec3(dx, dy, dz);
    const float draw = random.unit();
    static_assert(uniform_tries == 0.25);
    if (density.wants(p, draw) || tries > tries_max - tries_max / 4) out.add(flattened(p));
  }
  CHECK_DEBUG(all_apart(out.seeds));
  return std::move(out.seeds);
}

std::vector<SeedsDue> seeds_due(const std::vector<const Volume*>& parts, SeedPattern pattern,
                                glm::vec3 impact_voxels) {
  CHECK(is_drawn(pattern));
  std::vector<double> voxels, densities;
  double all_voxels = 0.0, all_density = 0.0, nearest2 = std::numeric_limits<double>::max();
  for (const Volume* part : parts) {
    voxels.push_back(static_cast<double>(part->mass) / units_per_voxel);
    densities.push_back(density_sum(part->window, impact_voxels, nearest2));
    all_voxels += voxels.back();
    all_density += densities.back();
  }
  const SeedPatternRow& row = traits_of(pattern);
  // So many seeds of a plain pattern are drawn by density, before the tries become uniform. A part that is
  // cut on draws its own.
  double dense = row.is_cut_on ? 1.0 : 0.0;
  if (row.places == at_impact && !row.is_cut_on && all_voxels > 0.0)
    dense = std::min(
        1.0, std::max(1.0, nearest2) * all_density / all_voxels * tries_per_seed * (1.0 - uniform_tries));
  if (all_density == 0.0) dense = 0.0;
  std::vector<SeedsDue> due;
  for (size_t i = 0; i < parts.size(); ++i) {
    const double by_density = dense > 0.0 ? dense * densities[i] / all_density : 0.0;
    const double uniform = all_voxels > 0.0 ? (1.0 - dense) * voxels[i] / all_voxels : 0.0;
    const bool becomes_plain =
        row.places == at_impact && row.flattened == Flattened::none && parts.size() > 1;
    due.push_back({by_density + uniform,
                   becomes_plain && uniform > plain_ratio * by_density ? plain_pattern : pattern});
  }
  return due;
}

std::vector<glm::vec3> authored_seeds(const Window& volume, const std::vector<glm::vec3>& points_voxels,
                                      uint32_t random_seed) {
  SpacedSeeds out(volume.box);
  for (const glm::vec3& p : points_voxels) {
    const VoxelCoord voxel{rounded(p.x), rounded(p.y), rounded(p.z)};
    if (volume.box.holds(voxel) && volume.at(voxel.x, voxel.y, voxel.z) < 0) out.add(p);
  }
  if (out.seeds.empty()) return scatter_seeds(volume, plain_pattern, 1, random_seed, glm::vec3(0.0F));
  return std::move(out.seeds);
}

}  // namespace scree
