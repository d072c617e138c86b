#include "studies/matrix/shapes.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "bench/support/scenes.h"
#include "bench/support/surface_distance.h"
#include "server/fracture/relaxed_seeds.h"
#include "shared/operation/prepared_stamp.h"
#include "studies/matrix/session.h"

namespace scree {

namespace {

constexpr float cut_radius_m = 2.0F;

/// A blow, with the points of its seeds where the pattern has the server compute them.
CarveOperation cut_operation(Cutter cutter, SeedPattern pattern, uint32_t seeds, Field& field) {
  const CarveRequest blow = blow_at(matrix_terrain, 6.0F, 4.0F, cut_radius_m, seeds, 1);
  CarveOperation carve{blow.shape, pattern, seeds, blow.random_seed, blow.impact_m, 1, cutter, {}};
  if (!is_relaxed(pattern)) return carve;
  for (const glm::vec3& seed :
       relaxed_seeds(pattern, carved_volume(field, blow.shape), seeds, blow.random_seed))
    carve.authored_m.push_back(seed * matrix_terrain.voxel_size_m);
  carve.seeds = static_cast<uint32_t>(carve.authored_m.size());
  return carve;
}

/// How far a point is from the cells of a piece's seeds, voxels, negative inside: of all half-spaces that
/// bound a cell the farthest one, of several cells the nearest one.
double cells_distance(glm::dvec3 p, const std::vector<uint32_t>& own, const std::vector<glm::vec3>& seeds) {
  double nearest = 1e9;
  for (const uint32_t i : own) {
    const glm::dvec3 seed(seeds[i]);
    double farthest = -1e9;
    for (uint32_t j = 0; j < seeds.size(); ++j) {
      if (std::ranges::find(own, j) != own.end()) continue;
      const glm::dvec3 other(seeds[j]);
      const double apart = glm::length(other - seed);
      farthest = std::max(farthest, glm::dot(p - 0.5 * (seed + other), other - seed) / apart);
    }
    nearest = std::min(nearest, farthest);
  }
  return nearest;
}

}  // namespace

Result<CellErrorFigures> measure_cell_error(Cutter cutter, SeedPattern pattern, uint32_t seeds) {
  MapField field(matrix_terrain);
  const CarveOperation carve = cut_operation(cutter, pattern, seeds, field);
  const Window volume = carved_volume(field, carve.shape);
  PieceTable pieces;
  const Applied applied = apply(carve, field, pieces);
  SurfaceDistance distance;
  for (const CreatedPiece& piece : applied.created) {
    const auto visit = [&](VoxelCoord voxel, VoxelCoord step, double part) {
      const glm::dvec3 p = glm::dvec3(voxel.x, voxel.y, voxel.z) + part * glm::dvec3(step.x, step.y, step.z);
      distance.add(std::max(distance_on_edge(volume, voxel, step, part),
                            cells_distance(p, piece.seeds, applied.seeds_voxels)));
    };
    for_each_crossing(pieces.at(piece.id)->window, visit);
  }
  if (distance.samples == 0.0) return fail("a blow made no pieces");
  return CellErrorFigures{distance.rms()};
}

Result<MergeFigures> measure_merge(Cutter cutter, SeedPattern pattern, Recombination recombine,
                                   uint32_t seeds) {
  const std::optional<StampMethod> method = stamp_method_of(recombine);
  if (!method) return MergeFigures{};
  MapField field(matrix_terrain);
  PieceTable pieces;
  apply(cut_operation(cutter, pattern, seeds, field), field, pieces);
  const PieceTable made = pieces;
  const std::vector<Pose> poses = resting_places(field, made, cut_radius_m, 1);
  SurfaceDistance distance;
  MergeFigures figures;
  size_t i = 0;
  for (const auto& [id, volume] : made) {
    const QuantisedPose pose = quantise(poses[i++]);
    const Window exact = exact_union(field, made, {{id, pose}});
    const PreparedStamp prepared = prepare_stamp(field, pieces, id, pose, *method, volume->mass);
    const Applied applied = apply(prepared.operation, field, pieces, &prepared);
    const auto mass = static_cast<double>(volume->mass);
    figures.mass_percent += 100.0 * std::abs(static_cast<double>(applied.terrain_gain) - mass) / mass;
    add_distances(gather(field, exact.box), exact, distance);
  }
  if (made.empty()) return fail("a blow made no pieces");
  figures.mass_percent /= static_cast<double>(made.size());
  figures.rms_voxels = distance.rms();
  return figures;
}

}  // namespace scree
