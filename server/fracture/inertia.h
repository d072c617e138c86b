// The inertia of a volume. Pure; voxels.
#pragma once

#include <glm/mat3x3.hpp>
#include <span>

#include "shared/field/piece.h"

namespace scree {

/// Inertia tensor of 1 kg about the volume's centre of mass, in voxels². Voxels of the surface count by the
/// part that has rock, so boxes have the tensor of boxes; their mass is the field's, which has up to 7 %
/// more.
glm::mat3 inertia_of(const Volume& volume);

/// The same of a volume whose materials weigh different, about its centre of mass; every voxel counts as a
/// small cube.
struct WeightedInertia {
  glm::vec3 centre_voxels{0.0F};  ///< of mass, from the volume's centre
  glm::mat3 inertia{0.0F};
};
/// `densities`: by row, relative to each other. The volume has mass, and more than one material.
WeightedInertia weighted_inertia_of(const Volume& volume, std::span<const float, 256> densities);

}  // namespace scree
