#include "server/world/prop_requests.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "server/bodies/limits.h"
#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/limits.h"
#include "server/world/person_requests.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/plain_number.h"
#include "shared/prop/limits.h"
#include "shared/prop/prop_solid.h"

namespace scree {

namespace {

bool is_number(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

CheckedRequest check_speeds(glm::vec3 velocity_m_s, glm::vec3 spin_rad_s) {
  if (!is_number(velocity_m_s) || !is_number(spin_rad_s))
    return refuse(Refusal::prop_invalid, "the prop's speed is not finite");
  if (!(glm::dot(velocity_m_s, velocity_m_s) <= limits::prop_speed_max_m_s * limits::prop_speed_max_m_s))
    return refuse(Refusal::prop_invalid,
                  "the prop is faster than " + plain(limits::prop_speed_max_m_s) + " m/s");
  if (!(glm::dot(spin_rad_s, spin_rad_s) <= limits::prop_spin_max_rad_s * limits::prop_spin_max_rad_s))
    return refuse(Refusal::prop_invalid,
                  "the prop spins faster than " + plain(limits::prop_spin_max_rad_s) + " rad/s");
  return {};
}

tl::unexpected<Refused> no_prop(PieceId id) {
  return refuse(Refusal::body_missing, "there is no prop " + std::to_string(id));
}

/// Convex parts that collide.
float parts_of(const World::State& state, PieceId id) {
  const auto prop = state.props.find(id);
  return prop == state.props.end() ? 1.0F : static_cast<float>(prop->second.prop->parts.size());
}

/// The tick pays for what a body costs that is put among others: of each that it may overlap the next step
/// seeks the depth. So hundreds in one place take several ticks.
void spend_on_meetings(World::State& state, PieceId id) {
  const glm::vec3 at_m = state.bodies.state(id).pose.position_m;
  const float reach_m = state.bodies.reach_m(id), parts = parts_of(state, id);
  float overlaps = 0.0F;
  for (const PieceId other : state.bodies.near(at_m - reach_m, at_m + reach_m))
    if (other != id) overlaps += parts * parts_of(state, other);
  state.work.spend(limits::overlap_cost_us * overlaps);
}

/// Whether a place is at the body, or was a moment ago.
bool is_at(const World::State& state, PieceId body, glm::vec3 at_m) {
  const glm::vec3 off_m = at_m - state.bodies.state(body).pose.position_m;
  const float most_m = state.bodies.reach_m(body) + limits::push_slack_m;
  return glm::dot(off_m, off_m) <= most_m * most_m;
}

}  // namespace

/// Refuses also what is no number, axis by axis: the greater of a number and of none may be the number.
CheckedRequest check_place(glm::vec3 place_m, Refusal reason, const std::string& body) {
  if (std::abs(place_m.x) <= limits::world_half_width_m &&
      std::abs(place_m.z) <= limits::world_half_width_m && std::abs(place_m.y) <= limits::world_half_height_m)
    return {};
  return refuse(reason, "the " + body + "'s place lies outside the world: farther than " +
                            plain(limits::world_half_width_m) + " m to a side, or " +
                            plain(limits::world_half_height_m) + " m up or down");
}

CheckedRequest check_turn(const glm::quat& turn, Refusal reason, const std::string& body) {
  if (std::abs(glm::dot(turn, turn) - 1.0F) < 1e-3F) return {};
  return refuse(reason, "the " + body + "'s rotation is no unit quaternion");
}

void tell_of_prop(const World::State& state, EventKind kind, PieceId id, TickDelta& delta) {
  delta.told.push_back({.kind = kind,
                        .tick = delta.tick,
                        .place_m = state.bodies.state(id).pose.position_m,
                        .body = id,
                        .tag = state.props.at(id).prop->tag});
}

CheckedRequest check(const World::State& state, const AddPropRequest& request) {
  if (const Result<void> valid = validate_bounds(request.prop); !valid)
    return refuse(Refusal::prop_invalid, valid.error().message);
  if (!state.palette->has(request.prop.material))
    return refuse(Refusal::prop_invalid, "material " + std::to_string(row_number(request.prop.material)) +
                                             " of the prop is none of this world's palette");
  TRY(check_place(request.place_m, Refusal::prop_invalid, "prop"));
  TRY(check_turn(request.turn, Refusal::prop_invalid, "prop"));
  TRY(check_speeds(request.velocity_m_s, request.spin_rad_s));
  if (state.props.size() < state.config.props_max) return {};
  return refuse(Refusal::props_max, std::to_string(state.props.size()) +
                                        " props are there, which is this server's limit (props-max): remove "
                                        "some, or have the limit raised (--props-max)");
}

CheckedRequest check(const World::State& state, const RemovePropRequest& request) {
  if (!state.props.contains(request.prop)) return no_prop(request.prop);
  return check_is_no_person(state, request.prop);
}

CheckedRequest check(const World::State& state, const MovePropRequest& request) {
  const auto found = state.props.find(request.prop);
  if (found == state.props.end()) return no_prop(request.prop);
  TRY(check_is_no_person(state, request.prop));
  if (request.place_m) TRY(check_place(*request.place_m, Refusal::prop_invalid, "prop"));
  if (request.turn) TRY(check_turn(*request.turn, Refusal::prop_invalid, "prop"));
  TRY(check_speeds(request.velocity_m_s.value_or(glm::vec3(0.0F)),
                   request.spin_rad_s.value_or(glm::vec3(0.0F))));
  if (found->second.prop->motion == PropMotion::fixed && (request.velocity_m_s || request.spin_rad_s))
    return refuse(Refusal::prop_invalid,
                  "prop " + std::to_string(request.prop) + " is fixed: it takes no speed");
  return {};
}

CheckedRequest check(const World::State& state, const PushRequest& request) {
  if (!state.bodies.contains(request.body))
    return refuse(Refusal::body_missing,
                  "there is no body " + std::to_string(request.body) + ": it may have become terrain");
  TRY(check_is_no_person(state, request.body));
  if (!is_number(request.impulse_n_s) || !is_number(request.at_m) ||
      !(glm::dot(request.impulse_n_s, request.impulse_n_s) <=
        limits::push_impulse_max_n_s * limits::push_impulse_max_n_s))
    return refuse(Refusal::push_invalid, "the push is no number, or of more than " +
                                             plain(limits::push_impulse_max_n_s) + " newton seconds");
  if (is_at(state, request.body, request.at_m)) return {};
  return refuse(Refusal::push_invalid,
                "the push is not at body " + std::to_string(request.body) + ", which is elsewhere by now");
}

CheckedRequest check(const World::State& state, const BreakRequest& request) {
  // What is wrong in itself comes first: the rest may change while the request waits.
  if (!is_number(request.at_m)) return refuse(Refusal::push_invalid, "the place of the break is not finite");
  if (request.seeds < 2 || request.seeds > limits::seeds_max)
    return refuse(Refusal::push_invalid, "a piece breaks into 2 to " + plain(limits::seeds_max) + " pieces");
  if (state.props.contains(request.piece))
    return refuse(Refusal::body_missing,
                  "body " + std::to_string(request.piece) + " is a prop, which never breaks");
  if (!state.pieces.contains(request.piece))
    return refuse(Refusal::body_missing,
                  "there is no piece " + std::to_string(request.piece) + ": it may have become terrain");
  if (state.config.rules < rules::paid_looks || is_at(state, request.piece, request.at_m)) return {};
  return refuse(Refusal::push_invalid,
                "the break is not at piece " + std::to_string(request.piece) + ", which is elsewhere by now");
}

CheckedRequest check(const World::State& /*state*/, const BlastRequest& request) {
  if (!is_number(request.centre_m) || !check_place(request.centre_m, Refusal::blast_invalid, "blast"))
    return refuse(Refusal::blast_invalid, "the blast's place lies outside the world");
  if (is_blast_energy(request.energy_j)) return {};
  return refuse(Refusal::blast_invalid,
                "a blast has " + range_text(blast_energy_min_j, blast_energy_max_j, "J of energy"));
}

Performed perform(World::State& state, const AddPropRequest& request, uint64_t party, TickDelta& delta) {
  Prop prop = request.prop;
  // Faces of hulls take milliseconds to find: they are searched once, when the request's price is paid.
  const Result<PropMeasure> measure = measure_checked(prop);
  if (!measure) return refuse(Refusal::prop_invalid, measure.error().message);
  if (prop.mass_kg == 0.0F) {
    const float by_density_kg = measure->volume_m3 * state.palette->row(prop.material).density_kg_m3;
    if (by_density_kg > limits::prop_mass_max_kg && state.config.rules >= rules::paid_looks)
      return refuse(Refusal::prop_invalid, "of its material the prop weighs " + plain(by_density_kg) +
                                               " kg, and may weigh " + plain(limits::prop_mass_max_kg) +
                                               " at most: name its mass");
    prop.mass_kg = std::clamp(by_density_kg, limits::prop_mass_min_kg, limits::prop_mass_max_kg);
  }
  const PieceId id = state.next_piece++;
  auto shared = std::make_shared<const Prop>(std::move(prop));
  BodyShape shape = state.enter_prop(id, shared, *measure, party);
  const glm::quat turn = request.turn / std::sqrt(glm::dot(request.turn, request.turn));
  const bool is_fixed = shared->motion == PropMotion::fixed;
  const glm::vec3 still(0.0F);
  state.bodies.add(std::move(shape), {id,
                                      {request.place_m, turn},
                                      is_fixed ? still : request.velocity_m_s,
                                      is_fixed ? still : request.spin_rad_s,
                                      false});
  spend_on_meetings(state, id);
  tell_of_prop(state, EventKind::prop_added, id, delta);
  if (state.bodies.look_whether_in_terrain(id) == InTerrain::no_way_out)
    delta.told.back().text = "in the terrain, where no free place is near: it stays";
  delta.props_spawned.push_back({id, std::move(shared)});
  return id;
}

uint32_t perform(World::State& state, const RemovePropRequest& request, uint64_t /*party*/,
                 TickDelta& delta) {
  tell_of_prop(state, EventKind::prop_removed, request.prop, delta);
  state.remove_prop(request.prop);
  return 0;
}

uint32_t perform(World::State& state, const PushRequest& request, uint64_t /*party*/, TickDelta& /*delta*/) {
  state.bodies.push(request.body, request.impulse_n_s, request.at_m);
  return 0;
}

uint32_t perform(World::State& state, const MovePropRequest& request, uint64_t /*party*/,
                 TickDelta& /*delta*/) {
  std::optional<Pose> pose;
  if (request.place_m || request.turn) {
    pose = state.bodies.state(request.prop).pose;
    if (request.place_m) pose->position_m = *request.place_m;
    if (request.turn) pose->rotation = *request.turn / std::sqrt(glm::dot(*request.turn, *request.turn));
  }
  state.bodies.set_motion(request.prop, pose, request.velocity_m_s, request.spin_rad_s);
  if (pose) spend_on_meetings(state, request.prop);
  return 0;
}

uint32_t perform(World::State& state, const BreakRequest& request, uint64_t /*party*/, TickDelta& delta) {
  const Volume& volume = *state.pieces.at(request.piece);
  const auto heavy_enough = static_cast<uint32_t>(volume.mass / limits::break_child_mass_min);
  const size_t others = state.pieces.size() - 1;
  const auto room =
      static_cast<uint32_t>(state.config.pieces_max - std::min<size_t>(others, state.config.pieces_max));
  const uint32_t seeds = std::min({request.seeds, heavy_enough, room});
  if (seeds < 2) return 0;
  const BodyState body = state.bodies.state(request.piece);
  const float dx = state.config.terrain.voxel_size_m;
  const glm::vec3 off_m = glm::conjugate(body.pose.rotation) * (request.at_m - body.pose.position_m);
  const auto voxels = static_cast<float>(volume.window.codes.size());
  const ShatterOperation operation{.piece = request.piece,
                                   .pattern = SeedPattern::natural,
                                   .seeds = seeds,
                                   .random_seed = request.random_seed,
                                   .impact_voxels = volume.centre_voxels + off_m / dx,
                                   .first_piece = state.next_piece,
                                   .cutter = cutter_for(state.config.methods.cutter, voxels)};
  return static_cast<uint32_t>(shatter_piece(state, operation, {}, delta).created.size());
}

}  // namespace scree
