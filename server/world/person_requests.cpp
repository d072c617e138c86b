#include "server/world/person_requests.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/bodies/prop_body.h"
#include "server/world/person_limits.h"
#include "server/world/person_stage.h"
#include "shared/base/check.h"
#include "shared/base/plain_number.h"
#include "shared/person/person_body.h"
#include "shared/person/walker.h"
#include "shared/query/limits.h"
#include "shared/query/query.h"

namespace scree {

namespace {

tl::unexpected<Refused> not_on_foot() {
  return refuse(Refusal::not_on_foot, "you are not on foot in this world: stand first");
}

/// The feet of who begins where visitors do.
glm::vec3 spawn_feet_m(World::State& state) {
  const Spawn spawn = state.spawn_place.find(state.field, state.config.spawn);
  return spawn.eye_m - glm::vec3(0.0F, Walker::eye_above_m, 0.0F);
}

uint32_t enter_person(World::State& state, glm::vec3 feet_m, uint64_t session, uint64_t party,
                      TickDelta& delta) {
  PersonRecord person;
  person.session = session;
  person.body = state.next_piece++;
  person.walker.feet_m = feet_m;
  if (const Player* const player = state.game.player(session)) person.walker.pace = player->pace;
  auto prop = std::make_shared<const Prop>(body_of_person(session, limits::person_mass_kg));
  BodyShape shape = state.enter_prop(person.body, prop, measure_of(*prop), party);
  state.bodies.add(std::move(shape), {.id = person.body, .pose = body_pose(person.walker)});
  tell_of_prop(state, EventKind::prop_added, person.body, delta);
  delta.props_spawned.push_back({person.body, std::move(prop)});
  const PieceId body = person.body;
  state.persons.emplace(session, std::move(person));
  return body;
}

bool is_look(glm::vec3 look) {
  return std::abs(glm::dot(look, look) - 1.0F) < 1e-2F;
}

/// The centre of what an edit changes; nothing: it edits nothing that has a place.
std::optional<glm::vec3> place_of_edit(const Request& request) {
  if (const std::optional<Shape> shape = shape_of(request)) return centre_of(*shape);
  if (const glm::vec3* const place_m = place_of(request)) return *place_m;
  return std::nullopt;
}

}  // namespace

bool is_body_of_person(const World::State& state, PieceId id) {
  return std::ranges::any_of(state.persons, [&](const auto& one) { return one.second.body == id; });
}

CheckedRequest check_is_no_person(const World::State& state, PieceId id) {
  if (!is_body_of_person(state, id)) return {};
  return refuse(Refusal::person_body,
                "prop " + std::to_string(id) + " is the body of a person on foot, whom no request moves");
}

CheckedRequest check(const World::State& state, const StandRequest& request, uint64_t session) {
  if (session == 0) return refuse(Refusal::walk_invalid, "only a client's session has a person");
  const bool stands = state.persons.contains(session);
  if (request.away) return stands ? CheckedRequest() : not_on_foot();
  if (state.config.service.persons != Persons::walk)
    return refuse(Refusal::persons_fly, "persons fly in this world: nobody walks (persons)");
  if (request.place_m) TRY(check_place(*request.place_m, Refusal::walk_invalid, "person"));
  if (stands && !request.place_m)
    return refuse(Refusal::walk_invalid, "you are on foot already: leave first, to begin anew");
  if (stands || state.props.size() < state.config.props_max) return {};
  return refuse(Refusal::props_max, std::to_string(state.props.size()) +
                                        " props and persons are there, which is this server's limit "
                                        "(props-max): have it raised (--props-max)");
}

uint32_t perform(World::State& state, const StandRequest& request, uint64_t session, uint64_t party,
                 TickDelta& delta) {
  if (request.away) {
    leave_on_foot(state, session, delta);
    return 0;
  }
  const auto there = state.persons.find(session);
  if (there == state.persons.end()) {
    const glm::vec3 feet_m = request.place_m ? *request.place_m : spawn_feet_m(state);
    return enter_person(state, feet_m, session, party, delta);
  }
  CHECK(request.place_m.has_value());
  PersonRecord& person = there->second;
  person.walker = {.feet_m = *request.place_m, .pace = person.walker.pace};
  state.bodies.set_motion(person.body, body_pose(person.walker), glm::vec3(0.0F), glm::vec3(0.0F));
  return person.body;
}

CheckedRequest take_input(World::State& state, const WalkRequest& request, uint64_t session,
                          uint32_t number) {
  const auto found = state.persons.find(session);
  if (found == state.persons.end()) return not_on_foot();
  PersonRecord& person = found->second;
  if (!is_walk_input(request.input) || !is_look(request.look))
    return refuse(Refusal::walk_invalid,
                  "an input asks for no more than the full speed, and looks in a "
                  "direction of length 1");
  const uint32_t last = person.inputs.empty() ? person.taken : person.inputs.back().number;
  if (number == 0 || number <= last || (last != 0 && number - last > limits::walk_numbers_ahead_max))
    return refuse(Refusal::walk_invalid, "input " + std::to_string(number) + " does not follow input " +
                                             std::to_string(last) + ", or is of the future");
  if (person.inputs.size() >= limits::walk_inputs_max)
    return refuse(Refusal::inputs_waiting, std::to_string(person.inputs.size()) +
                                               " inputs wait already: one for each tick can be carried out");
  person.inputs.push_back({number, request.input, request.look});
  return {};
}

void leave_on_foot(World::State& state, uint64_t session, TickDelta& delta) {
  const auto found = state.persons.find(session);
  if (found == state.persons.end()) return;
  const PieceId body = found->second.body;
  tell_of_prop(state, EventKind::prop_removed, body, delta);
  state.persons.erase(found);
  state.remove_prop(body);
}

void leave_on_foot(World::State& state, TickDelta& delta) {
  while (!state.persons.empty()) leave_on_foot(state, state.persons.begin()->first, delta);
}

bool is_person(const PersonRecord& person) {
  uint32_t last = person.taken;
  for (const WaitingInput& waiting : person.inputs) {
    if (waiting.number <= last || !is_walk_input(waiting.input) || !is_look(waiting.look)) return false;
    last = waiting.number;
  }
  return person.session != 0 && person.inputs.size() <= limits::walk_inputs_max &&
         person.credit <= limits::walk_credit_max && is_walker_state(person.walker) && is_look(person.look);
}

CheckedRequest check_sight(World::State& state, const Command& command) {
  const std::optional<glm::vec3> centre_m = place_of_edit(command.body);
  if (!command.eye_m || !centre_m) return {};
  const glm::vec3 eye_m = *command.eye_m;
  const float away_m = glm::distance(eye_m, *centre_m);
  const std::optional<Shape> shape = shape_of(command.body);
  const float own_m = (shape ? reach_of(*shape) : 0.0F) + state.config.terrain.voxel_size_m;
  const float free_m = std::min(away_m, limits::query_cast_max_m) - own_m;
  if (!(free_m > 0.0F)) return {};
  state.work.spend(limits::sight_cost_us);
  // What other questions have read may be of before this tick's edits: this one reads for itself.
  SceneMaker maker;
  maker.begin(0);
  const HeldScene scene = maker.make_apart(state.field);
  const auto hit =
      cast_ray(scene, eye_m, (*centre_m - eye_m) / away_m, free_m, {.pieces = false, .bodies = false});
  if (!hit || !hit->answer) return {};
  return refuse(Refusal::out_of_sight, "terrain lies " + metres(hit->answer->distance_m) +
                                           " from your eye, before this edit, which is " + metres(away_m) +
                                           " from it (sight): go where you see it");
}

Result<void> restore_persons(World::State& state, const WorldMoment& moment) {
  for (const PersonRecord& person : moment.persons) {
    const std::string which = "the person of session " + std::to_string(person.session);
    const auto body = state.props.find(person.body);
    if (body == state.props.end() || body->second.prop->motion != PropMotion::kinematic)
      return fail(which + " has no body");
    if (!is_person(person)) return fail(which + " is not as persons are");
    const bool is_taken =
        std::ranges::any_of(state.persons, [&](const auto& one) { return one.second.body == person.body; });
    if (is_taken || !state.persons.emplace(person.session, person).second)
      return fail(which + " comes twice, or has another one's body");
  }
  return {};
}

}  // namespace scree
