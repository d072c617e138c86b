// LiveServer's host: its rules, and its commands; and what is refused for want of the host's files.
#include <algorithm>

#include "server/app/live_server_state.h"
#include "server/app/prop_models.h"
#include "shared/base/check.h"

namespace scree {

/// The network side is there for as long as hooks are called.
HostActs LiveServer::State::host_acts() {
  NetServer* const server = net.get();
  return {[server](uint64_t session, ServerMessage message) { server->send(session, std::move(message)); },
          [server](uint64_t session, Role role) { server->set_role(session, role); },
          [server](uint64_t session, const std::string& reason) { server->kick(session, reason); }};
}

/// Lets the host decide on the commands of the next tick. False: terrain that it asked for cannot be read.
bool LiveServer::State::ask_host(const World& world, Admitted& admitted) {
  TickCommands commands(std::move(admitted.commands));
  try {
    config.hooks.before(world, commands);
  } catch (const ChunkUnreadable& unreadable) {
    end(std::string("the host's rule needs terrain that cannot be read: ") + unreadable.what());
    return false;
  }
  admitted.commands = commands.let_through();
  const std::vector<Reply> refused = commands.refused();
  admission.answered(refused);
  admitted.refused.insert(admitted.refused.end(), refused.begin(), refused.end());
  return true;
}

/// The world knows a model's name alone, so that worlds and recordings do not depend on files.
void LiveServer::State::refuse_missing_models(Admitted& admitted) {
  std::vector<Reply> refused;
  std::erase_if(admitted.commands, [&](const Command& command) {
    const auto may = check_model(command.body, config.models.get());
    if (may) return false;
    Reply reply{command.session, command.request, may.error().message, 0};
    reply.reason = may.error().reason;
    refused.push_back(std::move(reply));
    return true;
  });
  admission.answered(refused);
  admitted.refused.insert(admitted.refused.end(), refused.begin(), refused.end());
}

bool LiveServer::push(Command command) {
  CHECK_EQ(command.session, 0U, "the host's commands have no session");
  CHECK(!std::holds_alternative<LeaveRequest>(command.body), "the host is not a session, so it cannot leave");
  return running() && !state_->config.net.replay && state_->config.told == nullptr &&
         state_->commands.push(command);
}

}  // namespace scree
