// World::snapshot() and restore(), and what a world is at once.
#include "server/world/world_snapshot.h"

#include <algorithm>
#include <cmath>

#include "server/world/joint_requests.h"
#include "server/world/limits.h"
#include "server/world/person_requests.h"
#include "server/world/recorded_values.h"
#include "server/world/refracture_stage.h"
#include "server/world/region_masses.h"
#include "server/world/region_requests.h"
#include "server/world/request_stage.h"
#include "server/world/store_requests.h"
#include "server/world/world_state.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

/// A hull or a surface may reach so far beyond its voxels: the narrow band and a corner; voxels.
constexpr float shape_slack_voxels = 4.0F;

/// Ticks that a world may have counted: so many that no sum overflows.
constexpr Tick tick_max = Tick{1} << 62U;

/// Ids that pieces may have had, so that there are some left.
constexpr PieceId next_piece_max = UINT32_MAX - (PieceId{1} << 24U);

/// Takes a value apart into a new state. Each step refuses what does not agree with those before it.
class Restoring {
 public:
  /// `measure`: masses and hashes are not compared but taken as they are measured.
  Restoring(World::State& state, const WorldSnapshot& value, const GroundMasses& ground,
            const PagedTerrain* paged, bool measure)
      : s_(state), value_(value), m_(value.moment), ground_(ground), paged_(paged), measure_(measure) {}

  Result<void> run() {
    using Step = Result<void> (Restoring::*)();
    for (const Step step :
         {&Restoring::clock, &Restoring::terrain, &Restoring::pieces, &Restoring::props, &Restoring::bodies,
          &Restoring::regions, &Restoring::persons, &Restoring::ledger, &Restoring::provenance,
          &Restoring::places, &Restoring::waiting, &Restoring::refractures, &Restoring::game})
      TRY((this->*step)());
    s_.rest.restore(m_.rest);
    s_.islands.restore(m_.islands);
    s_.buried = {m_.buried.begin(), m_.buried.end()};
    s_.sunk = {m_.sunk.begin(), m_.sunk.end()};
    s_.stones.restart(s_.pieces, m_.stones, m_.next_piece, s_.field);
    if (!measure_ && s_.hash() != m_.state_hash) return fail("its hash is not that of its parts");
    s_.check();
    return {};
  }

 private:
  Result<void> clock() {
    for (const Tick tick : {m_.refractured_at, m_.island_at, m_.requested})
      if (tick > m_.tick) return fail("something happened after its tick");
    if (m_.tick > tick_max) return fail("its tick is beyond any");
    if (m_.next_piece > next_piece_max) return fail("its pieces' ids are used up");
    s_.tick = m_.tick;
    s_.refractured_at = m_.refractured_at;
    s_.island_at = m_.island_at;
    s_.requested = m_.requested;
    s_.next_piece = m_.next_piece;
    return {};
  }

  Result<void> enter(std::span<const BrickPatch> bricks) {
    const BrickPatch* last = nullptr;
    for (const BrickPatch& patch : bricks) {
      if (last != nullptr && !(last->coord < patch.coord)) return fail("its bricks are not in order");
      if (!s_.in_world(patch.coord)) return fail("a brick lies outside the world");
      s_.field.set_brick(patch.coord, patch.brick, patch.materials);
      last = &patch;
    }
    return {};
  }

  /// A chunk that comes after memory is full is out from the start.
  Result<void> enter_paged(const PagedTerrain& from) {
    s_.field.page_by(from.read);
    return from.each([&](ChunkCoord chunk, std::span<const BrickPatch> bricks) -> Result<void> {
      if (bricks.empty() || s_.field.has_edits(chunk)) return fail("a chunk comes twice, or without bricks");
      if (s_.field.bricks_in() < from.bricks_max) return enter(bricks);
      const auto left = TRY(paged_of(s_.field.source(), chunk, bricks));
      for (const BrickPatch& patch : bricks)
        if (!s_.in_world(patch.coord)) return fail("a brick lies outside the world");
      s_.field.add_out(chunk, left);
      return {};
    });
  }

  Result<void> terrain() {
    TRY(enter(value_.bricks));
    if (paged_ != nullptr) TRY(enter_paged(*paged_));
    if (!measure_ && s_.field.hash() != m_.field_hash)
      return fail("its terrain is not the one that was saved");
    return {};
  }

  /// A hostile hull could be so large that nothing ends.
  bool is_within(const PieceRecord& piece, const std::vector<glm::vec3>& points_m) const {
    const VoxelCoord size = piece.volume->window.box.size();
    const float reach_m = (static_cast<float>(std::max({size.x, size.y, size.z})) + shape_slack_voxels) *
                          s_.config.terrain.voxel_size_m;
    return std::ranges::all_of(points_m, [&](glm::vec3 p) {
      return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= reach_m;
    });
  }

  Result<void> pieces() {
    if (m_.pieces.size() + m_.props.size() != m_.motion.bodies.size() ||
        m_.pieces.size() > limits::pieces_max_max)
      return fail("it has " + std::to_string(m_.pieces.size()) + " pieces, " +
                  std::to_string(m_.props.size()) + " props and " + std::to_string(m_.motion.bodies.size()) +
                  " bodies; a world has at most " + std::to_string(limits::pieces_max_max) +
                  " pieces (limits.pieces_max_max)");
    for (const PieceRecord& piece : m_.pieces) {
      if (piece.id == 0 || piece.id >= m_.next_piece)
        return fail("piece " + std::to_string(piece.id) + " has no body, or is none yet");
      const auto within = [&](const std::vector<glm::vec3>& points) { return is_within(piece, points); };
      const BodyShape& shape = *piece.shape;
      if (!within(shape.hull_m) || !within(shape.surface_m) || !std::ranges::all_of(shape.parts_m, within))
        return fail("the body of piece " + std::to_string(piece.id) + " reaches beyond its voxels");
      if (!s_.pieces.emplace(piece.id, piece.volume).second)
        return fail("piece " + std::to_string(piece.id) + " comes twice");
      s_.traits[piece.id] = piece.traits;
      s_.shares.add(piece.traits.owner);
    }
    return {};
  }

  Result<void> props() {
    if (m_.props.size() > limits::props_max_max)
      return fail("it has " + std::to_string(m_.props.size()) + " props; a world has at most " +
                  std::to_string(limits::props_max_max) + " (limits.props_max_max)");
    for (const PropRecord& record : m_.props) {
      const std::string which = "prop " + std::to_string(record.id);
      if (record.id == 0 || record.id >= m_.next_piece || s_.pieces.contains(record.id) ||
          s_.props.contains(record.id))
        return fail(which + " is none yet, or comes twice");
      if (const Result<void> valid = validate_bounds(*record.prop); !valid)
        return fail(which + ": " + valid.error().message);
      const Result<PropMeasure> measure = measure_checked(*record.prop);
      if (!measure) return fail(which + ": " + measure.error().message);
      if (!(record.prop->mass_kg > 0.0F) || !s_.palette->has(record.prop->material))
        return fail(which + " has no mass, or is of no material that the palette has");
      shapes_of_props_[record.id] =
          std::make_shared<const BodyShape>(s_.enter_prop(record.id, record.prop, *measure, record.owner));
    }
    return {};
  }

  Result<void> bodies() {
    std::map<PieceId, std::shared_ptr<const BodyShape>> by_id = shapes_of_props_;
    for (const PieceRecord& piece : m_.pieces) by_id[piece.id] = piece.shape;
    std::vector<std::shared_ptr<const BodyShape>> shapes;
    for (const BodyMotion& motion : m_.motion.bodies) {
      const auto found = by_id.find(motion.id);
      if (found == by_id.end()) return fail("a body is of no piece and of no prop");
      shapes.push_back(found->second);
    }
    for (const VoxelBox& box : m_.motion.changes)
      if (!is_sane(box)) return fail("terrain changed outside the world");
    const std::vector<KnownJoint> joints = TRY(restore_joints(s_, m_.joints));
    return s_.bodies.restore(shapes, m_.motion, joints);
  }

  Result<void> regions() { return restore_regions(s_, m_); }

  Result<void> persons() { return restore_persons(s_, m_); }

  Result<void> game() { return s_.game.restore(m_.game); }

  /// Who measures anew does not know it.
  Result<void> provenance() { return measure_ ? Result<void>() : restore_provenance(s_, m_.provenance); }

  /// Worlds of older programs have none, and who measures anew knows the whole alone.
  Result<void> materials() {
    s_.materials = m_.materials;
    if (!measure_ && !m_.materials.rows().empty()) {
      if (s_.materials.agrees(s_.ledger) && holds_stores()) return {};
      return fail("the ledgers of its materials do not add up to its ledger");
    }
    MaterialMasses of_pieces;
    for (const auto& [id, volume] : s_.pieces) add(of_pieces, masses_of(*volume));
    s_.materials = MaterialLedger(s_.ledger, of_pieces, s_.config.terrain.rows.bulk, s_.stores.masses());
    return {};
  }

  /// Whether each material's ledger has what the stores have of it.
  bool holds_stores() const {
    MaterialMasses of_rows;
    for (size_t row = 0; row < s_.materials.rows().size(); ++row)
      if (const MassUnits mass = s_.materials.rows()[row].stored; mass != 0)
        add(of_rows, static_cast<Material>(row), mass);
    return of_rows == s_.stores.masses();
  }

  Result<void> ledger() {
    const Ledger said = m_.ledger;
    constexpr MassUnits most = limits::ledger_mass_max;
    for (const MassUnits mass : {said.terrain, said.pieces, said.dust, said.poured, said.moved, said.stored})
      if (mass < -most || mass > most)
        return fail("its ledger has more than there can be (limits.ledger_mass_max)");
    TRY(restore_stores(s_, m_.stores));
    s_.ledger = measure_ ? measured() : m_.ledger;
    const Ledger& ledger = s_.ledger;
    for (const MassUnits mass : {ledger.pieces, ledger.dust, ledger.moved})
      if (mass < 0) return fail("its ledger has less than nothing");
    if (ledger.pieces != s_.mass_of_pieces()) return fail("its ledger does not hold the mass of its pieces");
    if (!measure_ && ledger.terrain != s_.measure_terrain(ground_))
      return fail("its ledger does not hold the mass of its terrain");
    if (ledger.stored != s_.stores.mass()) return fail("its ledger does not hold the mass of its stores");
    if (ledger.error() != 0) return fail("its ledger does not balance");
    return materials();
  }

  /// What is there, with its dust; what is missing was poured, or became dust.
  Ledger measured() {
    Ledger ledger = m_.ledger;
    ledger.terrain = s_.measure_terrain(ground_);
    ledger.pieces = s_.mass_of_pieces();
    ledger.stored = s_.stores.mass();
    ledger.poured += ledger.error();
    if (ledger.poured >= 0) return ledger;
    ledger.dust -= ledger.poured;
    ledger.poured = 0;
    return ledger;
  }

  bool is_sane(const VoxelBox& box) const {
    return !box.empty() && s_.in_world(brick_of(box.lo)) && s_.in_world(brick_of(box.hi));
  }

  Result<void> places() {
    for (const auto* parties : {&m_.loosened_bricks, &m_.strained, &m_.slopes})
      for (const PartyBricks& one : *parties)
        if (!std::ranges::all_of(one.bricks, [&](BrickCoord brick) { return s_.in_world(brick); }))
          return fail("a changed brick lies outside the world");
    for (const LooseningEdit& search : m_.islands)
      if (!std::ranges::all_of(search.bricks, [&](BrickCoord brick) { return s_.in_world(brick); }))
        return fail("a searched brick lies outside the world");
    if (!std::ranges::all_of(m_.gained, [&](const VoxelBox& box) { return is_sane(box); }))
      return fail("terrain gained rock outside the world");
    for (const auto& [party, bricks] : m_.loosened_bricks) s_.loosen(party, bricks);
    for (const auto& [party, bricks] : m_.strained)
      if (!bricks.empty()) s_.strained[s_.charged(party)].insert(bricks.begin(), bricks.end());
    for (const auto& [party, bricks] : m_.slopes)
      if (!bricks.empty()) s_.slopes[s_.charged(party)].insert(bricks.begin(), bricks.end());
    s_.gained = m_.gained;
    return struck();
  }

  Result<void> struck() {
    if (m_.struck.size() > limits::struck_places_max) return fail("blows struck too many places");
    for (size_t i = 0; i < m_.struck.size(); ++i) {
      const StruckPlace& place = m_.struck[i];
      const bool ascends = i == 0 || m_.struck[i - 1].cell < place.cell;
      if (!ascends || place.at > m_.tick || !s_.in_world(brick_of_place(place.cell)))
        return fail("a place that blows struck is out of order, later than now, or outside the world");
    }
    s_.struck.restore(m_.struck);
    return {};
  }

  Result<void> waiting() {
    s_.work.owe(m_.debt_us);
    for (const PartyValue& party : m_.requests.parties)
      for (const SessionValue& session : party.sessions)
        for (const WaitingValue& request : session.requests) {
          if (request.since > m_.tick || !may_wait_for_turn(s_, request.command))
            return fail("a waiting request is not valid");
        }
    return s_.requests.restore(m_.requests);
  }

  Result<void> refractures() {
    for (const PendingRefracture& pending : m_.refractures) {
      if (pending.pieces < 2 || pending.pieces > limits::seeds_max)
        return fail("a piece is to be cut into no pieces, or too many");
      TRY(validate_shatter_pattern(pending.pattern));
      if (pending.thrown_by != nullptr && !may_wait_for_turn(s_, {0, 0, *pending.thrown_by}))
        return fail("a cut's pieces are thrown by an operation that is not a carve");
      enter_refracture(s_, pending);
    }
    return {};
  }

  World::State& s_;
  const WorldSnapshot& value_;
  const WorldMoment& m_;
  const GroundMasses& ground_;
  const PagedTerrain* const paged_;  ///< null: all terrain is in the value
  const bool measure_;
  std::map<PieceId, std::shared_ptr<const BodyShape>> shapes_of_props_;
};

Result<std::unique_ptr<World::State>> state_of(const WorldSnapshot& value, size_t threads,
                                               const GroundMasses& ground, const PagedTerrain* paged,
                                               bool measure) {
  const auto config = config_of(value.moment.config);
  TRY(config);
  TRY(check_ground(*config));
  auto state = std::make_unique<World::State>(*config, threads);
  if (Result<void> done = Restoring(*state, value, ground, paged, measure).run(); !done)
    return fail("the world cannot go on: " + done.error().message);
  return state;
}

}  // namespace

Result<std::unique_ptr<World>> World::restore(const WorldSnapshot& value, size_t threads,
                                              const GroundMasses& ground) {
  auto state = TRY(state_of(value, threads, ground, nullptr, false));
  return std::unique_ptr<World>(new World(Made{}, std::move(state)));
}

Result<std::unique_ptr<World>> World::restore(const WorldSnapshot& value, const PagedTerrain& terrain,
                                              size_t threads, const GroundMasses& ground) {
  CHECK(value.bricks.empty());
  auto state = TRY(state_of(value, threads, ground, &terrain, false));
  return std::unique_ptr<World>(new World(Made{}, std::move(state)));
}

Result<std::unique_ptr<World>> World::salvage(WorldSnapshot value) {
  return salvaged(std::move(value), nullptr, {});
}

Result<std::unique_ptr<World>> World::salvage(WorldSnapshot value, const PagedTerrain& terrain,
                                              const GroundMasses& ground) {
  CHECK(value.bricks.empty());
  return salvaged(std::move(value), &terrain, ground);
}

Result<std::unique_ptr<World>> World::salvaged(WorldSnapshot value, const PagedTerrain* terrain,
                                               const GroundMasses& ground) {
  WorldMoment& moment = value.moment;
  std::vector<PieceRecord> pieces;
  std::vector<BodyMotion> bodies;
  for (const PieceRecord& piece : moment.pieces) {
    const auto body = std::ranges::find(moment.motion.bodies, piece.id, &BodyMotion::id);
    if (body == moment.motion.bodies.end()) continue;
    pieces.push_back(piece);
    bodies.push_back(*body);
  }
  std::vector<PropRecord> props;
  for (const PropRecord& prop : moment.props) {
    const auto body = std::ranges::find(moment.motion.bodies, prop.id, &BodyMotion::id);
    if (body == moment.motion.bodies.end()) continue;
    props.push_back(prop);
    bodies.push_back(*body);
  }
  std::ranges::sort(bodies, {}, &BodyMotion::id);
  moment.pieces = std::move(pieces);
  moment.props = std::move(props);
  moment.motion.bodies = std::move(bodies);
  drop_joints_without(moment.motion.bodies, moment.joints);
  std::erase_if(moment.persons, [&](const PersonRecord& person) {
    return std::ranges::find(moment.props, person.body, &PropRecord::id) == moment.props.end();
  });
  auto state = TRY(state_of(value, 1, ground, terrain, true));
  return std::unique_ptr<World>(new World(Made{}, std::move(state)));
}

WorldSnapshot World::snapshot() {
  WorldSnapshot value{moment(), {}};
  for (const ChunkCoord coord : state_->field.edited_chunks()) {
    const std::vector<BrickPatch> bricks = chunk(coord);
    value.bricks.insert(value.bricks.end(), bricks.begin(), bricks.end());
  }
  std::ranges::sort(value.bricks, {}, &BrickPatch::coord);
  return value;
}

std::vector<BrickPatch> World::chunk(ChunkCoord chunk) {
  Field& field = state_->field;
  std::vector<BrickPatch> bricks;
  const bool was_out = field.is_out(chunk);
  for (const BrickCoord coord : field.edited_bricks(chunk))
    bricks.push_back({coord, field.brick(coord), field.materials(coord)});
  if (was_out) field.page_out(chunk);
  return bricks;
}

ReadChunk reader_of(World& world) {
  return [&world](ChunkCoord chunk) -> Result<std::vector<BrickPatch>> {
    try {
      return world.chunk(chunk);
    } catch (const ChunkUnreadable& unreadable) {
      return fail(unreadable.what());
    }
  };
}

}  // namespace scree
