#include "server/fracture/hull.h"

#include <algorithm>
#include <cmath>

#include "server/fracture/hull_corners.h"
#include "server/fracture/inertia.h"
#include "server/fracture/point_spread.h"
#include "server/fracture/surface_crossings.h"
#include "shared/base/check.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

/// The block surrounded by air: rock at its edge has a surface half a voxel beyond.
Window alone(const Window& window, const VoxelBox& block) {
  Window part(block.grown(1));
  std::ranges::fill(part.codes, code_air);
  for (int x = block.lo.x; x < block.hi.x; ++x)
    for (int y = block.lo.y; y < block.hi.y; ++y)
      for (int z = block.lo.z; z < block.hi.z; ++z) part.codes[part.index(x, y, z)] = window.at(x, y, z);
  return part;
}

/// Corners of a cube of that mass, voxels: the hull of a volume that is too thin to collide.
std::vector<glm::vec3> cube_of(MassUnits mass) {
  const float half = 0.5F * std::cbrt(static_cast<float>(mass) / units_per_voxel);
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 4) != 0 ? half : -half, (i & 2) != 0 ? half : -half,
                         (i & 1) != 0 ? half : -half);
  return corners;
}

/// Whether corners, relative to the centre of mass, lie between the window's outermost voxels.
bool lie_in(const Volume& volume, const std::vector<glm::vec3>& corners_voxels) {
  constexpr float rounding = 0.01F;
  const VoxelBox& b = volume.window.box;
  const glm::vec3 lo = glm::vec3(b.lo.x, b.lo.y, b.lo.z) - volume.centre_voxels - rounding;
  const glm::vec3 hi = glm::vec3(b.hi.x - 1, b.hi.y - 1, b.hi.z - 1) - volume.centre_voxels + rounding;
  return std::ranges::all_of(corners_voxels, [&](glm::vec3 p) {
    return p.x >= lo.x && p.y >= lo.y && p.z >= lo.z && p.x <= hi.x && p.y <= hi.y && p.z <= hi.z;
  });
}

}  // namespace

std::vector<std::vector<glm::vec3>> convex_parts(const Volume& volume, float voxel_size_m, size_t count_max) {
  CHECK(count_max > 0);
  const VoxelBox& all = volume.window.box;
  const VoxelCoord size = all.size();
  int side = 4;
  const auto blocks = [&] {
    const auto along = [&](int length) { return static_cast<size_t>((length + side - 1) / side); };
    return along(size.x) * along(size.y) * along(size.z);
  };
  while (blocks() > count_max) ++side;
  std::vector<std::vector<glm::vec3>> parts;
  for (int x = all.lo.x; x < all.hi.x; x += side)
    for (int y = all.lo.y; y < all.hi.y; y += side)
      for (int z = all.lo.z; z < all.hi.z; z += side) {
        const VoxelBox block{
            {x, y, z},
            {std::min(x + side, all.hi.x), std::min(y + side, all.hi.y), std::min(z + side, all.hi.z)}};
        std::vector<glm::vec3> corners = surface_crossings(alone(volume.window, block));
        for (glm::vec3& p : corners) p -= volume.centre_voxels;
        corners = choose_corners(corners);
        for (glm::vec3& p : corners) p *= voxel_size_m;
        if (!corners.empty()) parts.push_back(std::move(corners));
      }
  CHECK(parts.size() <= count_max);
  return parts;
}

std::vector<PieceHull> make_hulls(const Applied& applied, const PieceTable& pieces, float voxel_size_m,
                                  Simplifier simplifier) {
  std::vector<PieceHull> hulls;
  hulls.reserve(applied.created.size());
  for (const CreatedPiece& created : applied.created) {
    const auto found = pieces.find(created.id);
    CHECK(found != pieces.end());
    hulls.push_back(make_hull(created.id, *found->second, voxel_size_m, simplifier));
  }
  return hulls;
}

std::vector<glm::vec3> surface_samples(const Volume& volume, float voxel_size_m, size_t count_max) {
  constexpr float spacing_voxels = 2.0F;
  std::vector<glm::vec3> samples = spread(surface_crossings(volume.window), spacing_voxels, count_max);
  for (glm::vec3& p : samples) p = (p - volume.centre_voxels) * voxel_size_m;
  return samples;
}

PieceHull make_hull(PieceId id, const Volume& volume, float voxel_size_m, Simplifier simplifier) {
  CHECK(volume.mass > 0);
  std::vector<glm::vec3> candidates = surface_crossings(volume.window);
  for (glm::vec3& p : candidates) p -= volume.centre_voxels;
  PieceHull hull;
  hull.id = id;
  hull.corners_m = traits_of(simplifier).choose(candidates);
  CHECK_DEBUG(lie_in(volume, hull.corners_m));
  if (hull.corners_m.empty()) hull.corners_m = cube_of(volume.mass);
  for (glm::vec3& corner : hull.corners_m) corner *= voxel_size_m;
  hull.inertia_m2 = inertia_of(volume) * (voxel_size_m * voxel_size_m);
  hull.size_m3 =
      static_cast<float>(volume.mass) / units_per_voxel * voxel_size_m * voxel_size_m * voxel_size_m;
  CHECK(hull.corners_m.size() >= 4 && hull.size_m3 > 0.0F);
  CHECK(hull.inertia_m2[0][0] > 0.0F && hull.inertia_m2[1][1] > 0.0F && hull.inertia_m2[2][2] > 0.0F);
  return hull;
}

WeighedVolume weigh(const Volume& volume, const PieceHull& hull, const Palette& palette, float voxel_size_m) {
  const float voxel_m3 = voxel_size_m * voxel_size_m * voxel_size_m;
  WeighedVolume weighed;
  if (volume.masses.empty()) {
    weighed.mass_kg = hull.size_m3 * palette.row_or_first(volume.materials.all).density_kg_m3;
    weighed.inertia_kg_m2 = hull.inertia_m2 * weighed.mass_kg;
    return weighed;
  }
  std::array<float, 256> densities;
  densities.fill(palette.row_or_first(volume.masses.front().material).density_kg_m3);
  for (const MaterialMass& one : volume.masses) {
    const float density = palette.row_or_first(one.material).density_kg_m3;
    densities[row_number(one.material)] = density;
    weighed.mass_kg += static_cast<float>(one.mass) / units_per_voxel * voxel_m3 * density;
  }
  if (volume.materials.is_uniform() || mass_of(volume.window) == 0) {
    weighed.inertia_kg_m2 = hull.inertia_m2 * weighed.mass_kg;
    return weighed;
  }
  const WeightedInertia weighted = weighted_inertia_of(volume, densities);
  weighed.centre_m = weighted.centre_voxels * voxel_size_m;
  weighed.inertia_kg_m2 = weighted.inertia * (voxel_size_m * voxel_size_m * weighed.mass_kg);
  return weighed;
}

}  // namespace scree
