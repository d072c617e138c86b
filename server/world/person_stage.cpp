#include "server/world/person_stage.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "server/world/person_limits.h"
#include "shared/person/solid_ground.h"
#include "shared/person/walker.h"

namespace scree {

namespace {

/// What is farther from a body counts for no step: so far a body is high, and so fast it goes at most.
constexpr float ground_near_m = 2.0F;
constexpr float fastest_m_s = 45.0F;

glm::vec3 middle_m(const WalkerState& walker) {
  return walker.feet_m + glm::vec3(0.0F, 0.5F * Walker::height_m, 0.0F);
}

/// Notes what moves near a person, and how hard it would strike.
void note_blows(World::State& state, const PersonRecord& person, std::span<const BodyState> near,
                const TickDelta& delta) {
  const glm::vec3 at_m = middle_m(person.walker);
  for (const BodyState& body : near) {
    const float reach_m = state.bodies.reach_m(body.id) + limits::person_blow_near_m;
    if (body.frozen || glm::distance(body.pose.position_m, at_m) > reach_m) continue;
    const float energy_j =
        0.5F * state.bodies.mass_kg(body.id) * glm::dot(body.velocity_m_s, body.velocity_m_s);
    if (energy_j > 0.0F) state.person_blows.note(person.body, body.id, energy_j, delta.tick);
  }
}

/// What is near a person, but for persons; ordered by id.
std::vector<BodyState> bodies_near(const World::State& state, const PersonRecord& person,
                                   const std::set<PieceId>& of_persons) {
  const float ticks = static_cast<float>(1 + person.inputs.size());
  const glm::vec3 reach_m(ground_near_m +
                          fastest_m_s * ticks / static_cast<float>(state.config.tick_rate_hz));
  std::vector<BodyState> near;
  const glm::vec3 at_m = middle_m(person.walker);
  for (const PieceId id : state.bodies.near(at_m - reach_m, at_m + reach_m))
    if (!of_persons.contains(id)) near.push_back(state.bodies.state(id));
  return near;
}

/// As clients have it: by the poses that they are told. Pieces come first, as in their mirrors.
SolidGround ground_about(const World::State& state, glm::vec3 feet_m, std::span<const BodyState> near) {
  SolidGround ground(state.field, feet_m);
  for (const BodyState& body : near)
    if (const auto piece = state.pieces.find(body.id); piece != state.pieces.end())
      ground.add(*piece->second, dequantise(quantise(body.pose)));
  for (const BodyState& body : near)
    if (const auto prop = state.props.find(body.id); prop != state.props.end())
      ground.add(*prop->second.prop, dequantise(quantise(body.pose)));
  return ground;
}

/// Carries out inputs as far as they go. Returns how many.
uint32_t carry_out_inputs(PersonRecord& person, Walker& walker, float tick_s, WalkGround& ground) {
  uint32_t done = 0;
  while (done < person.inputs.size() && person.credit >= limits::walk_credit_parts) {
    const WaitingInput& next = person.inputs[done++];
    walker.step(next.input, tick_s, ground);
    person.credit -= limits::walk_credit_parts;
    person.taken = next.number;
    person.look = next.look;
  }
  person.inputs.erase(person.inputs.begin(), person.inputs.begin() + done);
  return done;
}

/// The body gets to where the walker is in one tick: what rounding has left is made up for in the next.
void tell_body(World::State& state, const PersonRecord& person) {
  const BodyState now = state.bodies.state(person.body);
  const glm::vec3 way_m = body_pose(person.walker).position_m - now.pose.position_m;
  constexpr float still_m = 1e-5F;
  const bool is_there = glm::dot(way_m, way_m) < still_m * still_m;
  if (is_there && now.velocity_m_s == glm::vec3(0.0F)) return;
  const glm::vec3 velocity_m_s =
      is_there ? glm::vec3(0.0F) : way_m * static_cast<float>(state.config.tick_rate_hz);
  state.bodies.set_motion(person.body, std::nullopt, velocity_m_s, std::nullopt);
}

void walk_one(World::State& state, PersonRecord& person, const std::set<PieceId>& of_persons,
              TickDelta& delta) {
  const float tick_s = 1.0F / static_cast<float>(state.config.tick_rate_hz);
  const auto idle_max =
      static_cast<uint32_t>(limits::walk_idle_s * static_cast<float>(state.config.tick_rate_hz));
  person.credit = std::min(person.credit + limits::walk_credit_a_tick, limits::walk_credit_max);
  const std::vector<BodyState> near = bodies_near(state, person, of_persons);
  note_blows(state, person, near, delta);
  SolidGround ground = ground_about(state, person.walker.feet_m, near);
  Walker walker(person.walker);
  const uint32_t done = carry_out_inputs(person, walker, tick_s, ground);
  person.idle_ticks = done > 0 ? 0 : std::min(person.idle_ticks + 1, idle_max);
  if (done == 0 && person.idle_ticks >= idle_max)
    walker.step({}, tick_s, ground);
  else if (done == 0)
    walker.leave_rock(ground);
  person.walker = walker.state();
  if (walker.was_held() && !person.is_held)
    delta.told.push_back({.kind = EventKind::buried,
                          .tick = delta.tick,
                          .place_m = person.walker.feet_m,
                          .body = person.body,
                          .tag = person.session});
  person.is_held = walker.was_held();
  tell_body(state, person);
  state.work.spend(limits::person_cost_us + limits::person_input_cost_us * static_cast<float>(done) +
                   limits::person_near_cost_us * static_cast<float>(near.size()));
}

}  // namespace

Pose body_pose(const WalkerState& walker) {
  return {middle_m(walker), glm::quat(1.0F, 0.0F, 0.0F, 0.0F)};
}

void walk_persons(World::State& state, TickDelta& delta) {
  if (state.persons.empty()) return;
  std::set<PieceId> of_persons;
  for (const auto& [session, person] : state.persons) of_persons.insert(person.body);
  for (auto& [session, person] : state.persons) walk_one(state, person, of_persons, delta);
  const auto kept = static_cast<Tick>(limits::person_blow_s * static_cast<float>(state.config.tick_rate_hz));
  if (delta.tick > kept) state.person_blows.forget_before(delta.tick - kept);
}

void tell_of_hurts(const World::State& state, TickDelta& delta) {
  if (state.persons.empty()) return;
  std::map<PieceId, uint64_t> sessions;
  for (const auto& [session, person] : state.persons) sessions[person.body] = session;
  for (const ContactEvent& contact : delta.contacts) {
    const bool is_first = sessions.contains(contact.body);
    if (!is_first && !sessions.contains(contact.other)) continue;
    const PieceId person = is_first ? contact.body : contact.other;
    const PieceId other = is_first ? contact.other : contact.body;
    const float energy_j = std::min(contact.energy_j, state.person_blows.energy_j(person, other));
    if (other == 0 || energy_j < limits::hurt_energy_min_j) continue;
    delta.told.push_back({.kind = EventKind::hurt,
                          .tick = delta.tick,
                          .place_m = contact.place_m,
                          .session = state.traits_of(other).owner,
                          .body = person,
                          .other = other,
                          .tag = sessions.at(person),
                          .normal = is_first ? contact.normal : -contact.normal,
                          .impulse_n_s = contact.impulse_n_s,
                          .energy_j = energy_j});
  }
}

void publish_persons(const World::State& state, TickDelta& delta) {
  for (const auto& [session, person] : state.persons)
    delta.persons.push_back({session, person.body, person.taken, person.walker, person.look});
}

}  // namespace scree
