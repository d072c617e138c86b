#include "server/world/spawn.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "server/fracture/hull.h"
#include "server/world/limits.h"
#include "shared/base/check.h"

namespace scree {

BodyState part_of(const BodyState& body, glm::vec3 offset_m) {
  BodyState part = body;
  part.frozen = false;
  const glm::vec3 turned_m = body.pose.rotation * offset_m;
  part.pose.position_m += turned_m;
  part.velocity_m_s += glm::cross(body.spin_rad_s, turned_m);
  return part;
}

namespace {

struct Surface {
  float friction = 0.0F, restitution = 0.0F;
};

/// The means of a piece's materials by mass.
Surface mean_surface(const Volume& volume, const Palette& palette) {
  if (volume.masses.empty()) {
    const MaterialRow& row = palette.row_or_first(volume.materials.all);
    return {row.friction, row.restitution};
  }
  Surface mean;
  for (const MaterialMass& one : volume.masses) {
    const MaterialRow& row = palette.row_or_first(one.material);
    const float share = static_cast<float>(one.mass) / static_cast<float>(volume.mass);
    mean.friction += share * row.friction;
    mean.restitution += share * row.restitution;
  }
  return mean;
}

/// Points from the volume's centre become points from the centre of mass.
void relate_to_mass(BodyShape& shape) {
  if (shape.centre_m == glm::vec3(0.0F)) return;
  for (glm::vec3& p : shape.hull_m) p -= shape.centre_m;
  for (glm::vec3& p : shape.surface_m) p -= shape.centre_m;
  for (std::vector<glm::vec3>& part : shape.parts_m)
    for (glm::vec3& p : part) p -= shape.centre_m;
}

}  // namespace

void spawn(World::State& state, const Applied& applied,
           const std::function<Newborn(PieceId, const Volume&)>& born, TickDelta& delta) {
  if (applied.created.empty()) return;
  const TickStage outer = state.stopwatch.switch_to(TickStage::spawn, delta.times);
  delta.times.acted.set(index_of(TickStage::spawn));
  for (const PieceHull& hull : make_hulls(applied, state.pieces, state.config.terrain.voxel_size_m,
                                          state.config.methods.simplifier)) {
    CHECK_EQ(hull.id, state.next_piece);
    const std::shared_ptr<const Volume>& volume = state.pieces.at(hull.id);
    Newborn newborn = born(hull.id, *volume);
    newborn.body.id = hull.id;
    const float dx = state.config.terrain.voxel_size_m;
    const WeighedVolume weighed = weigh(*volume, hull, *state.palette, dx);
    const Surface surface = mean_surface(*volume, *state.palette);
    BodyShape shape;
    shape.hull_m = hull.corners_m;
    shape.mass_kg = weighed.mass_kg;
    shape.inertia_kg_m2 = weighed.inertia_kg_m2;
    shape.centre_m = weighed.centre_m;
    shape.friction = surface.friction;
    shape.restitution = surface.restitution;
    if (newborn.may_be_concave) {
      shape.surface_m = surface_samples(*volume, dx, limits::concave_samples_max);
      shape.surface_m.insert(shape.surface_m.end(), hull.corners_m.begin(), hull.corners_m.end());
      const VoxelCoord size = volume->window.box.size();
      if (std::max({size.x, size.y, size.z}) >= limits::compound_side_min_voxels)
        shape.parts_m = convex_parts(*volume, dx, limits::compound_parts_max);
    }
    relate_to_mass(shape);
    state.bodies.add(std::move(shape), newborn.body);
    state.traits[hull.id] = newborn.traits;
    state.shares.add(newborn.traits.owner);
    delta.spawned.push_back({hull.id, volume});
    state.next_piece = hull.id + 1;
  }
  state.stopwatch.switch_to(outer, delta.times);
}

Applied shatter_piece(World::State& state, const ShatterOperation& operation, const SetsOut& sets_out,
                      TickDelta& delta) {
  const BodyState body = state.bodies.state(operation.piece);
  PieceTraits traits = state.traits_of(operation.piece);
  traits.kept = false;
  const glm::vec3 centre_voxels = state.pieces.at(operation.piece)->centre_voxels;
  state.bodies.remove(operation.piece);
  Applied applied = state.apply_and_record(operation, traits.owner, delta);
  CHECK_EQ(applied.terrain_gain, 0);
  state.ledger.pieces -= applied.dust;
  state.ledger.dust += applied.dust;
  const float dx = state.config.terrain.voxel_size_m;
  const auto born = [&](PieceId id, const Volume& volume) {
    Newborn part{part_of(body, (volume.centre_voxels - centre_voxels) * dx), traits};
    if (sets_out) sets_out(id, part.body);
    return part;
  };
  spawn(state, applied, born, delta);
  return applied;
}

float mass_kg(const Volume& volume, const Palette& palette, float voxel_size_m) {
  const float dx = voxel_size_m;
  float kg = 0.0F;
  for (const MaterialMass& one : masses_of(volume))
    kg += static_cast<float>(one.mass) / units_per_voxel * dx * dx * dx *
          palette.row_or_first(one.material).density_kg_m3;
  return kg;
}

float mass_kg(const World::State& state, const Volume& volume) {
  return mass_kg(volume, *state.palette, state.config.terrain.voxel_size_m);
}

}  // namespace scree
