// LiveServer's host: its rules, and its commands.
#include "server/app/live_server_state.h"
#include "shared/base/check.h"

namespace scree {

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

bool LiveServer::push(Command command) {
  CHECK_EQ(command.session, 0U, "the host's commands have no session");
  CHECK(!std::holds_alternative<LeaveRequest>(command.body), "the host is not a session, so it cannot leave");
  return running() && !state_->config.net.replay && state_->commands.push(command);
}

}  // namespace scree
