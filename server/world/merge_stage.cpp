#include "server/world/merge_stage.h"

#include "shared/field/stamp.h"

namespace scree {

std::vector<PieceId> settled(World::State& state) {
  std::vector<RestPiece> alive;
  for (const BodyState& body : state.bodies.states())
    alive.push_back({body.id, body.pose, state.bodies.reach_m(body.id)});
  const BodyContacts contacts = state.bodies.contacts();
  std::vector<RestSupport> supports;
  for (const Carried& carried : contacts.carried) supports.push_back({carried.upper, carried.lower});
  return state.rest.update(alive, contacts.on_terrain, supports, state.config.merges_per_tick_max);
}

/// The field gains what the piece weighed, and with it the dust that earlier merges could not place.
void merge(World::State& state, PieceId id, TickDelta& delta) {
  const float dx = state.config.terrain.voxel_size_m;
  const std::shared_ptr<const Volume> volume = state.pieces.at(id);
  StampOperation operation{id, quantise(state.bodies.state(id).pose), 0};
  const Window window = gather(state.field, stamp_box(*volume, operation.pose, dx));
  operation.shift =
      plan_stamp(window, *volume, operation.pose, dx, stamp_budget(volume->mass, state.ledger.dust)).shift;
  state.bodies.remove(id);
  const Applied applied = state.apply_and_record(operation, delta);
  state.ledger.pieces -= volume->mass;
  state.ledger.dust += volume->mass - applied.terrain_gain;
}

}  // namespace scree
