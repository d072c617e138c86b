// The rules of a running world: folders of Lua (mods) that hear what happens, decide what is allowed, and act
// by commands. A host's hooks for a LiveServer, or for a world that is stepped by hand.
//
// What a script does enters the world as a command of the server itself, in the name "rules NAME". So a
// recording verifies, and a world goes on, without the scripts. All rules of a tick share one budget; what
// does not fit waits for the next tick, and a request that nobody had time to decide on is refused.
//
// Threads: load() and reload() load files in the caller's thread, or in the one that watches; before() and
// after() are of the thread that simulates; the rest may be called by any.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/host/host_hooks.h"
#include "server/rules/happenings.h"
#include "server/rules/mod.h"

namespace scree {

struct RulesOptions {
  std::vector<std::string> folders;                ///< in the order in which they hear of things; not empty
  uint32_t memory_mb = 16;                         ///< of each script
  uint32_t percent = limits::rules_percent_usual;  ///< of a tick's length, for all of them
  /// Processor time that a call may take, as a multiple of what its work stands for.
  double backstop = limits::backstop_usual;
  bool watch = false;  ///< files that change are read again
  uint32_t tick_rate_hz = 60;
  /// Gets each line, and whether something is wrong; on any thread. May be empty.
  std::function<void(const std::string& line, bool is_fault)> log;
};

class Rules {
 public:
  /// Loads all folders. The error says file, line and what was wrong.
  static Result<std::unique_ptr<Rules>> load(RulesOptions options);
  ~Rules();
  Rules(const Rules&) = delete;
  Rules& operator=(const Rules&) = delete;

  /// The object must outlive who has them.
  HostHooks hooks();

  /// Loads all folders anew; the rules in force change with the next tick. The error says what is wrong, and
  /// the old ones stay in force.
  Result<void> reload();

  /// What hooks() are made of.
  void start(const HostActs& acts);
  void before(const World& world, TickCommands& commands);
  void after(const TickDelta& delta);
  bool hear_line(const SaidMessage& line);
  void join(const JoinedPerson& person);
  void leave(uint64_t session);
  void hear(uint64_t session, const ChannelData& data);
  void control(uint64_t session, uint32_t request, const ControlRulesRequest& wish);
  /// As of the last second.
  std::vector<Figure> figures() const;

  /// Whether a mod has a handler of the event. For the simulation's thread.
  bool is_wanted(std::string_view event) const;
  /// Calls that failed since the rules were loaded. Likewise.
  uint64_t faults() const;
  /// The mods and their handlers in words. Likewise.
  std::string list() const;
  /// Runs a line in the mod of that name, or the first one. Likewise, within before().
  std::string run_line(const std::string& mod, const std::string& line, RulesMoment& moment);

 private:
  using Mods = std::vector<std::unique_ptr<Mod>>;
  struct Control {
    uint64_t session = 0;
    uint32_t request = 0;
    ControlRulesRequest wish;
  };
  struct Inbox {
    std::vector<JoinedPerson> joined;
    std::vector<uint64_t> left;
    std::vector<std::pair<uint64_t, ChannelData>> heard;
    std::vector<SaidMessage> said;
    std::vector<Control> controls;
  };

  explicit Rules(RulesOptions options);
  Result<Mods> load_mods();
  void told(const std::string& line, bool is_fault);
  void run_jobs();
  void reload_for(const Control& control);
  void answer(const Control& control, std::string text);

  void begin_tick(const World& world);
  void note_figures();
  void take_persons(const Inbox& inbox, RulesMoment& moment, ScriptBudget& budget);
  void decide(TickCommands& commands, RulesMoment& moment, ScriptBudget& budget);
  void decide_on(size_t index, TickCommands& commands, RulesMoment& moment, ScriptBudget& budget);
  void pass_lines(const Inbox& inbox, RulesMoment& moment, ScriptBudget& budget);
  void queue_heard(const Inbox& inbox);
  void queue(Happening happening);
  void tell_happenings(RulesMoment& moment, ScriptBudget& budget);
  void tell_all(std::string_view event, RulesMoment& moment, ScriptBudget& budget, const Mod::Write& write);

  RulesOptions options_;
  Mods mods_;                            ///< of the simulation's thread, as the next ones
  std::unique_ptr<Happenings> derived_;  ///< null before the first tick
  void follow_parties(const TickCommands& commands);

  RulesPersons persons_;
  RulesParties parties_;
  std::deque<Happening> waiting_;
  uint64_t left_out_ = 0;  ///< happenings, since it was said
  std::vector<Reply> replies_;
  uint32_t next_request_ = 1;
  bool is_new_ = true, was_reloaded_ = false;

  mutable std::mutex mutex_;  ///< guards the members below
  std::condition_variable wake_;
  HostActs acts_;
  Inbox inbox_;
  std::shared_ptr<Mods> next_mods_;  ///< in force from the next tick on; null: none
  std::vector<Control> reloads_;
  std::deque<std::string> lines_;  ///< the last ones
  std::vector<Figure> figures_;
  bool hears_lines_ = false;  ///< a mod has a handler for what persons say
  bool stops_ = false;
  std::thread worker_;  ///< that loads, and watches
};

}  // namespace scree
