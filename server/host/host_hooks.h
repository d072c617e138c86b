// A host's own rules in a live server: it decides before a tick, and learns the result after it.
//
// A rule reads the world and changes it by commands alone. The recording holds the commands that the rule let
// through, so that `scree replay verify` gives the same hashes without the host.
//
// Threads: before() and after() are called by the thread that simulates, which is the caller of step_once()
// with Pacing::by_hand; said() is called by the network thread. The tick, or the network, waits for them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "proto/game_message.h"
#include "proto/messages.h"
#include "server/command/command.h"
#include "server/command/joined_person.h"
#include "server/metrics/figure.h"
#include "server/world/tick_delta.h"
#include "server/world/world.h"

namespace scree {

/// The commands that a tick is about to get, in order. A command keeps its index until before() returns.
class TickCommands {
 public:
  explicit TickCommands(std::vector<Command> commands);

  /// The refused ones are among them.
  std::span<const Command> all() const { return commands_; }
  bool is_refused(size_t index) const { return refusals_[index].has_value(); }

  /// The tick does not get the command, and its client gets a reply with these words. The refusal's name is
  /// `host`, or `game:` and `name`: at most host_name_bytes_max of a-z, 0-9 and _. A session that leaves
  /// (LeaveRequest) cannot be refused.
  void refuse(size_t index, std::string words, std::string_view name = {});
  /// The tick gets the command of that client with another request. A session that leaves cannot change, and
  /// nothing can become a LeaveRequest.
  void change(size_t index, Request body);
  /// The tick gets one more command, of the host itself (session 0); `request` is returned in its reply. It
  /// waits for nothing: terrain that is out of memory is read within the tick, and the setting memory-max is
  /// not asked. LiveServer::push() is the way for commands that may wait.
  void add(Request body, uint32_t request = 0);
  /// The same of rules that have a name, which the recording keeps as that of who asked; `party`: whose
  /// pieces and falls it makes (Command::party), 0: the world's own.
  void add(Request body, uint32_t request, const std::string& rules, uint64_t party);

  /// How many were added.
  size_t added() const { return commands_.size() - given_; }

  /// The commands that the tick gets, and the replies to the others.
  std::vector<Command> let_through() const;
  std::vector<Reply> refused() const;

 private:
  struct HostRefusal {
    std::string words;
    std::string name;
  };
  std::vector<Command> commands_;
  size_t given_ = 0;                                  ///< of them by others than the host
  std::vector<std::optional<HostRefusal>> refusals_;  ///< by command
};

/// The longest name for TickCommands::refuse(). With "game:" it fits limits::refusal_name_bytes_max.
inline constexpr size_t host_name_bytes_max = 27;

/// What a host can do besides commands. From any thread, while the server is there; nothing once it stops.
struct HostActs {
  /// Sends a message to a session, if it is there.
  std::function<void(uint64_t session, ServerMessage message)> send = [](uint64_t, const ServerMessage&) {};
  /// Changes what a session may ask for, until it ends.
  std::function<void(uint64_t session, Role role)> set_role = [](uint64_t, Role) {};
  /// Ends a session with these words.
  std::function<void(uint64_t session, const std::string& reason)> kick = [](uint64_t, const std::string&) {};
};

/// An empty hook is not called, and costs nothing.
struct HostHooks {
  /// Called once, before the first tick.
  std::function<void(const HostActs& acts)> started;
  /// Called before each tick of a simulation. It may read `world`. A replay has no such hook: its commands
  /// are decided.
  std::function<void(const World& world, TickCommands& commands)> before;
  /// Called after each tick, once the network has it. `delta` has the replies that clients get.
  std::function<void(const TickDelta& delta)> after;
  /// Called with each line that a person says to all (Say of proto/talk.proto). False: the host keeps the
  /// line to itself, and nobody hears it, not even the speaker.
  std::function<bool(const SaidMessage& line)> said;
  /// Called when somebody joins or comes back, and when the connection ends; on the network thread, as the
  /// next two.
  std::function<void(const JoinedPerson& person)> joined;
  std::function<void(uint64_t session)> left;
  /// Called with what a client's program says to the rules.
  std::function<void(uint64_t session, const ChannelData& data)> heard;
  /// Called with what an administrator wants of the rules; the host answers it by HostActs::send(), with an
  /// AdminListMessage of that request. Empty: such requests are refused.
  std::function<void(uint64_t session, uint32_t request, const ControlRulesRequest& wish)> controlled;
  /// Called for the host's own figures, which /metrics shows behind the server's; on the network thread.
  std::function<std::vector<Figure>()> figures;
  /// Called when the simulation has ended, by the thread that stops the server.
  std::function<void()> stopped;
};

}  // namespace scree
