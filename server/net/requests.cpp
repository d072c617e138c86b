#include "server/net/requests.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "shared/base/limits.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

bool is_within_world(const glm::vec3& place_m) {
  return std::max(std::abs(place_m.x), std::abs(place_m.z)) <= limits::world_half_width_m &&
         std::abs(place_m.y) <= limits::world_half_height_m;
}

/// Refuses an edit that is too far away. One that is no shape, or outside the world, is the simulation's to
/// refuse.
tl::expected<void, Refused> check_reach(const SessionEntry& session, const Request& request, double reach_m) {
  const std::optional<Shape> shape = shape_of(request);
  const glm::vec3* const place_m = place_of(request);
  if (session.grant.role == Role::admin) return {};
  double away_m = 0.0;
  if (shape && validate(*shape) && is_within_world(shape->a))
    away_m = distance(*shape, session.eye_m);
  else if (place_m != nullptr && is_within_world(*place_m))
    away_m = glm::distance(*place_m, session.eye_m);
  if (away_m <= reach_m || reach_m == 0.0) return {};
  const glm::vec3& eye = session.eye_m;
  return refuse(
      Refusal::reach,
      fmt::format("this edit lies {:.0f} m from your eye at ({:.0f}, {:.0f}, {:.0f}); this server's "
                  "limit is {:g} m (reach): go nearer",
                  away_m, eye.x, eye.y, eye.z, reach_m));
}

/// A name that only the person says counts for nothing: anybody may say it.
Asker asker_of(const SessionEntry& session) {
  const Grant& grant = session.grant;
  return {grant.role, grant.vouches_name ? grant.name : std::string(), grant.team};
}

/// Refuses a request beyond the session's role, or beyond its reach.
tl::expected<void, Refused> check_session(const SessionEntry& session, const Request& request,
                                          double reach_m) {
  TRY(check_role(session.grant.role, role_for(request)));
  return check_reach(session, request, reach_m);
}

/// The eye from which the world has to see the edit.
std::optional<glm::vec3> eye_for(const SessionEntry& session, const Request& request, bool sight) {
  const bool edits = shape_of(request).has_value() || place_of(request) != nullptr;
  if (!sight || !edits || session.grant.role == Role::admin) return std::nullopt;
  return session.eye_m;
}

}  // namespace

void Requests::grant(const ServiceLimits& service) {
  sessions_.set_requests_per_second(service.requests_per_second);
  reach_m_ = service.reach_m;
  sight_ = service.sight;
}

bool Requests::ask(ClientSession& session, uint32_t request, const Request& body) {
  const SessionEntry& entry = sessions_.at(session.id());
  // In a replay no role may change anything, so a session is not sent for another token.
  const auto may_ask = replay_ ? tl::expected<void, Refused>() : check_session(entry, body, reach_m_);
  if (may_ask) {
    const StoreName own = store_of_person(entry.grant.token_id, session.id());
    Command command{session.id(), request,         with_own_store(body, own),
                    entry.party,  asker_of(entry), eye_for(entry, body, sight_)};
    if (std::holds_alternative<WalkRequest>(body) && !replay_) {
      pass_input(session, command);
      return false;
    }
    if (auto* const stand = std::get_if<StandRequest>(&command.body))
      if (!may_act_as(entry.grant.role, Role::director)) stand->place_m.reset();
    return pass(session, command);
  }
  ++counts_.requests;
  refuse(session, request, may_ask.error());
  return false;
}

bool Requests::pass(ClientSession& session, const Command& command) {
  ++counts_.requests;
  const auto refused = [&](Refusal reason, const std::string& message) {
    refuse(session, command.request, {reason, message});
    return false;
  };
  if (replay_) return refused(Refusal::replay, "this server plays a recording: nothing in it can be changed");
  if (is_edge_)
    return refused(Refusal::edge,
                   "this server is an edge: the world and its settings are changed at the simulating server");
  const double now_s = steady_now_s();
  if (!sessions_.at(session.id()).requests.try_spend(now_s))
    return refused(Refusal::requests_per_second,
                   fmt::format("more than {} requests a second (requests-per-second); ask again more slowly",
                               sessions_.requests_per_second()));
  if (!commands_.push(command))
    return refused(
        Refusal::commands_waiting,
        fmt::format("the server is busy: {} commands wait already; try again", commands_.commands_max()));
  departures_.asked(session.id());
  times_.received(session.id(), command.request, now_s);
  return true;
}

void Requests::pass_input(ClientSession& session, const Command& command) {
  std::optional<RateLimit>& inputs = sessions_.at(session.id()).inputs;
  const double per_second = limits::walk_inputs_a_tick_max * tick_rate_hz_;
  if (!inputs) inputs.emplace(per_second, limits::walk_inputs_burst_s * per_second);
  if (!inputs->try_spend(steady_now_s())) {
    ++counts_.requests;
    return refuse(
        session, command.request,
        {Refusal::requests_per_second,
         fmt::format("more than {:g} inputs a second: a person has one for each tick", per_second)});
  }
  if (commands_.push(command)) departures_.asked(session.id());
}

void Requests::refuse(ClientSession& session, uint32_t request, const Refused& refused) {
  ++counts_.requests_refused;
  counts_.refusals.add(refused.reason);
  if (SessionEntry* const entry = sessions_.find(session.id())) ++entry->refused;
  session.send(
      ServerMessage(ReplyMessage{request, refused.message, 0, std::string(name_of(refused.reason))}));
}

}  // namespace scree
