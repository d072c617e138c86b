#include "server/world/neck.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/blast.h"
#include "server/world/limits.h"
#include "server/world/rules.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/base/edit_reach.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

CarveOperation crushing(const World::State& state, const VoxelBox& voxels, int64_t section_voxels) {
  const float dx = state.config.terrain.voxel_size_m;
  const auto at = [&](VoxelCoord v) {
    return (glm::vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)) - 0.5F) * dx;
  };
  CHECK(!voxels.empty() && section_voxels >= 0);
  const glm::vec3 lo = at(voxels.lo), hi = at(voxels.hi);
  CarveOperation operation;
  operation.shape = box(0.5F * (lo + hi), 0.5F * (hi - lo));
  operation.seeds = static_cast<uint32_t>(
      std::clamp<int64_t>(section_voxels / limits::neck_faces_per_seed, 1, limits::neck_seeds_max));
  operation.impact_m = centre_of(operation.shape);
  const uint32_t which =
      state.config.rules >= rules::blows ? number_of_place(operation.impact_m) : state.next_piece;
  operation.random_seed = static_cast<uint32_t>(state.tick) * 0x9E3779B1U + which;
  operation.first_piece = state.next_piece;
  operation.cutter = cutter_for(state.config.methods.cutter, voxels_of(voxels));
  return operation;
}

/// What a crushed neck's pieces get: a speed away from its middle; from a blow, one along it.
class Thrown {
 public:
  Thrown(const World::State& state, const CarveOperation& operation, const Applied& applied, NeckPush* push)
      : operation_(operation), dx_(state.config.terrain.voxel_size_m), push_(push) {
    if (push == nullptr) return;
    float kg = 0.0F;
    for (const CreatedPiece& piece : applied.created) kg += mass_kg(state, *state.pieces.at(piece.id));
    if (kg <= 0.0F) return;
    const float by_energy = std::sqrt(2.0F * push->energy_j / kg);
    const float speed = std::min({push->speed_m_s, push->momentum_n_s / kg, by_energy});
    velocity_m_s_ = push->direction * speed;
    push->momentum_n_s = std::max(push->momentum_n_s - speed * kg, 0.0F);
    push->energy_j = std::max(push->energy_j - 0.5F * speed * speed * kg, 0.0F);
  }

  glm::vec3 velocity_m_s(glm::vec3 at_m) const {
    if (push_ != nullptr) return velocity_m_s_;
    const glm::vec3 away = at_m - operation_.impact_m;
    const float distance = std::max(std::sqrt(glm::dot(away, away)), dx_);
    return away / distance * limits::neck_throw_m_s;
  }

 private:
  const CarveOperation& operation_;
  float dx_;
  const NeckPush* push_;
  glm::vec3 velocity_m_s_{0.0F};
};

void crush(World::State& state, const CarveOperation& operation, uint64_t party, NeckPush* push,
           TickDelta& delta) {
  if (!validate(Operation(operation), state.pieces, state.config.terrain.voxel_size_m))
    return;  // at the world's edge
  const float dx = state.config.terrain.voxel_size_m;
  const Applied applied = state.apply_and_record(operation, party, delta);
  state.enter_removed(applied);
  const Thrown thrown(state, operation, applied, push);
  const auto born = [&](PieceId, const Volume& volume) {
    Newborn piece;
    piece.body.pose.position_m = volume.centre_voxels * dx;
    piece.body.velocity_m_s = thrown.velocity_m_s(piece.body.pose.position_m);
    piece.traits = {.generation = limits::break_generations_max, .owner = party};
    return piece;
  };
  spawn(state, applied, born, delta);
}

/// Crushes a box; one that is longer than the reach of an edit in halves, recursively.
void crush_by_halves(World::State& state, const VoxelBox& box, int64_t section_voxels, uint64_t party,
                     NeckPush* push, TickDelta& delta) {
  const VoxelCoord size = box.size();
  const int longest = std::max({size.x, size.y, size.z});
  const float dx = state.config.terrain.voxel_size_m;
  const float reach_m = 0.5F * static_cast<float>(longest) * dx;
  if (reach_m <= greatest_edit_reach_m(dx)) {
    crush(state, crushing(state, box, section_voxels), party, push, delta);
    return;
  }
  VoxelBox first = box, second = box;
  int VoxelCoord::*const side = size.x == longest   ? &VoxelCoord::x
                                : size.y == longest ? &VoxelCoord::y
                                                    : &VoxelCoord::z;
  first.hi.*side = second.lo.*side = box.lo.*side + longest / 2;
  crush_by_halves(state, first, section_voxels / 2, party, push, delta);
  crush_by_halves(state, second, section_voxels / 2, party, push, delta);
}

}  // namespace

const Region* region_of_necks(const World::State& state, const Overload& overload) {
  for (const Neck& neck : overload.necks)
    if (const Region* const region = state.regions.forbidding(forbids::dents, neck.box)) return region;
  return nullptr;
}

bool crush_necks(World::State& state, const Overload& overload, uint64_t party, NeckPush* push,
                 TickDelta& delta) {
  for (const Neck& neck : overload.necks) {
    if (state.pieces.size() + limits::neck_seeds_max > state.config.pieces_max) return false;
    crush_by_halves(state, neck.box, neck.section_voxels, party, push, delta);
    state.work.spend(limits::dent_cost_us);
  }
  return true;
}

}  // namespace scree
