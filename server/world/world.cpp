#include "server/world/world.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>

#include "server/bodies/bodies.h"
#include "server/field/vdb_field.h"
#include "server/fracture/hull.h"
#include "server/recombine/rest.h"
#include "server/world/applied_operation.h"
#include "server/world/limits.h"
#include "server/world/state_hash.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "shared/field/stamp.h"

namespace scree {

namespace {

BodiesConfig bodies_config(const WorldConfig& config) {
  BodiesConfig out;
  out.tick_rate_hz = config.tick_rate_hz;
  return out;
}

VoxelBox box_of(const std::vector<BrickCoord>& bricks) {
  VoxelBox box{first_voxel(bricks.front()), first_voxel(bricks.front())};
  for (const BrickCoord brick : bricks) {
    const VoxelCoord v = first_voxel(brick);
    box.lo = {std::min(box.lo.x, v.x), std::min(box.lo.y, v.y), std::min(box.lo.z, v.z)};
    box.hi = {std::max(box.hi.x, v.x + brick_size), std::max(box.hi.y, v.y + brick_size),
              std::max(box.hi.z, v.z + brick_size)};
  }
  return box;
}

/// A blow sends a piece away from the impact, the less the farther off, and sets it spinning.
BodyState blast(PieceId id, glm::vec3 centre_m, const CarveRequest& request) {
  const glm::vec3 away = centre_m - request.impact_m;
  const float distance_m = std::sqrt(glm::dot(away, away));
  // A lift along up: a blow against flat ground would otherwise press half of the pieces into it.
  const glm::vec3 direction = away / std::max(distance_m, 0.01F) + glm::vec3(0.0F, 0.7F, 0.0F);
  const float reach_m = std::max(reach_of(request.shape), 0.01F);
  const float speed = request.blast_speed_m_s * reach_m / (reach_m + distance_m);
  Random random(request.random_seed * 0x9E3779B97F4A7C15ULL + id);
  const auto spin = [&] { return (random.unit() - 0.5F) * speed; };
  BodyState state;
  state.id = id;
  state.pose.position_m = centre_m;
  state.velocity_m_s = direction * speed;
  state.spin_rad_s = {spin(), spin(), spin()};
  return state;
}

bool outside_world(glm::vec3 p) {
  return std::abs(p.x) > limits::world_half_width_m || std::abs(p.z) > limits::world_half_width_m ||
         std::abs(p.y) > limits::world_half_height_m;
}

}  // namespace

struct World::State {
  explicit State(const WorldConfig& c)
      : config(c), field(c.terrain), bodies(field, bodies_config(c)), rest(RestConfig{}, c.tick_rate_hz) {}

  void execute(const Command& command, TickDelta& delta);
  Result<uint32_t> carve(const CarveRequest& request, TickDelta& delta);
  Result<uint32_t> fill(const FillRequest& request, TickDelta& delta);
  Applied apply_and_record(const Operation& operation, TickDelta& delta);
  void spawn(const Applied& applied, const CarveRequest& request, TickDelta& delta);
  void discard_lost(TickDelta& delta);
  std::vector<PieceId> settled();
  void merge(PieceId id, TickDelta& delta);
  void publish(TickDelta& delta);

  WorldConfig config;
  VdbField field;
  PieceTable pieces;
  Bodies bodies;
  RestDetector rest;
  Ledger ledger;
  Tick tick = 0;
  PieceId next_piece = 1;
  std::set<BrickCoord> changed;  ///< in this tick
};

Applied World::State::apply_and_record(const Operation& operation, TickDelta& delta) {
  const VoxelBox reads = read_box(operation, pieces, config.terrain.voxel_size_m);
  Applied applied = apply(operation, field, pieces);
  delta.operations.push_back(describe(operation, reads, applied));
  changed.insert(applied.changed.begin(), applied.changed.end());
  if (!applied.changed.empty()) bodies.terrain_changed(box_of(applied.changed));
  ledger.terrain += applied.terrain_gain;
  return applied;
}

Result<uint32_t> World::State::carve(const CarveRequest& request, TickDelta& delta) {
  const CarveOperation operation{request.shape,       request.pattern,  request.seeds,
                                 request.random_seed, request.impact_m, next_piece};
  if (Result<void> valid = validate(Operation(operation), pieces); !valid)
    return tl::unexpected(valid.error());
  if (!std::isfinite(request.blast_speed_m_s) || request.blast_speed_m_s < 0.0F ||
      request.blast_speed_m_s > limits::blast_speed_max_m_s)
    return fail("the blast speed is not within 0 … " + std::to_string(limits::blast_speed_max_m_s) +
                " m/s (limits.blast_speed_max_m_s)");
  if (pieces.size() + request.seeds > config.pieces_max)
    return fail(std::to_string(pieces.size()) + " pieces are alive and the carve may add " +
                std::to_string(request.seeds) + "; this server's limit is " +
                std::to_string(config.pieces_max) + " (pieces_max): wait until some have settled");
  Stopwatch watch;
  const Applied applied = apply_and_record(operation, delta);
  ledger.moved -= applied.terrain_gain;
  ledger.dust += applied.dust;
  ledger.pieces -= applied.terrain_gain + applied.dust;
  delta.times.carve_ms += watch.lap_ms();
  spawn(applied, request, delta);
  delta.times.spawn_ms += watch.lap_ms();
  return static_cast<uint32_t>(applied.created.size());
}

void World::State::spawn(const Applied& applied, const CarveRequest& request, TickDelta& delta) {
  const float dx = config.terrain.voxel_size_m;
  for (const PieceHull& hull : make_hulls(applied, pieces, dx)) {
    const std::shared_ptr<const Volume>& volume = pieces.at(hull.id);
    const float mass_kg = hull.size_m3 * limits::rock_density_kg_m3;
    bodies.add({hull.corners_m, mass_kg, hull.inertia_m2 * mass_kg},
               blast(hull.id, volume->centre_voxels * dx, request));
    delta.spawned.push_back({hull.id, volume});
    next_piece = hull.id + 1;
  }
}

Result<uint32_t> World::State::fill(const FillRequest& request, TickDelta& delta) {
  const FillOperation operation{request.shape};
  if (Result<void> valid = validate(Operation(operation), pieces); !valid)
    return tl::unexpected(valid.error());
  Stopwatch watch;
  const Applied applied = apply_and_record(operation, delta);
  ledger.poured += applied.terrain_gain;
  delta.times.carve_ms += watch.lap_ms();
  return 0U;
}

void World::State::execute(const Command& command, TickDelta& delta) {
  const auto* carve_request = std::get_if<CarveRequest>(&command.body);
  const Result<uint32_t> made = carve_request != nullptr ? carve(*carve_request, delta)
                                                         : fill(std::get<FillRequest>(command.body), delta);
  Reply reply{command.session, command.request, {}, 0};
  if (made) {
    reply.pieces = *made;
  } else {
    reply.refusal = made.error().message;
  }
  delta.replies.push_back(std::move(reply));
}

void World::State::discard_lost(TickDelta& delta) {
  for (const BodyState& body : bodies.states()) {
    if (!outside_world(body.pose.position_m)) continue;
    const Applied applied = apply_and_record(DiscardOperation{body.id}, delta);
    bodies.remove(body.id);
    ledger.pieces -= applied.dust;
    ledger.dust += applied.dust;
  }
}

std::vector<PieceId> World::State::settled() {
  std::vector<RestPiece> alive;
  for (const BodyState& body : bodies.states())
    alive.push_back({body.id, body.pose, bodies.reach_m(body.id)});
  const BodyContacts contacts = bodies.contacts();
  std::vector<RestSupport> supports;
  for (const Carried& carried : contacts.carried) supports.push_back({carried.upper, carried.lower});
  return rest.update(alive, contacts.on_terrain, supports, config.merges_per_tick_max);
}

/// The field gains what the piece weighed, and with it the dust that earlier merges could not place.
void World::State::merge(PieceId id, TickDelta& delta) {
  const float dx = config.terrain.voxel_size_m;
  const std::shared_ptr<const Volume> volume = pieces.at(id);
  StampOperation operation{id, quantise(bodies.state(id).pose), 0};
  const Window window = gather(field, stamp_box(*volume, operation.pose, dx));
  operation.shift = plan_stamp(window, *volume, operation.pose, dx, volume->mass + ledger.dust).shift;
  bodies.remove(id);
  const Applied applied = apply_and_record(operation, delta);
  ledger.pieces -= volume->mass;
  ledger.dust += volume->mass - applied.terrain_gain;
}

void World::State::publish(TickDelta& delta) {
  for (const BrickCoord coord : changed) {
    auto brick = std::make_shared<const Brick>(field.brick(coord));
    const uint64_t hash = brick_hash(coord, *brick);
    delta.bricks.push_back({coord, std::move(brick), hash});
  }
  changed.clear();
  for (const BodyState& body : bodies.states()) delta.pieces.push_back({body.id, quantise(body.pose)});
  delta.ledger = ledger;
  delta.field_hash = field.hash();
  delta.state_hash = state_hash({tick, delta.field_hash, bodies.state_hash(), next_piece, ledger});
}

World::World(const WorldConfig& config) : state_(std::make_unique<State>(config)) {}
World::~World() = default;

std::shared_ptr<const TickDelta> World::step(std::span<const Command> commands) {
  State& s = *state_;
  Stopwatch whole, watch;
  auto delta = std::make_shared<TickDelta>();
  delta->tick = ++s.tick;
  for (const Command& command : commands) s.execute(command, *delta);
  watch.lap_ms();
  s.bodies.step();
  s.discard_lost(*delta);
  delta->times.bodies_ms = watch.lap_ms();
  const std::vector<PieceId> at_rest = s.settled();
  delta->times.rest_ms = watch.lap_ms();
  for (const PieceId id : at_rest) s.merge(id, *delta);
  delta->times.recombine_ms = watch.lap_ms();
  s.publish(*delta);
  CHECK(s.ledger.error() == 0);
  delta->times.publish_ms = watch.lap_ms();
  delta->times.total_ms = whole.lap_ms();
  return delta;
}

const WorldConfig& World::config() const {
  return state_->config;
}
Tick World::tick() const {
  return state_->tick;
}
Field& World::field() {
  return state_->field;
}

MassUnits World::measure_terrain() {
  Field& field = state_->field;
  MassUnits gain = 0;
  for (const ChunkCoord chunk : field.edited_chunks())
    for (const BrickCoord coord : field.edited_bricks(chunk))
      gain += brick_mass(field.brick(coord)) - brick_mass(field.generated_brick(coord));
  return gain;
}

}  // namespace scree
