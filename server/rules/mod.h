// One folder of rules: its script, its handlers, timers and replies that it waits for. Of the thread that
// simulates, but for load(), which any one thread may call before.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/rules/rules_moment.h"
#include "server/rules/sandbox/script.h"
#include "shared/base/ids.h"
#include "shared/base/result.h"
#include "shared/operation/request.h"

namespace scree {

struct ModOptions {
  std::string folder;                       ///< with init.lua
  std::string name;                         ///< of the mod: the folder's; names it in messages and commands
  size_t memory_bytes = size_t{16} << 20U;  ///< of its script
  uint32_t tick_rate_hz = 60;
  std::function<void(const std::string&)>
      told;  ///< gets what it prints, and its faults: a line each, or more
};

/// What became of a handler, or of a timer.
struct HandlerState {
  std::string event;  ///< "tick", or "a timer"
  ScriptFunction function;
  uint32_t faults = 0;   ///< in a row
  Tick rests_until = 0;  ///< 0: it does not rest
  uint64_t calls = 0;    ///< in all
  uint64_t faults_all = 0;
};

class Mod {
 public:
  /// Loads the folder's init.lua. The error has file, line and what was wrong.
  static Result<std::unique_ptr<Mod>> load(ModOptions options);
  ~Mod();
  Mod(const Mod&) = delete;
  Mod& operator=(const Mod&) = delete;

  const std::string& name() const { return options_.name; }
  const ModOptions& options() const { return options_; }
  const Script& script() const { return *script_; }
  std::span<const HandlerState> handlers() const { return handlers_; }
  bool has_handler(std::string_view event) const;

  /// Calls the handlers of an event, in the order in which they were given. `answered` gets what each
  /// returned; false from it ends the calls.
  using Write = std::function<void(ScriptWriter& to)>;
  using Answered = std::function<bool(const ScriptValue& value)>;
  void tell(std::string_view event, RulesMoment& moment, ScriptBudget& budget, const Write& event_table,
            const Answered& answered = nullptr);
  /// Calls the timers that are due, and those that wait for these replies.
  void run_timers(RulesMoment& moment, ScriptBudget& budget);
  void reply(const Reply& reply, RulesMoment& moment, ScriptBudget& budget);
  /// Runs a line of a console, and gives what it shows.
  std::string run(std::string_view line, RulesMoment& moment, ScriptBudget& budget);

  // For bound functions (api.h).

  /// Adds a command of this mod. `party`: whose pieces and falls it makes; 0: nobody's. The function gets the
  /// reply. Returns the number of the request.
  uint32_t ask(RulesMoment& moment, Request request, uint64_t party, ScriptFunction reply = {});
  void add_handler(std::string_view event, ScriptFunction function);
  /// `every_ticks` 0: once. Returns the timer's number.
  uint64_t add_timer(const RulesMoment& moment, Tick after_ticks, Tick every_ticks, ScriptFunction function);
  /// False: there is none of that number.
  bool remove_timer(uint64_t timer);
  void say(const std::string& line) const { options_.told("[" + options_.name + "] " + line); }

 private:
  struct Timer {
    uint64_t number = 0;
    Tick due = 0;
    Tick every = 0;
    ScriptFunction function;
    uint32_t faults = 0;
  };

  explicit Mod(ModOptions options);
  Result<void> bind_and_load();
  void call(HandlerState& handler, RulesMoment& moment, ScriptBudget& budget, const Write& arguments,
            const Script::ReadResults& results);
  bool call_once(const ScriptFunction& function, const std::string& what, RulesMoment& moment,
                 ScriptBudget& budget, const Write& arguments);

  ModOptions options_;
  std::unique_ptr<Script> script_;
  RulesMoment* moment_ = nullptr;  ///< of the call that runs; null: files load
  RulesMoment loading_;
  std::vector<HandlerState> handlers_;
  std::vector<Timer> timers_;  ///< by number
  uint64_t next_timer_ = 1;
  std::vector<AwaitedReply> awaited_;
};

}  // namespace scree
