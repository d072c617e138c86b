#include "shared/falling/lumps.h"

namespace scree {

void Lump::add(const Lump& other) {
  mass.kg += other.mass.kg;
  mass.moment += other.mass.moment;
  voxels += other.voxels;
  struck += other.struck;
  held = held || other.held;
  changed = changed || other.changed;
  bounds = hull_of(bounds, other.bounds);
}

glm::dvec3 centre(const SupportPart& part) {
  const glm::dvec3 first = middle_of_voxel(first_voxel(part.brick));
  if (part.is_whole()) return first + 0.5 * (brick_size - 1);
  glm::dvec3 sum(0.0);
  for (int axis = 0; axis < 3; ++axis)
    for (size_t k = 0; k < brick_size; ++k)
      sum[axis] += static_cast<double>(k) * part.layers[static_cast<size_t>(axis)][k];
  return first + sum / static_cast<double>(part.voxels);
}

double kg(const SupportPart& part, int voxels, double voxel_m3) {
  const auto density = static_cast<double>(part.density_kg_m3);
  return density * voxel_m3 * static_cast<double>(part.fill) * voxels;
}

Lump lump_of(const SupportPart& part, double voxel_m3) {
  Lump lump;
  lump.mass.add(kg(part, part.voxels, voxel_m3), centre(part));
  lump.voxels = part.voxels;
  lump.held = part.held;
  const VoxelCoord first = first_voxel(part.brick);
  lump.bounds = {first, first + VoxelCoord{brick_size, brick_size, brick_size}};
  return lump;
}

}  // namespace scree
