#include "server/world/spawn.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "server/fracture/hull.h"
#include "server/world/limits.h"
#include "shared/base/check.h"

namespace scree {

BodyState part_of(const BodyState& body, glm::vec3 offset_m) {
  BodyState part = body;
  const glm::vec3 turned_m = body.pose.rotation * offset_m;
  part.pose.position_m += turned_m;
  part.velocity_m_s += glm::cross(body.spin_rad_s, turned_m);
  return part;
}

void spawn(World::State& state, const Applied& applied,
           const std::function<Newborn(PieceId, const Volume&)>& born, TickDelta& delta) {
  if (applied.created.empty()) return;
  const TickStage outer = state.watch.switch_to(TickStage::spawn, delta.times);
  delta.times.acted.set(index_of(TickStage::spawn));
  for (const PieceHull& hull : make_hulls(applied, state.pieces, state.config.terrain.voxel_size_m,
                                          state.config.methods.simplifier)) {
    CHECK_EQ(hull.id, state.next_piece);
    const std::shared_ptr<const Volume>& volume = state.pieces.at(hull.id);
    Newborn newborn = born(hull.id, *volume);
    newborn.body.id = hull.id;
    const MaterialRow& material = traits_of(volume->material);
    const float mass_kg = hull.size_m3 * material.density_kg_m3;
    BodyShape shape;
    shape.hull_m = hull.corners_m;
    shape.mass_kg = mass_kg;
    shape.inertia_kg_m2 = hull.inertia_m2 * mass_kg;
    shape.friction = material.friction;
    if (newborn.may_be_concave) {
      const float dx = state.config.terrain.voxel_size_m;
      shape.surface_m = surface_samples(*volume, dx, limits::concave_samples_max);
      shape.surface_m.insert(shape.surface_m.end(), hull.corners_m.begin(), hull.corners_m.end());
      const VoxelCoord size = volume->window.box.size();
      if (std::max({size.x, size.y, size.z}) >= limits::compound_side_min_voxels)
        shape.parts_m = convex_parts(*volume, dx, limits::compound_parts_max);
    }
    state.bodies.add(shape, newborn.body);
    state.traits[hull.id] = newborn.traits;
    state.shares.add(newborn.traits.owner);
    delta.spawned.push_back({hull.id, volume});
    state.next_piece = hull.id + 1;
  }
  state.watch.switch_to(outer, delta.times);
}

}  // namespace scree
