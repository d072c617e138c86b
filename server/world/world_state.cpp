#include "server/world/world_state.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "server/bodies/prop_body.h"
#include "server/work/limits.h"
#include "server/work/memory.h"
#include "server/world/applied_operation.h"
#include "server/world/limits.h"
#include "server/world/region_masses.h"
#include "server/world/settings.h"
#include "server/world/shared_brick.h"
#include "server/world/slide_stage.h"
#include "server/world/state_hash.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/material/rubble.h"

namespace scree {

namespace {

/// Points by which a prop touches the terrain lie so far apart, about.
constexpr float prop_points_voxels = 2.0F;

BodiesConfig bodies_config(const WorldConfig& config, size_t threads) {
  BodiesConfig out;
  out.tick_rate_hz = config.tick_rate_hz;
  out.terrain_collider = config.methods.collider;
  out.air_drag = drag_of(config);
  out.threads = threads;
  out.palette = palette_with(config.palette, config.material_numbers);
  return out;
}

VoxelBox box_of(const std::vector<BrickCoord>& bricks) {
  CHECK(!bricks.empty());
  VoxelBox box{first_voxel(bricks.front()), first_voxel(bricks.front())};
  for (const BrickCoord brick : bricks) {
    const VoxelCoord v = first_voxel(brick);
    box.lo = {std::min(box.lo.x, v.x), std::min(box.lo.y, v.y), std::min(box.lo.z, v.z)};
    box.hi = {std::max(box.hi.x, v.x + brick_size), std::max(box.hi.y, v.y + brick_size),
              std::max(box.hi.z, v.z + brick_size)};
  }
  return box;
}

/// What may hang loose after an operation: islands or specks. Terrain around a fallen island was not
/// connected to it; a stamp may leave flakes, for which the merge looks itself (merge_stage.cpp). A slide
/// takes nothing from under anything, and near it may lie what fell, and must not fall again.
enum class Loose { nothing, islands, specks };

Loose left_by(const Operation& operation) {
  return std::visit(Overloaded{
                        [](const CarveOperation&) { return Loose::islands; },
                        [](const FillOperation&) { return Loose::islands; },
                        [](const StampOperation&) { return Loose::specks; },
                        [](const DiscardOperation&) { return Loose::nothing; },
                        [](const ShatterOperation&) { return Loose::nothing; },
                        [](const IslandOperation&) { return Loose::specks; },
                        [](const PaintOperation&) { return Loose::nothing; },
                        [](const SlideOperation&) { return Loose::specks; },
                        [](const DigOperation&) { return Loose::islands; },
                        [](const PlaceOperation&) { return Loose::islands; },
                        [](const RestoreOperation&) { return Loose::nothing; },  // its request says where
                    },
                    operation);
}

}  // namespace

void publish_poses(const World::State& state, TickDelta& delta) {
  for (const BodyState& body : state.bodies.states())
    (state.props.contains(body.id) ? delta.props : delta.pieces).push_back({body.id, quantise(body.pose)});
  for (const auto& [id, traits] : state.traits)
    if (traits.kept) delta.kept.push_back(id);
}

Tick wait_for_room(const World::State& state, uint64_t party, float price_us, Tick rest) {
  const float left_us = state.work.left_us();
  if (state.config.rules < rules::spare_time || is_crowding(state, party) || left_us <= 0.0F) return rest;
  const float ticks = std::ceil(price_us / (limits::spare_share * left_us));
  return ticks < static_cast<float>(rest) ? static_cast<Tick>(ticks) : rest;
}

float client_us_per_s(const WorkBudget& work, const WorldConfig& config) {
  return limits::requests_share * work.budget_us() * static_cast<float>(config.tick_rate_hz);
}

namespace {

/// Rubble is what the palette says, and in worlds of older rules nothing is.
WorldConfig with_rubble_of_palette(WorldConfig config) {
  config.terrain.rubble = config.rules >= rules::rubble ? Rubble(rubble_rows(*config.palette)) : Rubble();
  return config;
}

}  // namespace

World::State::State(const WorldConfig& world_config, size_t threads)
    : config(with_rubble_of_palette(world_config)),
      palette(palette_with(config.palette, config.material_numbers)),
      field(config.terrain),
      regions(config.terrain.voxel_size_m),
      bodies(field, bodies_config(config, threads)),
      rest(RestConfig{}, config.tick_rate_hz),
      work(config.tick_rate_hz, config.work_percent),
      requests(client_us_per_s(work, config)) {
  // A host's numbers become what files and clients read of them.
  CHECK(set_all(config, print(config)));
  field.bound_generated(generated_bytes_within(config.memory_max_mb));
}

namespace {

void add(BricksByParty& to, uint64_t party, const std::vector<BrickCoord>& bricks) {
  if (!bricks.empty()) to[party].insert(bricks.begin(), bricks.end());
}

}  // namespace

Applied World::State::apply_and_record(const Operation& operation, uint64_t party, TickDelta& delta,
                                       const PreparedStamp* prepared, const StoreName* store) {
  const VoxelBox reads = read_box(operation, pieces, config.terrain.voxel_size_m);
  const auto trace = begin_trace(*this, operation, reads, store);
  if (wants_replaced) field.note_replaced(&replaced);
  Applied applied = apply(operation, field, pieces, prepared);
  field.note_replaced(nullptr);
  const bool slid = std::holds_alternative<SlideOperation>(operation);
  if (slid && applied.changed.empty()) return applied;  // nothing happened, so there is nothing to tell
  CHECK_DEBUG(std::ranges::adjacent_find(applied.changed, std::ranges::greater_equal{}) ==
              applied.changed.end());
  delta.operations.push_back(describe(operation, reads, applied));
  delta.operations.back().stage = stopwatch.stage();
  delta.operations.back().party = party;
  if (wants_replaced)
    for (BrickPatch& brick : std::exchange(replaced, {}))
      delta.replaced.push_back({delta.operations.size() - 1, std::move(brick)});
  changed.insert(applied.changed.begin(), applied.changed.end());
  const Loose loose = left_by(operation);
  party = charged(party);
  if (loose == Loose::islands) loosen(party, applied.changed);
  const bool looks_around = !std::holds_alternative<RestoreOperation>(operation);  // its request says where
  if (config.methods.support && looks_around) add(strained, party, applied.changed);
  if (loose == Loose::specks) add(unswept, party, applied.changed);
  if (!applied.changed.empty()) bodies.terrain_changed(box_of(applied.changed));
  struck.forget(applied.changed);
  if (config.rules >= rules::slides && looks_around)
    for (const BrickCoord brick : applied.changed) slopes[party].insert(slope_of(brick));
  if (applied.terrain_gain > 0 || slid) gained.push_back(box_of(applied.changed));
  ledger.terrain += applied.terrain_gain;
  CHECK(materials.enter(applied.flows));
  finish_trace(*this, trace, operation, applied, delta.operations.back().party);
  for (const PieceId ended : pieces_ended_by(operation)) {
    CHECK(!pieces.contains(ended));
    shares.remove(traits.at(ended).owner);
    traits.erase(ended);
  }
  return applied;
}

void World::State::loosen(uint64_t party, const std::vector<BrickCoord>& bricks) {
  add(loosened_bricks, charged(party), bricks);
}

void World::State::enter_removed(const Applied& applied) {
  CHECK(applied.dust >= 0);
  ledger.moved -= applied.terrain_gain;
  ledger.dust += applied.dust;
  ledger.pieces -= applied.terrain_gain + applied.dust;
}

PieceTraits World::State::traits_of(PieceId id) const {
  if (const auto prop = props.find(id); prop != props.end()) return {.owner = prop->second.owner};
  const auto found = traits.find(id);
  return found == traits.end() ? PieceTraits{} : found->second;
}

bool World::State::in_world(BrickCoord brick) const {
  const VoxelCoord v = first_voxel(brick);
  const auto most = static_cast<int>(2.0F * limits::world_half_width_m / config.terrain.voxel_size_m);
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= most;
}

MassUnits World::State::mass_of_pieces() const {
  MassUnits mass = 0;
  for (const auto& [id, volume] : pieces) mass += volume->mass;
  return mass;
}

uint64_t World::State::hash() const {
  uint64_t sum_of_props = 0;
  for (const auto& [id, one] : props) sum_of_props += one.hash;
  uint64_t sum_of_joints = 0;
  for (const auto& [id, one] : joints) sum_of_joints += one.hash;
  uint64_t sum_of_kept = 0;
  for (const auto& [id, one] : traits) sum_of_kept += one.kept ? hash_of_kept(id) : 0;
  uint64_t sum_of_persons = 0;
  for (const auto& [session, person] : persons) sum_of_persons += hash_of(person);
  return state_hash({tick, field.hash(), bodies.state_hash(), next_piece, ledger, sum_of_props, sum_of_joints,
                     sum_of_kept, regions.hash(), sum_of_persons, stores.hash(), provenance.hash(),
                     game.hash()});
}

BodyShape World::State::enter_prop(PieceId id, std::shared_ptr<const Prop> prop, const PropMeasure& measure,
                                   uint64_t owner) {
  CHECK(prop != nullptr && prop->mass_kg > 0.0F);
  BodyShape shape =
      body_shape_of(*prop, measure, prop->mass_kg, prop_points_voxels * config.terrain.voxel_size_m);
  const uint64_t hash = hash_of(id, *prop, owner);
  const bool is_new = props.try_emplace(id, WorldProp{std::move(prop), owner, hash}).second;
  CHECK(is_new && !pieces.contains(id));
  return shape;
}

void World::State::remove_prop(PieceId id) {
  const size_t removed = props.erase(id);
  CHECK_EQ(removed, 1U);
  bodies.remove(id);
}

BrickState World::State::brick_state(BrickCoord coord) {
  std::shared_ptr<const Brick> brick = shared_copy(field.brick(coord));
  const BrickMaterials materials = field.materials(coord);
  const uint64_t hash = brick_hash(coord, *brick, materials);
  return {coord, std::move(brick), hash, materials};
}

ChunkState World::State::chunk_state(ChunkCoord chunk) const {
  uint64_t edited = 0;
  for (const BrickCoord brick : field.edited_bricks(chunk)) edited |= uint64_t{1} << index_in_chunk(brick);
  return {chunk, field.chunk_hash(chunk), edited};
}

MassUnits World::State::measure_terrain(const GroundMasses& ground) {
  MassUnits gain = 0;
  for (const ChunkCoord chunk : field.edited_chunks()) {
    const auto known = ground.find(chunk);
    if (known != ground.end()) gain -= known->second;
    const std::optional<PagedChunk> paged = field.paged(chunk);
    if (paged) gain += paged->mass;
    if (paged && known != ground.end()) continue;
    for (const BrickCoord coord : field.edited_bricks(chunk)) {
      if (!paged) gain += brick_mass(field.source(), coord, field.brick(coord), field.materials(coord));
      if (known != ground.end()) continue;
      const GeneratedChunk& generated = field.chunk_bricks(chunk).generated;
      gain -= ground_mass(field.source(), coord, generated);
    }
  }
  return gain;
}

void World::State::check() const {
  CHECK(ledger.error() == 0);
  CHECK(ledger.pieces >= 0 && ledger.dust >= 0 && ledger.moved >= 0);
  CHECK_EQ(ledger.stored, stores.mass());
  CHECK_EQ(bodies.size(), pieces.size() + props.size());
  CHECK_EQ(bodies.joints(), joints.size());
  CHECK_EQ(traits.size(), pieces.size());
  CHECK(pieces.empty() || pieces.rbegin()->first < next_piece);
  CHECK(props.empty() || props.rbegin()->first < next_piece);
  CHECK(joints.empty() || joints.rbegin()->first < next_piece);
  CHECK(requests.size() <= limits::requests_waiting_max);
  CHECK(persons.size() <= props.size());
  CHECK(materials.agrees(ledger));
  CHECK_DEBUG(ledger.pieces == mass_of_pieces());
  CHECK_DEBUG(std::ranges::all_of(pieces, [this](const auto& piece) {
    return bodies.contains(piece.first) && traits.contains(piece.first);
  }));
  CHECK_DEBUG(std::ranges::all_of(persons,
                                  [this](const auto& person) { return props.contains(person.second.body); }));
}

}  // namespace scree
