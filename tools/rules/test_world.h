// A world with rules that is stepped by hand, for tests of rules: as fast as it goes, without a network.
// Persons are here by name; what they ask for passes their role and the rules as on a server. Distances from
// the eye (reach), sight and the number of requests a second are the network side's, and not tested here.
// One thread.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/command/command.h"
#include "server/rules/rules.h"
#include "server/world/world.h"

namespace scree {

struct TestWorldOptions {
  std::vector<std::string> folders;  ///< of rules
  WorldConfig world;
};

/// A person, and what a client of his would have got.
struct TestPerson {
  JoinedPerson who;
  bool here = true;
  std::vector<std::string> lines;
  std::vector<ChannelData> messages;
  uint32_t requests = 0;  ///< the number of the last one
  uint32_t inputs = 0;    ///< likewise, of walking
};

/// A cue, and for whom it was.
struct TestCue {
  Audience to;
  Cue cue;
};

class TestWorld {
 public:
  /// Makes the world and loads the rules, which begin in the first tick.
  static Result<std::unique_ptr<TestWorld>> create(TestWorldOptions options);

  void step();
  Tick tick() const { return world_->tick(); }
  uint32_t rate_hz() const { return world_->config().tick_rate_hz; }
  World& world() { return *world_; }
  const Rules& rules() const { return *rules_; }

  /// Returns the session.
  uint64_t join(const std::string& name, Role role, const std::string& team);
  void leave(uint64_t session);
  /// Null: there never was such a session.
  const TestPerson* person(uint64_t session) const;
  /// The team that counts for a person: that of the game, or else the token's.
  std::string team_of(uint64_t session) const;
  /// Where the person is on foot.
  std::optional<PersonPlace> place_of(uint64_t session) const;

  /// Asks with the next step; session 0: the server itself. The number finds the reply.
  uint32_t ask(uint64_t session, Request request);
  /// Nothing: it is not answered yet. A reply is taken once.
  std::optional<Reply> take_reply(uint64_t session, uint32_t request);
  void walk(uint64_t session, const WalkRequest& input);
  void say(uint64_t session, const std::string& text);
  void send(uint64_t session, ChannelData data);

  /// The server ends and starts again: the world goes on from what it saves, the rules are loaded anew, and
  /// nobody is here.
  Result<void> restart();
  Result<void> reload();
  /// Runs a line in the rules as a console does, within the next step.
  std::string run(const std::string& rules, const std::string& line);

  std::vector<Sign> signs_of(uint64_t session) const;
  const std::vector<TestCue>& cues() const { return cues_; }
  /// Calls of the rules that failed, of those that ended by a reload or a restart, too.
  uint64_t faults() const { return faults_before_ + rules_->faults(); }
  /// What the rules printed and what was said of their faults.
  const std::vector<std::string>& log() const { return log_; }
  /// Mass that is nowhere, in units of 1/254 voxel: of the ledger, and of the terrain as measured beside it.
  MassUnits ledger_error();
  /// What a moment of the rules holds, to read and write tables of scripts by. Valid until the next step.
  RulesMoment moment() const;

 private:
  explicit TestWorld(TestWorldOptions options) : options_(std::move(options)) {}
  Result<void> load_rules();
  HostActs acts();
  void receive(uint64_t session, const ServerMessage& message);
  void deliver(const TickDelta& delta);
  Asker asker_of(uint64_t session) const;

  TestWorldOptions options_;
  std::vector<std::string> log_;  // before the rules, which write to it to the last
  std::unique_ptr<World> world_;
  std::unique_ptr<Rules> rules_;
  std::map<uint64_t, TestPerson> persons_;
  RulesPersons present_;
  uint64_t next_session_ = 1;
  uint32_t next_own_ = 0;
  uint32_t next_control_ = 0;
  std::vector<Command> waiting_;
  std::vector<uint64_t> kicked_;
  std::map<std::pair<uint64_t, uint32_t>, Reply> replies_;
  std::map<uint32_t, std::string> answers_;  ///< of the console
  std::vector<TestCue> cues_;
  Ledger ledger_;
  uint64_t faults_before_ = 0;
};

}  // namespace scree
