#include "server/world/spawn.h"

#include "server/fracture/hull.h"

namespace scree {

void spawn(World::State& state, const Applied& applied,
           const std::function<Newborn(PieceId, const Volume&)>& born, TickDelta& delta) {
  for (const PieceHull& hull : make_hulls(applied, state.pieces, state.config.terrain.voxel_size_m)) {
    const std::shared_ptr<const Volume>& volume = state.pieces.at(hull.id);
    Newborn newborn = born(hull.id, *volume);
    newborn.body.id = hull.id;
    const MaterialTraits& material = traits_of(newborn.traits.material);
    const float mass_kg = hull.size_m3 * material.density_kg_m3;
    state.bodies.add({hull.corners_m, mass_kg, hull.inertia_m2 * mass_kg, material.friction}, newborn.body);
    state.traits[hull.id] = newborn.traits;
    delta.spawned.push_back({hull.id, volume});
    state.next_piece = hull.id + 1;
  }
}

Material birth_material(const World::State& state, const Volume& volume) {
  const TerrainSource& source = state.config.terrain;
  return material_at(source, volume.centre_voxels * source.voxel_size_m);
}

}  // namespace scree
