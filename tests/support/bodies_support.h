// Bodies on ground that is dug.
#pragma once

#include "server/bodies/bodies.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_terrain.h"

namespace scree {

inline TerrainSource ground(TerrainKind kind) {
  return {kind, 7, voxel_m};
}

inline BodyState body_at(PieceId id, glm::vec3 position_m, glm::vec3 velocity_m_s = glm::vec3(0.0F)) {
  return {id, {position_m, glm::quat(1.0F, 0.0F, 0.0F, 0.0F)}, velocity_m_s, glm::vec3(0.0F)};
}

inline void step(Bodies& bodies, int ticks) {
  for (int i = 0; i < ticks; ++i) bodies.step();
}

/// Takes a ball out of the ground, and tells the given bodies.
template <typename... Listener>
void dig(Field& field, glm::vec3 centre_m, float radius_m, Listener&... listeners) {
  CarveOperation carve;
  carve.shape = sphere(centre_m, radius_m);
  PieceTable pieces;
  apply(carve, field, pieces);
  (listeners.terrain_changed(band_box(in_voxels(carve.shape, voxel_m))), ...);
}

}  // namespace scree
