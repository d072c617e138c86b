// World::keyframe() and outline(): what a tick would publish that changed all there is.
#include <algorithm>

#include "server/world/person_stage.h"
#include "server/world/request_stage.h"
#include "server/world/settings.h"
#include "server/world/world_state.h"

namespace scree {

void publish_settings(const World::State& state, TickDelta& delta) {
  delta.settings = print(state.config);
  delta.service = state.config.service;
}

TickDelta World::keyframe() {
  State& s = *state_;
  TickDelta delta = outline();
  if (!s.field.pages()) delta.chunks.clear();
  for (const ChunkCoord chunk : s.field.edited_chunks()) {
    if (s.field.is_out(chunk)) continue;
    for (const BrickCoord coord : s.field.edited_bricks(chunk)) delta.bricks.push_back(s.brick_state(coord));
  }
  std::ranges::sort(delta.bricks, {}, &BrickState::coord);
  return delta;
}

TickDelta World::outline() {
  State& s = *state_;
  TickDelta delta;
  delta.tick = s.tick;
  for (const ChunkCoord chunk : s.field.edited_chunks()) delta.chunks.push_back(s.chunk_state(chunk));
  for (const auto& [id, volume] : s.pieces) delta.spawned.push_back({id, volume});
  for (const auto& [id, one] : s.props) delta.props_spawned.push_back({id, one.prop});
  for (const auto& [id, one] : s.joints) delta.joints_added.push_back({id, one.joint});
  if (!s.regions.empty()) delta.regions = s.regions.shared();
  if (!s.game.value().signs->empty()) delta.signs = s.game.value().signs;
  if (!s.game.value().players->empty()) delta.players = s.game.value().players;
  publish_poses(s, delta);
  publish_persons(s, delta);
  delta.stores = s.stores.contents();
  if (!s.provenance.empty())
    delta.region_masses = std::make_shared<const std::vector<RegionMass>>(s.provenance.masses());
  delta.ledger = s.ledger;
  delta.materials = s.materials;
  publish_settings(s, delta);
  delta.stones = s.stones.all();
  delta.spawn = s.spawn_place.find(s.field, s.config.spawn);
  delta.field_hash = s.field.hash();
  delta.state_hash = s.hash();
  return delta;
}

}  // namespace scree
