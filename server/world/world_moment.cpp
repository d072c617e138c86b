// World::moment() and renew(): what a world is, but its terrain.
#include <algorithm>

#include "server/world/recorded_values.h"
#include "server/world/refracture_stage.h"
#include "server/world/region_requests.h"
#include "server/world/world_snapshot.h"
#include "server/world/world_state.h"
#include "shared/base/check.h"

namespace scree {

namespace {

std::vector<PartyBricks> value_of(const BricksByParty& parties) {
  std::vector<PartyBricks> value;
  for (const auto& [party, bricks] : parties) value.push_back({party, {bricks.begin(), bricks.end()}});
  return value;
}

std::vector<PendingRefracture> refractures_of(const World::State& state) {
  std::vector<PendingRefracture> value;
  for (const auto& [party, line] : state.refractures.lines())
    for (const WaitingRefracture& waiting : line.items) value.push_back(waiting.pending);
  return value;
}

}  // namespace

WorldMoment World::moment() const {
  const State& s = *state_;
  CHECK(s.changed.empty() && s.unswept.empty() && s.at_rest.empty());
  WorldMoment m;
  m.config = to_recorded(s.config);
  m.tick = s.tick;
  m.next_piece = s.next_piece;
  m.ledger = s.ledger;
  m.stores = s.stores.value();
  m.provenance = s.provenance.value();
  m.materials = s.materials;
  m.game = s.game.value();
  m.stones = s.stones.value();
  m.field_hash = s.field.hash();
  m.state_hash = s.hash();
  for (const auto& [id, volume] : s.pieces)
    m.pieces.push_back({id, s.traits.at(id), volume, s.bodies.shape(id)});
  for (const auto& [id, one] : s.props) m.props.push_back({id, one.owner, one.prop});
  for (const auto& [id, one] : s.joints) m.joints.push_back({id, one.owner, one.joint});
  for (const auto& [session, person] : s.persons) m.persons.push_back(person);
  m.motion = s.bodies.motions();
  m.rest = s.rest.value();
  m.requests = s.requests.value();
  m.requested = s.requested;
  m.debt_us = s.work.debt_us();
  m.refractures = refractures_of(s);
  m.refractured_at = s.refractured_at;
  m.island_at = s.island_at;
  m.islands = s.islands.value();
  m.loosened_bricks = value_of(s.loosened_bricks);
  m.strained = value_of(s.strained);
  m.slopes = value_of(s.slopes);
  m.gained = s.gained;
  m.struck = s.struck.value();
  enter_regions(s, m);
  m.buried = {s.buried.begin(), s.buried.end()};
  m.sunk = {s.sunk.begin(), s.sunk.end()};
  return m;
}

void World::renew() {
  State& s = *state_;
  CHECK(s.thread.is_the_same(), "another thread owns this world: it must call release_thread() first");
  s.bodies.renew();
  s.rest.restore(s.rest.value());
  s.islands.restore(s.islands.value());
  const std::vector<PendingRefracture> refractures = refractures_of(s);
  s.refractures = {};
  for (const PendingRefracture& pending : refractures) enter_refracture(s, pending);
  s.turns = {};
  s.contact_sums.clear();
  s.person_blows.clear();
  s.check();
}

uint64_t first_free_session(const WorldMoment& moment) {
  uint64_t last = 0;
  for (const PieceRecord& piece : moment.pieces) last = std::max(last, piece.traits.owner);
  for (const PropRecord& prop : moment.props) last = std::max(last, prop.owner);
  for (const JointRecord& joint : moment.joints) last = std::max(last, joint.owner);
  for (const PersonRecord& person : moment.persons) last = std::max(last, person.session);
  for (const Player& player : *moment.game.players) last = std::max(last, player.session);
  for (const PlacedMass& placed : moment.provenance) last = std::max(last, placed.share.origin.party);
  for (const StoreRecord& store : moment.stores)
    if (store.content.store.kind == StoreKind::session) last = std::max(last, store.content.store.number);
  for (const PartyValue& party : moment.requests.parties) {
    last = std::max(last, party.party);
    for (const SessionValue& session : party.sessions) last = std::max(last, session.session);
  }
  for (const TurnsValue::Turn& turn : moment.requests.turns.turns) last = std::max(last, turn.who);
  for (const LooseningEdit& search : moment.islands) last = std::max(last, search.party);
  for (const PendingRefracture& pending : moment.refractures) last = std::max(last, pending.party);
  for (const auto* parties : {&moment.loosened_bricks, &moment.strained, &moment.slopes})
    for (const PartyBricks& one : *parties) last = std::max(last, one.party);
  return last + 1;
}

}  // namespace scree
