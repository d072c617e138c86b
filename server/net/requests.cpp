#include "server/net/requests.h"

#include <fmt/format.h>

#include "shared/base/timing.h"

namespace scree {

void Requests::ask(ClientSession& session, const Command& command) {
  const auto may_ask = check_role(sessions_.at(session.id()).grant.role, role_for(command.body));
  if (may_ask) {
    pass(session, command);
    return;
  }
  ++counts_.requests;
  refuse(session, command.request, may_ask.error());
}

bool Requests::pass(ClientSession& session, const Command& command) {
  ++counts_.requests;
  const auto refused = [&](Refusal reason, const std::string& message) {
    refuse(session, command.request, {reason, message});
    return false;
  };
  if (replay_) return refused(Refusal::replay, "this server plays a recording: nothing in it can be changed");
  const double now_s = steady_now_s();
  if (!sessions_.at(session.id()).requests.try_spend(now_s))
    return refused(Refusal::requests_per_second,
                   fmt::format("more than {} requests a second (requests-per-second); ask again more slowly",
                               sessions_.requests_per_second()));
  if (!commands_.push(command))
    return refused(
        Refusal::commands_waiting,
        fmt::format("the server is busy: {} commands wait already (limits.commands_waiting_max); try again",
                    commands_.commands_max()));
  departures_.asked(session.id());
  times_.received(session.id(), command.request, now_s);
  return true;
}

void Requests::refuse(ClientSession& session, uint32_t request, const Refused& refused) {
  ++counts_.requests_refused;
  counts_.refusals.add(refused.reason);
  session.send(
      ServerMessage(ReplyMessage{request, refused.message, 0, std::string(name_of(refused.reason))}));
}

}  // namespace scree
