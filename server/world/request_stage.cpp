#include "server/world/request_stage.h"

#include <algorithm>
#include <string>
#include <utility>

#include "server/fracture/relaxed_seeds.h"
#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/blast.h"
#include "server/world/buried_stage.h"
#include "server/world/explosion.h"
#include "server/world/fill_joints.h"
#include "server/world/game_requests.h"
#include "server/world/joint_requests.h"
#include "server/world/limits.h"
#include "server/world/person_requests.h"
#include "server/world/piece_addition.h"
#include "server/world/piece_carving.h"
#include "server/world/prop_requests.h"
#include "server/world/refracture_stage.h"
#include "server/world/region_requests.h"
#include "server/world/request_cost.h"
#include "server/world/request_room.h"
#include "server/world/restore_requests.h"
#include "server/world/settings.h"
#include "server/world/settings_change.h"
#include "server/world/spawn.h"
#include "server/world/store_requests.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/plain_number.h"
#include "shared/base/timing.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

using Checked = CheckedRequest;

void throw_out(World::State& state, const Applied& applied, const CarveRequest& request, BlowSide side,
               uint64_t party, TickDelta& delta) {
  const float dx = state.config.terrain.voxel_size_m;
  const Blast blast(state, request, side);
  const auto born = [&](PieceId id, const Volume& volume) {
    return Newborn{blast.thrown(id, volume.centre_voxels * dx), {.owner = party}};
  };
  spawn(state, applied, born, delta);
}

/// Refuses an operation that is invalid, and a shape that is too small for the world's voxels.
Checked check_edit(const World::State& state, const Operation& operation, const Shape& shape,
                   Refusal reason) {
  const float dx = state.config.terrain.voxel_size_m;
  if (Result<void> valid = validate(operation, state.pieces, dx); !valid)
    return refuse(reason, valid.error().message);
  const float least_m = limits::request_reach_min_voxels * dx;
  if (reach_of(shape) >= least_m - limits::edit_reach_rounding_m) return {};
  return refuse(reason, "half the shape's longest extent is " + metres(reach_of(shape)) +
                            ", which may change nothing in voxels of " + metres(dx) + ": ask for " +
                            metres(least_m) + " at least");
}

/// The operation of a request; its seeds may be fewer than asked for.
CarveOperation operation_of(const World::State& state, const CarveRequest& request, uint32_t seeds,
                            Cutter cutter) {
  CarveOperation operation{.shape = request.shape,
                           .pattern = request.pattern,
                           .seeds = seeds,
                           .random_seed = request.random_seed,
                           .impact_m = request.impact_m,
                           .first_piece = state.next_piece,
                           .cutter = cutter,
                           .authored_m = request.authored_m};
  if (operation.authored_m.size() > seeds) operation.authored_m.resize(seeds);
  return operation;
}

/// Gives the operation of a relaxed pattern its points: as many as find room in what it cuts, and one in any
/// case.
void relax_seeds(World::State& state, CarveOperation& operation) {
  const float dx = state.config.terrain.voxel_size_m;
  operation.authored_m.clear();
  for (const glm::vec3& seed : relaxed_seeds(operation.pattern, carved_volume(state.field, operation.shape),
                                             operation.seeds, operation.random_seed))
    operation.authored_m.push_back(seed * dx);
  if (operation.authored_m.empty()) operation.authored_m.push_back(centre_of(operation.shape));
  operation.seeds = static_cast<uint32_t>(operation.authored_m.size());
}

/// Seeds of the first cut; the pieces that chosen points make are made at once.
uint32_t seeds_at_once(const World::State& state, const CarveRequest& request, const PieceGrant& grant,
                       Cutter cutter) {
  if (!is_drawn(request.pattern)) return grant.pieces;
  const float voxels = voxels_of(band_box(in_voxels(request.shape, state.config.terrain.voxel_size_m)));
  const uint32_t at_once = pieces_at_once(cutter, voxels, grant.pieces);
  const float price_us = limits::edit_voxel_cost_us * voxels + cut_price_us(cutter, voxels, at_once);
  const float most_us = std::max(limits::carve_at_once_us, state.work.budget_us());
  return cutter == cheapest_cutter && price_us > most_us ? 1 : at_once;
}

/// Refuses what no wait could make valid.
struct Checking {
  const World::State& state;
  uint64_t session;

  Checked operator()(const CarveRequest& request) const {
    if (is_relaxed(request.pattern) && !request.authored_m.empty())
      return refuse(Refusal::carve_invalid,
                    "the pattern " + std::string(name_of(request.pattern)) + " takes no points");
    if (Result<void> valid = validate(request.shape); !valid)  // its centre is asked for below
      return refuse(Refusal::carve_invalid, valid.error().message);
    CarveOperation operation = operation_of(state, request, request.seeds, cheapest_cutter);
    if (is_relaxed(request.pattern))
      operation.authored_m.assign(std::min(request.seeds, limits::authored_seeds_max + 1),
                                  centre_of(request.shape));
    if (Checked valid = check_edit(state, operation, request.shape, Refusal::carve_invalid); !valid)
      return valid;
    if (!(request.blast_speed_m_s >= 0.0F && request.blast_speed_m_s <= limits::blast_speed_max_m_s))
      return refuse(Refusal::blast_speed,
                    "the blast speed must lie " + range_text(0.0, limits::blast_speed_max_m_s, "m/s"));
    // What is wrong in itself comes first: the piece may go while the carve waits.
    if (request.piece != 0) TRY(check_piece_carve(state, request));
    return {};
  }
  Checked operator()(const FillRequest& request) const {
    if (request.material) TRY(check_material(*request.material, Refusal::fill_invalid));
    return check_edit(state, FillOperation{request.shape, request.material}, request.shape,
                      Refusal::fill_invalid);
  }
  Checked operator()(const CutOutRequest& request) const {
    return check_edit(state, FillOperation{request.shape}, request.shape, Refusal::carve_invalid);
  }
  Checked operator()(const PaintRequest& request) const {
    TRY(check_material(request.material, Refusal::paint_invalid));
    return check_edit(state, PaintOperation{request.shape, request.material}, request.shape,
                      Refusal::paint_invalid);
  }
  Checked operator()(const DigRequest& request) const {
    TRY(check_edit(state, DigOperation{request.shape}, request.shape, Refusal::dig_invalid));
    return check(state, request);
  }
  Checked operator()(const PlaceRequest& request) const {
    TRY(check_material(request.material, Refusal::place_invalid));
    TRY(check_edit(state, operation_of(state, request), request.shape, Refusal::place_invalid));
    return check(state, request);
  }
  Checked check_material(Material material, Refusal refusal) const {
    if (state.palette->has(material)) return {};
    return refuse(refusal, "material " + std::to_string(row_number(material)) +
                               " is none of this world's palette, which has " +
                               std::to_string(state.palette->rows.size()) + " (0 to " +
                               std::to_string(state.palette->rows.size() - 1) + ")");
  }
  Checked operator()(const SettingsRequest& request) const {
    WorldConfig changed = state.config;
    if (Result<void> done = set_all(changed, request.settings); !done)
      return refuse(Refusal::settings_invalid, done.error().message);
    return {};
  }
  Checked operator()(const LeaveRequest&) const { return {}; }
  Checked operator()(const StandRequest& request) const { return check(state, request, session); }
  Checked operator()(const WalkRequest&) const { return {}; }  // take_input() refuses
  Checked operator()(const RulesRequest& request) const { return check(state, request, session); }
  Checked operator()(const RestoreRequest& request) const { return check(state, request, session); }
  Checked operator()(const auto& of_bodies) const { return check(state, of_bodies); }
};

CarveRequest at_rest(CarveRequest request) {
  request.blast_speed_m_s = 0.0F;
  return request;
}

Outcome carve(World::State& state, const CarveRequest& request, BlowSide side, uint64_t party,
              const PieceGrant& grant, TickDelta& delta) {
  const float dx = state.config.terrain.voxel_size_m;
  if (grant.pieces == 0) return tl::unexpected(no_room(state, request.seeds, party, grant));
  CHECK(grant.pieces <= request.seeds);
  const float voxels = voxels_of(band_box(in_voxels(request.shape, dx)));
  const Cutter cutter = cutter_for(state.config.methods.cutter, voxels);
  const uint32_t at_once = seeds_at_once(state, request, grant, cutter);
  CarveOperation operation = operation_of(state, request, at_once, cutter);
  if (at_once < grant.pieces) begin_in_stages(operation.pattern, operation.seeds, grant.pieces);
  if (is_relaxed(request.pattern)) relax_seeds(state, operation);
  const Applied applied = state.apply_and_record(operation, party, delta);
  state.enter_removed(applied);
  const bool whole = at_once == 1 && grant.pieces > 1;  // what is cut later is thrown then
  throw_out(state, applied, whole ? at_rest(request) : request, side, party, delta);
  if (at_once < grant.pieces) {
    queue_refractures(state, applied, request, side, party, grant.pieces, whole);
    state.cut_later_us = cut_price_us(cutter, voxels, grant.pieces);
    if (!whole) state.cut_later_us -= cut_price_us(cutter, voxels, at_once);
  }
  return static_cast<uint32_t>(applied.created.size());
}

Outcome blow_up(World::State& state, const BlastRequest& request, uint64_t party, const PieceGrant& grant,
                TickDelta& delta) {
  Outcome made = 0U;
  const std::optional<float> radius_m = blast_radius_m(state, request);
  if (radius_m)
    made = carve(state, carve_of(request, *radius_m, grant.pieces, state.config.rules), BlowSide::within,
                 party, grant, delta);
  if (made) throw_bodies(state, request);
  return made;
}

Outcome fill(World::State& state, const FillRequest& request, uint64_t party, TickDelta& delta) {
  const uint32_t enclosed = merge_enclosed(state, request.shape, delta);
  for (const Shape& shape : with_joints(request.shape, state.field, state.config.rules))
    state.ledger.poured +=
        state.apply_and_record(FillOperation{shape, request.material}, party, delta).terrain_gain;
  return enclosed;
}

/// Returns in how many bricks rock changed its material: a small shape in the air reaches none.
Outcome paint(World::State& state, const PaintRequest& request, uint64_t party, TickDelta& delta) {
  const Applied applied =
      state.apply_and_record(PaintOperation{request.shape, request.material}, party, delta);
  return static_cast<uint32_t>(std::ranges::count_if(
      applied.changed, [&](BrickCoord coord) { return brick_mass(state.field.brick(coord)) > 0; }));
}

struct Executing {
  World::State& state;
  uint64_t session;
  uint64_t party;
  const PieceGrant& grant;
  TickDelta& delta;

  Outcome operator()(const CarveRequest& request) const {
    if (request.piece != 0) return carve_piece(state, request, party, grant, delta);
    return carve(state, request, BlowSide::outside, party, grant, delta);
  }
  Outcome operator()(const CutOutRequest& request) const {
    return cut_out(state, request, party, grant, delta);
  }
  Outcome operator()(const AddPieceRequest& request) const {
    return add_piece(state, request, party, grant, delta);
  }
  Outcome operator()(const FillRequest& request) const { return fill(state, request, party, delta); }
  Outcome operator()(const PaintRequest& request) const { return paint(state, request, party, delta); }
  Outcome operator()(const SettingsRequest& request) const {
    change_settings(state, request, delta);
    return 0U;
  }
  Outcome operator()(const LeaveRequest&) const { return 0U; }  // enqueue_commands() has done it
  Outcome operator()(const WalkRequest&) const { return 0U; }   // likewise
  Outcome operator()(const RulesRequest&) const { return 0U; }  // likewise
  Outcome operator()(const StandRequest& request) const {
    return perform(state, request, session, party, delta);
  }
  Outcome operator()(const BlastRequest& request) const {
    return blow_up(state, request, party, grant, delta);
  }
  Outcome operator()(const auto& of_bodies) const { return perform(state, of_bodies, party, delta); }
};

void answer(World::State& state, const Command& command, const Outcome& outcome, TickDelta& delta) {
  Reply reply{command.session, command.request, {}, 0};
  const auto name_first = [&] {
    if (*outcome == 0) return;
    reply.prop = *outcome;
    const auto is_part = [&](const SpawnedPiece& one) { return one.id >= *outcome; };
    reply.pieces = static_cast<uint32_t>(std::ranges::count_if(delta.spawned, is_part));
  };
  if (outcome) {
    reply.mass = std::exchange(state.request_mass, std::nullopt);
    std::visit(
        Overloaded{[&](const PaintRequest&) { reply.painted = *outcome; },
                   [&](const AddPropRequest&) { reply.prop = *outcome; },
                   [&](const AddJointRequest&) { reply.joint = *outcome; },
                   [&](const StandRequest& stand) {
                     if (!stand.away) reply.prop = *outcome;
                   },
                   [&](const CutOutRequest&) { name_first(); }, [&](const AddPieceRequest&) { name_first(); },
                   [&](const auto&) { reply.pieces = *outcome; }},
        command.body);
  } else {
    reply.refusal = outcome.error().message;
    reply.reason = outcome.error().reason;
  }
  delta.replies.push_back(std::move(reply));
}

Checked check(const World::State& state, const Command& command) {
  TRY(std::visit(Checking{state, command.session}, command.body));
  return check_regions(state, command);
}

/// Carries out one request, or refuses it: what was valid when it came may not be any more.
Outcome execute(World::State& state, const Command& command, const PieceGrant& grant, TickDelta& delta) {
  if (Checked valid = check(state, command); !valid) return tl::unexpected(valid.error());
  if (Checked seen = check_sight(state, command); !seen) return tl::unexpected(seen.error());
  const size_t before = delta.operations.size(), told_before = delta.told.size();
  Outcome done = std::visit(Executing{state, command.session, party_of(command), grant, delta}, command.body);
  for (size_t i = before; i < delta.operations.size(); ++i) delta.operations[i].session = command.session;
  for (size_t i = told_before; i < delta.told.size(); ++i) delta.told[i].session = command.session;
  if (std::holds_alternative<SettingsRequest>(command.body)) delta.settings_by = command.session;
  return done;
}

Checked enqueue(World::State& state, Command command) {
  command.body = with_own_store(std::move(command.body), store_of_person(0, command.session));
  if (Checked valid = check(state, command); !valid) return valid;
  if (may_loosen(command.body))
    if (Result<void> may = may_cause_falls(state, party_of(command)); !may)
      return refuse(Refusal::falls_waiting, may.error().message);
  const float cost_us = price_us(command.body, state.field, state.config.methods.cutter);
  if (Result<void> taken = state.requests.push({std::move(command), cost_us, state.tick}); !taken)
    return refuse(Refusal::requests_waiting, taken.error().message);
  return {};
}

/// Refuses what waits for a session that cannot go on.
void drop(World::State& state, uint64_t session, TickDelta& delta) {
  for (const Command& dropped : state.requests.drop(session))
    answer(state, dropped,
           refuse(Refusal::session_over, "the session ended before its request was carried out"), delta);
  give_up_store(state, session);
}

}  // namespace

bool may_wait_for_turn(const World::State& state, const Command& command) {
  // They are checked again when they are carried out, and what they are of may be gone by then.
  if (std::holds_alternative<SettingsRequest>(command.body) ||
      std::holds_alternative<PushRequest>(command.body) ||
      std::holds_alternative<StandRequest>(command.body) ||
      std::holds_alternative<AddJointRequest>(command.body))
    return true;
  const Checked checked = check(state, command);
  if (checked) return true;
  const Refusal reason = checked.error().reason;
  return reason == Refusal::body_missing || reason == Refusal::joint_missing ||
         reason == Refusal::body_not_kept || reason == Refusal::props_max || reason == Refusal::joints_max ||
         reason == Refusal::regions_max || reason == Refusal::region_missing || reason == Refusal::in_region;
}

void enqueue_commands(World::State& state, std::span<const Command> commands, TickDelta& delta) {
  for (const Command& command : commands)
    std::visit(
        Overloaded{
            [&](const LeaveRequest&) {
              drop(state, command.session, delta);
              leave_on_foot(state, command.session, delta);
              leave_game(state, command.session, delta);
            },
            [&](const RulesRequest& rules) {
              const Checked checked = check(state, rules, command.session);
              const Outcome done = checked ? perform(state, rules, delta) : tl::unexpected(checked.error());
              if (!done) answer(state, command, done, delta);
            },
            [&](const WalkRequest& walk) {
              if (const Checked taken = take_input(state, walk, command.session, command.request); !taken)
                answer(state, command, tl::unexpected(taken.error()), delta);
            },
            [&](const auto&) {
              if (const Checked taken = enqueue(state, command); !taken)
                answer(state, command, tl::unexpected(taken.error()), delta);
            }},
        command.body);
}

void carry_out(World::State& state, TickDelta& delta) {
  state.requests.begin_tick();
  const float relief = relief_us(state);
  bool first = true;
  while (const WaitingRequest* const next = state.requests.next()) {
    PieceGrant grant = grant_for(state, next->command);
    if (may_wait(state, *next, grant)) {
      state.requests.pass_over();
      continue;
    }
    if (grant.pieces == 0) grant.pieces = grant.pieces_at_last;
    const float cost = cost_with(state, *next, grant);
    const bool costs_nothing = cost <= limits::refusal_cost_us;
    if (!costs_nothing) {
      if (first ? !may_begin(state, cost + relief) : !state.work.affords(cost + relief)) break;
      first = false;
      state.requested = state.tick;
    }
    const Command command = next->command;
    state.requests.pop(cost);
    Stopwatch stopwatch;
    answer(state, command, execute(state, command, grant, delta), delta);
    if (!costs_nothing) delta.costs.push_back(cost_of(command, cost, stopwatch.lap_ms()));
    state.work.spend_on_request(std::max(0.0F, cost - std::exchange(state.cut_later_us, 0.0F)));
  }
  delta.work.requests_waiting = static_cast<uint32_t>(state.requests.size());
}

}  // namespace scree
