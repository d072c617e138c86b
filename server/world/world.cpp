#include "server/world/world.h"

#include <algorithm>

#include "server/world/body_contacts.h"
#include "server/world/buried_stage.h"
#include "server/world/game_requests.h"
#include "server/world/impact_stage.h"
#include "server/world/island_stage.h"
#include "server/world/joint_requests.h"
#include "server/world/merge_stage.h"
#include "server/world/person_requests.h"
#include "server/world/person_stage.h"
#include "server/world/prop_requests.h"
#include "server/world/refracture_stage.h"
#include "server/world/region_bodies.h"
#include "server/world/region_requests.h"
#include "server/world/request_stage.h"
#include "server/world/settings.h"
#include "server/world/slide_stage.h"
#include "server/world/support_stage.h"
#include "server/world/world_state.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

constexpr glm::vec3 world_half_m(limits::world_half_width_m, limits::world_half_height_m,
                                 limits::world_half_width_m);

void step_bodies(World::State& state, TickDelta& delta) {
  const std::vector<BodyState> before = places_before_step(state);
  state.bodies.step();
  meet_regions(state, before, delta);
  state.work.stepped(state.bodies);
  delta.contacts = contacts_of_bodies(state);
  tell_of_hurts(state, delta);

  for (const PieceId id : state.bodies.beyond(world_half_m)) {
    if (is_body_of_person(state, id)) continue;  // its walker stays in the world
    if (state.props.contains(id)) {
      tell_of_prop(state, EventKind::prop_removed, id, delta);
      delta.told.back().text = "left the world";
      state.remove_prop(id);
      continue;
    }
    const Applied applied = state.apply_and_record(DiscardOperation{id}, state.traits_of(id).owner, delta);
    state.bodies.remove(id);
    state.ledger.pieces -= applied.dust;
    state.ledger.dust += applied.dust;
  }
}

/// For CHECK_DEBUG: pieces and bricks are in order, without duplicates.
bool is_ordered(const TickDelta& delta) {
  const auto ascend = [](const auto& list, auto key) {
    return std::ranges::adjacent_find(list, std::ranges::greater_equal{}, key) == list.end();
  };
  return ascend(delta.bricks, &BrickState::coord) && ascend(delta.pieces, &PieceState::id) &&
         ascend(delta.spawned, &SpawnedPiece::id) && ascend(delta.props, &PieceState::id) &&
         ascend(delta.props_spawned, &SpawnedProp::id) && ascend(delta.joints_added, &AddedJoint::id) &&
         ascend(delta.joints_removed, &EndedJoint::id);
}

/// Enters the bodies' hulls and contacts, and the searches for islands, for display.
void describe_physics(World::State& state, TickDelta& delta) {
  auto physics = std::make_shared<PhysicsMessage>();
  physics->tick = state.tick;
  state.bodies.describe(*physics);
  physics->searched = state.islands.waiting();
  delta.physics = std::move(physics);
}

void publish(World::State& state, TickDelta& delta) {
  tell_of_regions(state, delta);
  end_joints(state, delta);
  for (const BrickCoord coord : state.changed) {
    delta.bricks.push_back(state.brick_state(coord));
    state.scenes.forget(chunk_of(coord));
  }
  if (state.field.pages()) {
    std::set<ChunkCoord> chunks;
    for (const BrickCoord coord : state.changed) chunks.insert(chunk_of(coord));
    for (const ChunkCoord chunk : chunks) delta.chunks.push_back(state.chunk_state(chunk));
  }
  state.changed.clear();
  publish_poses(state, delta);
  publish_persons(state, delta);
  delta.stores = state.stores.take_changed();
  delta.region_masses = state.provenance.take_changed();
  delta.ledger = state.ledger;
  delta.materials = state.materials;
  state.work.report(delta.work);
  delta.field_hash = state.field.hash();
  delta.state_hash = state.hash();
  CHECK_EQ(delta.pieces.size(), state.pieces.size());
  CHECK_EQ(delta.props.size(), state.props.size());
  CHECK_DEBUG(is_ordered(delta));
  if (state.wants_physics && state.tick % ticks_per_physics == 0) describe_physics(state, delta);
  state.check();
}

/// Runs a stage; null for one that only runs within others.
using StageRun = void (*)(World::State& state, TickDelta& delta);

StageRun run_of(TickStage stage) {
  switch (stage) {
    case TickStage::requests:
      return carry_out;
    case TickStage::refracture:
      return refracture_pieces;
    case TickStage::spawn:
      return nullptr;
    case TickStage::persons:
      return walk_persons;
    case TickStage::bodies:
      return step_bodies;
    case TickStage::impacts:
      return apply_impacts;
    case TickStage::rest:
      return settle;
    case TickStage::recombine:
      return merge;
    case TickStage::buried:
      return merge_buried;
    case TickStage::slides:
      return slide_slopes;
    case TickStage::islands:
      return drop_islands;
    case TickStage::support:
      return break_overloads;
    case TickStage::specks:
      return sweep_specks;
    case TickStage::publish:
      return publish;
  }
  return nullptr;
}

/// Runs a stage and records its time, and whether it applied an operation.
void run_stage(TickStage stage, World::State& state, TickDelta& delta) {
  const StageRun run = run_of(stage);
  if (run == nullptr) return;
  const size_t before = delta.operations.size();
  const float spent_us = state.work.spent_us();
  state.stopwatch.switch_to(stage, delta.times);
  run(state, delta);
  delta.times.model_ms[index_of(stage)] += 1e-3 * static_cast<double>(state.work.spent_us() - spent_us);
  if (delta.operations.size() > before) delta.times.acted.set(index_of(stage));
}

}  // namespace

Result<std::unique_ptr<World>> World::create(const WorldConfig& config, size_t threads) {
  TRY(validate(config));
  TRY(check_ground(config));
  return std::make_unique<World>(config, threads);
}

World::World(const WorldConfig& config, size_t threads) {
  CHECK(validate(config).has_value() && check_ground(config).has_value());
  state_ = std::make_unique<State>(config, threads);
}
World::World(Made, std::unique_ptr<State> state) : state_(std::move(state)) {}
World::~World() = default;

std::shared_ptr<const TickDelta> World::step(std::span<const Command> commands) {
  State& s = *state_;
  CHECK(s.thread.is_the_same(), "another thread owns this world: it must call release_thread() first");
  auto delta = std::make_shared<TickDelta>();
  delta->tick = ++s.tick;
  if (s.tick == 1) publish_settings(s, *delta);
  s.stopwatch.restart(TickStage::requests);
  s.work.begin(s.bodies);
  delta->times.model_ms[index_of(TickStage::bodies)] = 1e-3 * static_cast<double>(s.work.spent_us());
  end_regions(s, *delta);
  end_signs(s, *delta);
  release_terrain(s);
  enqueue_commands(s, commands, *delta);
  for (const TickStageRow& row : tick_stages) run_stage(row.stage, s, *delta);
  s.stopwatch.switch_to(TickStage::requests, delta->times);
  s.spawn_place.follow(s.field, s.config.spawn, *delta);
  s.stones.follow(s.field, *delta);
  return delta;
}

const WorldConfig& World::config() const {
  return state_->config;
}
void World::want_physics(bool wanted) {
  state_->wants_physics = wanted;
}
void World::want_replaced(bool wanted) {
  state_->wants_replaced = wanted;
}
Tick World::tick() const {
  return state_->tick;
}
const std::vector<Region>& World::regions() const {
  return state_->regions.all();
}

std::vector<RegionMass> World::region_masses() const {
  return state_->provenance.masses();
}

std::vector<StoreContent> World::stores() const {
  return state_->stores.contents();
}

const Ledger& World::ledger() const {
  return state_->ledger;
}

const MaterialLedger& World::materials() const {
  return state_->materials;
}

std::vector<KnownJoint> World::joints() const {
  std::vector<KnownJoint> joints;
  joints.reserve(state_->joints.size());
  for (const auto& [id, one] : state_->joints) joints.push_back({id, *one.joint});
  return joints;
}

bool World::has_joint(JointId id) const {
  return state_->joints.contains(id);
}

const GameValue& World::game() const {
  return state_->game.value();
}

std::optional<BodyFacts> World::body(PieceId id) const {
  const State& s = *state_;
  const auto piece = s.pieces.find(id);
  const auto prop = s.props.find(id);
  if (piece == s.pieces.end() && prop == s.props.end()) return std::nullopt;
  const BodyState body = s.bodies.state(id);
  BodyFacts facts{.id = id,
                  .is_piece = piece != s.pieces.end(),
                  .pose = body.pose,
                  .velocity_m_s = body.velocity_m_s,
                  .spin_rad_s = body.spin_rad_s,
                  .mass_kg = s.bodies.mass_kg(id),
                  .reach_m = s.bodies.reach_m(id)};
  const PieceTraits traits = s.traits_of(id);
  facts.kept = traits.kept;
  facts.owner = traits.owner;
  facts.awake = s.bodies.is_awake(id);
  if (facts.is_piece) facts.mass = piece->second->mass;
  if (!facts.is_piece) facts.tag = prop->second.prop->tag;
  return facts;
}

std::vector<PieceId> World::bodies_near(glm::vec3 lo_m, glm::vec3 hi_m) const {
  return state_->bodies.near(lo_m, hi_m);
}

std::vector<PersonPlace> World::persons() const {
  TickDelta delta;
  publish_persons(*state_, delta);
  return std::move(delta.persons);
}

const Field& World::field() const {
  return state_->field;
}
HeldScene World::scene() const {
  State& s = *state_;
  s.scenes.begin(s.bodies.size());
  const std::vector<BodyState> bodies = s.bodies.states();
  const auto pose_of = [](const BodyState& body) { return dequantise(quantise(body.pose)); };
  for (const BodyState& body : bodies)
    if (const auto piece = s.pieces.find(body.id); piece != s.pieces.end())
      s.scenes.add_piece(body.id, pose_of(body), *piece->second);
  for (const BodyState& body : bodies)
    if (const auto prop = s.props.find(body.id); prop != s.props.end())
      s.scenes.add_prop(body.id, pose_of(body), prop->second.prop);
  return s.scenes.make(s.field);
}
FieldPaging World::paging() {
  return FieldPaging(state_->field);
}

void World::release_thread() {
  CHECK(state_->thread.is_the_same(), "only the thread that owns a world can release it");
  state_->bodies.release_thread();
  CHECK(state_->thread.release());  // last: from here on another thread may step
}

MassUnits World::measure_terrain() {
  return state_->measure_terrain();
}

}  // namespace scree
