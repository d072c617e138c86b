#include "server/world/store_requests.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "server/world/buried_stage.h"
#include "server/world/fill_joints.h"
#include "server/world/limits.h"
#include "server/world/region_masses.h"
#include "shared/base/check.h"
#include "shared/base/plain_number.h"
#include "shared/field/edit.h"
#include "shared/field/mass.h"
#include "shared/operation/price.h"
#include "shared/query/query.h"

namespace scree {

namespace {

/// A shape that touches a prop by less than that does not lie in it, voxels.
constexpr float touch_voxels = 0.25F;

double units_per_m3(const World::State& state) {
  const double dx = state.config.terrain.voxel_size_m;
  return units_per_voxel / (dx * dx * dx);
}

MassUnits units_of(const World::State& state, uint32_t m3) {
  return static_cast<MassUnits>(units_per_m3(state) * m3);
}

/// "12.345 m³".
std::string m3_text(const World::State& state, MassUnits mass) {
  constexpr double digits = 1000.0;
  return plain(std::round(static_cast<double>(mass) / units_per_m3(state) * digits) / digits) + " m³";
}

Stores::Rate dig_rate(const World::State& state) {
  return {units_of(state, state.config.dig_m3_per_s), state.config.tick_rate_hz};
}

CheckedRequest check_name(const StoreName& store, Refusal reason) {
  if (Result<void> valid = validate(store); !valid) return refuse(reason, valid.error().message);
  if (store.kind != StoreKind::own) return {};
  return refuse(reason, "the request does not say whose store it is about");
}

/// What may still be put into a store.
MassUnits room_in(const World::State& state, const StoreName& store) {
  if (!traits_of(store.kind).is_persons) return std::numeric_limits<MassUnits>::max();
  return std::max<MassUnits>(0, units_of(state, state.config.store_m3) - state.stores.mass_of(store));
}

tl::unexpected<Refused> is_full(const World::State& state, const StoreName& store, MassUnits mass) {
  return refuse(Refusal::store_full,
                "a person's store holds " + plain(state.config.store_m3) + " m³ here (store-m3): " +
                    m3_text(state, state.stores.mass_of(store)) + " are in it, and this is " +
                    m3_text(state, mass) + " more: place some first, or give some to the world's store");
}

/// Refuses a new store where there are too many. One place is left for the world's.
CheckedRequest check_new(const World::State& state, const StoreName& store) {
  if (state.stores.contains(store) || store.kind == StoreKind::world) return {};
  if (state.stores.all().size() + 1 < limits::stores_max) return {};
  return refuse(Refusal::stores_max, "there are " + std::to_string(state.stores.all().size()) +
                                         " stores, and a world has no more: empty others first");
}

CheckedRequest check_rate(const World::State& state, const StoreName& store) {
  if (!traits_of(store.kind).is_persons) return {};
  const Stores::Rate rate = dig_rate(state);
  const MassUnits counts = state.stores.counting(store, state.tick, rate);
  if (rate.units == 0 || counts <= rate.units) return {};
  const double wait_s = static_cast<double>(counts - rate.units) / static_cast<double>(rate.units);
  return refuse(Refusal::dig_rate, "one may dig " + plain(state.config.dig_m3_per_s) +
                                       " m³ a second here (dig-m3-per-s), and you are " +
                                       m3_text(state, counts - rate.units) + " ahead: wait " +
                                       plain(std::ceil(wait_s * 10.0) / 10.0) + " s");
}

/// At least what the voxels about a shape weigh.
MassUnits most_in(const World::State& state, const Shape& shape) {
  const VoxelBox box = band_box(in_voxels(shape, state.config.terrain.voxel_size_m));
  return static_cast<MassUnits>(Window::count(box)) * units_per_voxel;
}

/// What a dig takes: all of it where that fits anyhow, which costs nothing to find out.
MassUnits mass_for(World::State& state, const DigOperation& operation, MassUnits room) {
  if (operation.piece != 0) return state.pieces.at(operation.piece)->mass;
  if (most_in(state, operation.shape) <= room) return 0;
  state.work.spend(edit_price_us(operation.shape, state.field));
  return mass_dug(operation, state.field);
}

CheckedRequest check_piece(const World::State& state, const DigRequest& request) {
  const std::string piece = "piece " + std::to_string(request.piece);
  if (state.traits_of(request.piece).kept)
    return refuse(Refusal::dig_invalid, piece + " is kept: release it first");
  const glm::vec3 off_m = centre_of(request.shape) - state.bodies.state(request.piece).pose.position_m;
  const float most_m = state.bodies.reach_m(request.piece) + limits::push_slack_m;
  if (glm::dot(off_m, off_m) <= most_m * most_m) return {};
  return refuse(Refusal::shape_misses, "the shape is not at " + piece + ", which is elsewhere by now");
}

/// The props and kept pieces that a shape meets: for a capsule, those that its bounds meet.
std::vector<PieceId> bodies_within(World::State& state, const Shape& shape) {
  const float dx = state.config.terrain.voxel_size_m;
  const glm::vec3 middle_m = centre_of(shape);
  const float touch_m = touch_voxels * dx;
  glm::vec3 half_m(reach_of(shape));
  if (shape.kind == ShapeKind::box) half_m = shape.b;
  if (shape.kind == ShapeKind::capsule) half_m = 0.5F * glm::abs(shape.b - shape.a) + shape.radius_m;
  half_m = glm::max(half_m - touch_m, glm::vec3(touch_m));
  SceneMaker maker;
  maker.begin(state.bodies.size());
  const auto pose_of = [&](PieceId id) { return dequantise(quantise(state.bodies.state(id).pose)); };
  for (const PieceId id : state.bodies.near(middle_m - half_m, middle_m + half_m)) {
    const auto prop = state.props.find(id);
    if (prop != state.props.end())
      maker.add_prop(id, pose_of(id), prop->second.prop);
    else if (state.traits_of(id).kept)
      maker.add_piece(id, pose_of(id), *state.pieces.at(id));
  }
  const HeldScene scene = maker.make_apart(state.field);
  if (scene.scene().solids().empty()) return {};
  const QueryMask bodies{.terrain = false};
  const bool is_round = shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::crater;
  const auto found = is_round ? overlap_sphere(scene, middle_m, half_m.x, bodies)
                              : overlap_box(scene, middle_m - half_m, middle_m + half_m, bodies);
  return found ? found->answer.ids : std::vector<PieceId>{scene.scene().solids().front().id};
}

MaterialMasses stored_of(const Applied& applied) {
  MaterialMasses masses;
  for (const MaterialFlow& flow : applied.flows)
    if (flow.stored != 0) add(masses, flow.material, flow.stored);
  return masses;
}

/// A place's material in the store, and what the store lacks of it.
tl::unexpected<Refused> lacks(const World::State& state, const StoreName& store, Material material,
                              MassUnits needed) {
  return refuse(Refusal::store_lacks, text_of(store) + " has " +
                                          m3_text(state, state.stores.mass_of(store, material)) + " of " +
                                          state.palette->row_or_first(material).name + ", and this needs " +
                                          m3_text(state, needed));
}

MassUnits mass_needed(World::State& state, const PlaceOperation& operation) {
  state.work.spend(edit_price_us(operation.shape, state.field));
  return mass_placed(operation, state.field);
}

/// Refuses a place, whose shapes are filled one after the other, where the store has too little.
Performed check_shapes(World::State& state, const PlaceRequest& request, Material material) {
  const MassUnits has = state.stores.mass_of(request.store, material);
  PlaceOperation operation = operation_of(state, request);
  MassUnits needed = 0;
  for (const Shape& shape : with_joints(request.shape, state.field, state.config.rules)) {
    operation.shape = shape;
    if (most_in(state, shape) > has) needed += mass_needed(state, operation);
  }
  if (needed > has) return lacks(state, request.store, material, needed);
  return 0U;
}

}  // namespace

DigOperation operation_of(const DigRequest& request) {
  return {request.shape, request.piece};
}

PlaceOperation operation_of(const World::State& state, const PlaceRequest& request) {
  const RubbleRows& rows = state.field.rubble();
  const Material stones = rows.stones[row_number(request.material)];
  return {request.shape, request.solid ? stones : rows.rubble[row_number(stones)]};
}

CheckedRequest check(const World::State& state, const DigRequest& request) {
  TRY(check_name(request.store, Refusal::dig_invalid));
  if (request.piece == 0 || state.pieces.contains(request.piece)) return {};
  if (state.props.contains(request.piece))
    return refuse(Refusal::body_missing,
                  "body " + std::to_string(request.piece) + " is a prop, and no piece of rock");
  return refuse(Refusal::body_missing,
                "there is no piece " + std::to_string(request.piece) + ": it may have become terrain");
}

CheckedRequest check(const World::State& state, const PlaceRequest& request) {
  (void)state;
  return check_name(request.store, Refusal::place_invalid);
}

CheckedRequest check(const World::State& state, const TransferRequest& request) {
  TRY(check_name(request.from, Refusal::transfer_invalid));
  TRY(check_name(request.to, Refusal::transfer_invalid));
  if (request.from == request.to) return refuse(Refusal::transfer_invalid, "both stores are the same");
  if (request.mass < 0 || (request.mass > 0 && !request.material))
    return refuse(Refusal::transfer_invalid, "a mass is of one material, and not less than nothing");
  if (!request.material || state.palette->has(*request.material)) return {};
  return refuse(Refusal::transfer_invalid,
                "material " + std::to_string(row_number(*request.material)) + " is none of this world's");
}

Performed perform(World::State& state, const DigRequest& request, uint64_t party, TickDelta& delta) {
  TRY(check_new(state, request.store));
  TRY(check_rate(state, request.store));
  if (request.piece != 0) TRY(check_piece(state, request));
  const DigOperation operation = operation_of(request);
  const MassUnits room = room_in(state, request.store);
  if (const MassUnits mass = mass_for(state, operation, room); mass > room)
    return is_full(state, request.store, mass);
  const Applied applied = state.apply_and_record(operation, party, delta, nullptr, &request.store);
  if (request.piece != 0) {
    state.bodies.remove(request.piece);
    state.ledger.pieces -= applied.stored;
  }
  state.ledger.moved -= applied.terrain_gain;
  state.ledger.stored += applied.stored;
  state.stores.put(request.store, stored_of(applied));
  state.stores.count(request.store, applied.stored, state.tick, dig_rate(state));
  state.stores.tidy(state.tick, dig_rate(state));
  state.request_mass = applied.stored;
  return request.piece != 0 ? 1U : 0U;
}

Performed perform(World::State& state, const PlaceRequest& request, uint64_t party, TickDelta& delta) {
  PlaceOperation operation = operation_of(state, request);
  const Material material = state.field.rubble().stones[row_number(operation.material)];
  if (const std::vector<PieceId> bodies = bodies_within(state, request.shape); !bodies.empty()) {
    const bool is_prop = state.props.contains(bodies.front());
    return refuse(Refusal::in_the_way, (is_prop ? "prop " : "the kept piece ") +
                                           std::to_string(bodies.front()) +
                                           " is in the way: move it, or place elsewhere");
  }
  TRY(check_shapes(state, request, material));
  const uint32_t enclosed = merge_enclosed(state, request.shape, delta);
  if (enclosed > 0) TRY(check_shapes(state, request, material));
  MassUnits placed = 0;
  for (const Shape& shape : with_joints(request.shape, state.field, state.config.rules)) {
    operation.shape = shape;
    const MassUnits has = state.stores.mass_of(request.store, material);
    // What a joint has filled is not needed any more; only rounding could have made it more.
    if (most_in(state, shape) > has && mass_needed(state, operation) > has) break;
    const Applied applied = state.apply_and_record(operation, party, delta, nullptr, &request.store);
    state.ledger.stored += applied.stored;
    placed -= applied.stored;
    if (applied.stored <= 0)
      state.stores.take(request.store, material, -applied.stored);
    else
      state.stores.put(request.store, stored_of(applied));
  }
  state.stores.tidy(state.tick, dig_rate(state));
  state.request_mass = placed;
  return enclosed;
}

Performed perform(World::State& state, const TransferRequest& request, uint64_t /*party*/,
                  TickDelta& /*delta*/) {
  const MassUnits all = state.stores.mass_of(request.from);
  if (all == 0) return refuse(Refusal::store_missing, "there is nothing in " + text_of(request.from));
  TRY(check_new(state, request.to));
  MassUnits mass = all;
  if (request.material) {
    const MassUnits has = state.stores.mass_of(request.from, *request.material);
    mass = request.mass == 0 ? has : request.mass;
    if (mass == 0 || mass > has)
      return lacks(state, request.from, *request.material, std::max<MassUnits>(mass, 1));
  }
  if (mass > room_in(state, request.to)) return is_full(state, request.to, mass);
  carry_origins(
      state, request.from, request.to,
      request.material ? MaterialMasses{{*request.material, mass}} : state.stores.find(request.from)->masses);
  if (request.material) {
    state.stores.take(request.from, *request.material, mass);
    state.stores.put(request.to, MaterialMasses{{*request.material, mass}});
  } else {
    state.stores.move_all(request.from, request.to);
  }
  state.stores.tidy(state.tick, dig_rate(state));
  state.request_mass = mass;
  return 0U;
}

void give_up_store(World::State& state, uint64_t session) {
  const StoreName store{StoreKind::session, session};
  if (!state.stores.contains(store)) return;
  carry_origins(state, store, worlds_store(), state.stores.find(store)->masses);
  state.stores.move_all(store, worlds_store());
  state.stores.drop(store);
}

Result<void> restore_stores(World::State& state, const std::vector<StoreRecord>& records) {
  if (records.size() > limits::stores_max)
    return fail("it has " + std::to_string(records.size()) + " stores; a world has at most " +
                std::to_string(limits::stores_max) + " (limits.stores_max)");
  MassUnits sum = 0;
  for (size_t i = 0; i < records.size(); ++i) {
    const auto& [content, dug, dug_at] = records[i];
    TRY(validate(content.store));
    if (content.store.kind == StoreKind::own) return fail("a store is of nobody");
    if (i > 0 && !(records[i - 1].content.store < content.store)) return fail("its stores are not in order");
    if (dug < 0 || dug > limits::ledger_mass_max || dug_at > state.tick)
      return fail("less than nothing was dug into a store, or it was later than now");
    for (const MaterialMass& one : content.masses) {
      if (one.mass <= 0 || one.mass > limits::ledger_mass_max - sum || !state.palette->has(one.material))
        return fail("a store has less than nothing, more than there is, or a material of no row");
      sum += one.mass;
    }
  }
  state.stores.restore(records);
  return {};
}

}  // namespace scree
