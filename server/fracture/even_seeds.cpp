#include "server/fracture/even_seeds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <voro++/voro++.hh>

#include "shared/base/check.h"
#include "shared/base/roots.h"
#include "shared/field/mass.h"
#include "shared/fracture/seeds.h"

namespace scree {

namespace {

/// Rounds of Lloyd's method: the spread of sizes falls from about 0.5 to 0.17 in eight, to 0.15 in 24.
constexpr int rounds = 8;
/// Samples of the volume: so many a seed, within bounds.
constexpr uint32_t samples_per_seed = 32;
constexpr uint32_t samples_min = 1024, samples_max = 6144;
/// Seeds in a block of voro++'s grid, on average.
constexpr double seeds_per_block = 4.0;

struct Sample {
  glm::dvec3 at;
  double units;
};

/// Solid voxels at even distances in the order of the window.
std::vector<Sample> samples_of(const Window& volume, uint32_t wanted) {
  const auto solid =
      static_cast<size_t>(std::ranges::count_if(volume.codes, [](Code code) { return code < 0; }));
  const size_t count = std::min<size_t>(solid, wanted);
  std::vector<Sample> samples;
  samples.reserve(count);
  const VoxelBox& b = volume.box;
  size_t number = 0;
  const Code* code = volume.codes.data();
  for (int x = b.lo.x; x < b.hi.x; ++x)
    for (int y = b.lo.y; y < b.hi.y; ++y)
      for (int z = b.lo.z; z < b.hi.z; ++z, ++code) {
        if (*code >= 0) continue;
        const bool taken = (number + 1) * count / solid > number * count / solid;
        ++number;
        if (taken) samples.push_back({glm::dvec3(x, y, z), static_cast<double>(occupancy(*code))});
      }
  CHECK_EQ(samples.size(), count);
  return samples;
}

bool is_solid(const Window& volume, glm::dvec3 p) {
  const VoxelCoord v{static_cast<int>(std::floor(p.x + 0.5)), static_cast<int>(std::floor(p.y + 0.5)),
                     static_cast<int>(std::floor(p.z + 0.5))};
  return volume.box.holds(v) && volume.at(v.x, v.y, v.z) < 0;
}

class Relaxation {
 public:
  Relaxation(const Window& volume, const std::vector<glm::vec3>& seeds)
      : volume_(volume),
        samples_(samples_of(volume, std::clamp(samples_per_seed * static_cast<uint32_t>(seeds.size()),
                                               samples_min, samples_max))),
        cells_(samples_.size(), 0) {
    for (const glm::vec3& seed : seeds) seeds_.emplace_back(seed);
  }

  void round() {
    find_cells();
    std::vector<glm::dvec3> sums(seeds_.size(), glm::dvec3(0.0));
    std::vector<double> units(seeds_.size(), 0.0);
    for (size_t i = 0; i < samples_.size(); ++i) {
      sums[cells_[i]] += samples_[i].at * samples_[i].units;
      units[cells_[i]] += samples_[i].units;
    }
    for (size_t seed = 0; seed < seeds_.size(); ++seed) {
      if (units[seed] == 0.0) continue;  // smaller than the samples tell
      const glm::dvec3 centre = sums[seed] / units[seed];
      seeds_[seed] = is_solid(volume_, centre) ? centre : nearest_in_cell(seed, centre);
    }
  }

  std::vector<glm::vec3> seeds() const { return {seeds_.begin(), seeds_.end()}; }

 private:
  void find_cells() {
    const VoxelBox& b = volume_.box;
    const glm::dvec3 lo = glm::dvec3(b.lo.x, b.lo.y, b.lo.z) - 1.0, hi(b.hi.x, b.hi.y, b.hi.z);
    const auto blocks =
        std::max(1, static_cast<int>(cube_root(static_cast<float>(seeds_.size() / seeds_per_block))));
    voro::container container(lo.x, hi.x, lo.y, hi.y, lo.z, hi.z, blocks, blocks, blocks, false, false, false,
                              8);
    for (size_t i = 0; i < seeds_.size(); ++i)
      container.put(static_cast<int>(i), seeds_[i].x, seeds_[i].y, seeds_[i].z);
    for (size_t i = 0; i < samples_.size(); ++i) {
      glm::dvec3 at;
      int seed = 0;
      const glm::dvec3& p = samples_[i].at;
      const bool found = container.find_voronoi_cell(p.x, p.y, p.z, at.x, at.y, at.z, seed);
      CHECK(found && seed >= 0 && static_cast<size_t>(seed) < seeds_.size());
      cells_[i] = static_cast<uint32_t>(seed);
    }
  }

  /// Where a cell is hollow.
  glm::dvec3 nearest_in_cell(size_t seed, glm::dvec3 p) const {
    glm::dvec3 nearest = seeds_[seed];
    double least = 1e300;
    for (size_t i = 0; i < samples_.size(); ++i) {
      const glm::dvec3 off = samples_[i].at - p;
      if (cells_[i] != seed || glm::dot(off, off) >= least) continue;
      least = glm::dot(off, off);
      nearest = samples_[i].at;
    }
    return nearest;
  }

  const Window& volume_;
  std::vector<Sample> samples_;
  std::vector<uint32_t> cells_;  ///< of each sample: the seed of its cell
  std::vector<glm::dvec3> seeds_;
};

}  // namespace

std::vector<glm::vec3> even_seeds(const Window& volume, uint32_t count, uint32_t random_seed) {
  const std::vector<glm::vec3> start =
      scatter_seeds(volume, plain_pattern, count, random_seed, glm::vec3(0.0F));
  if (start.empty()) return {};
  Relaxation relaxation(volume, start);
  for (int i = 0; i < rounds; ++i) relaxation.round();
  return relaxation.seeds();
}

}  // namespace scree
