#include "server/world/merge_stage.h"

#include "shared/field/stamp_method.h"

namespace scree {

std::vector<PieceId> settled(World::State& state) {
  std::vector<RestPiece> alive;
  for (const BodyState& body : state.bodies.states())
    alive.push_back({body.id, body.pose, state.bodies.reach_m(body.id)});
  const BodyContacts contacts = state.bodies.contacts();
  std::vector<RestSupport> supports;
  for (const Carried& carried : contacts.carried) supports.push_back({carried.upper, carried.lower});
  const bool may_merge = state.methods.recombine != Recombination::off;
  return state.rest.update(alive, contacts.on_terrain, supports,
                           may_merge ? state.config.merges_per_tick_max : 0);
}

namespace {

/// What is off merges nothing; a caller that merges all the same gets stamps.
StampMethod method_of(Recombination recombination) {
  switch (recombination) {
    case Recombination::slices:
      return StampMethod::slices;
    case Recombination::sphere:
      return StampMethod::sphere;
    case Recombination::stamp:
    case Recombination::off:
      break;
  }
  return StampMethod::stamp;
}

}  // namespace

/// The field gains what the piece weighed, and with it the dust that earlier merges could not place.
void merge(World::State& state, PieceId id, TickDelta& delta) {
  const float dx = state.config.terrain.voxel_size_m;
  const std::shared_ptr<const Volume> volume = state.pieces.at(id);
  const StampMethod method = method_of(state.methods.recombine);
  StampOperation operation{id, quantise(state.bodies.state(id).pose), 0, method};
  const Window window = gather(state.field, stamp_box(method, *volume, operation.pose, dx));
  const MassUnits budget = stamp_budget(volume->mass, state.ledger.dust);
  operation.shift = plan_stamp(method, window, *volume, operation.pose, dx, budget).shift;
  state.bodies.remove(id);
  const Applied applied = state.apply_and_record(operation, delta);
  state.ledger.pieces -= volume->mass;
  state.ledger.dust += volume->mass - applied.terrain_gain;
}

}  // namespace scree
