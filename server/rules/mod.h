// One folder of rules: its script, its handlers, timers and replies that it waits for. The thread
// that simulates has it, but for load(), which any one thread may call before.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/command/command.h"
#include "server/rules/limits.h"
#include "server/rules/rules_moment.h"
#include "server/rules/sandbox/script.h"
#include "shared/base/ids.h"
#include "shared/base/rate_limit.h"
#include "shared/base/result.h"
#include "shared/operation/request.h"

namespace scree {

struct ModOptions {
  std::string folder;                       ///< with init.lua
  std::string name;                         ///< of the mod: the folder's; names it in messages and commands
  size_t memory_bytes = size_t{16} << 20U;  ///< of its script
  uint32_t tick_rate_hz = 60;
  std::function<void(const std::string& line, bool is_fault)>
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
  /// Whether a handler of the event rests, because it failed too often.
  bool any_rests(std::string_view event, const RulesMoment& moment) const;
  /// Calls that failed, in all.
  uint64_t faults() const;
  bool awaits(uint32_t request) const;
  /// Logs the refusal of a request whose reply no function waits for.
  void note_reply(const Reply& reply);

  /// What it kept in the tick before is the world's now; random numbers begin anew.
  void begin_tick(uint64_t random_seed, double now_s);

  /// Calls the handlers of an event, in the order in which they were given. `answered` gets what each
  /// returned; false from it ends the calls, and an error is the handler's.
  using Write = std::function<void(ScriptWriter& to)>;
  using Answered = std::function<Result<bool>(const ScriptValue& value)>;
  void tell(std::string_view event, RulesMoment& moment, ScriptBudget& budget, const Write& event_table,
            const Answered& answered = nullptr);
  /// Calls the timers that are due, and those that wait for these replies.
  void run_timers(RulesMoment& moment, ScriptBudget& budget);
  void reply(const Reply& reply, RulesMoment& moment, ScriptBudget& budget);
  /// Runs a line of a console, and gives what it shows.
  std::string run(std::string_view line, RulesMoment& moment, ScriptBudget& budget);

  // For bound functions (api.h).

  /// Adds a command of this mod. `party`: whose pieces and falls it makes; 0: nobody's. The function gets the
  /// reply. Returns the number of the request; refuses more than limits::rules_commands_max a tick.
  Result<uint32_t> ask(RulesMoment& moment, Request request, uint64_t party, ScriptFunction reply = {});
  void add_handler(std::string_view event, ScriptFunction function);
  /// `every_ticks` 0: once. Returns the timer's number.
  uint64_t add_timer(const RulesMoment& moment, Tick after_ticks, Tick every_ticks, ScriptFunction function);
  /// False: there is none of that number.
  bool remove_timer(uint64_t timer);
  size_t timers() const { return timers_.size(); }
  /// What was kept under a key since the last tick: nothing inside where it was forgotten, nothing at all
  /// where it was not changed.
  std::optional<std::optional<std::string>> written(const std::string& key) const;
  void note_written(const std::string& key, std::optional<std::string> value) {
    written_[key] = std::move(value);
  }
  const std::map<std::string, std::optional<std::string>>& all_written() const { return written_; }
  /// A line of the log; too many are counted.
  void say(const std::string& line);
  /// The same of what is wrong.
  void complain(const std::string& line);

 private:
  struct Timer {
    uint64_t number = 0;
    Tick due = 0;
    Tick every = 0;
    ScriptFunction function;
    uint32_t faults = 0;
  };

  explicit Mod(ModOptions options);
  void tell_log(const std::string& line, bool is_fault);
  Result<void> bind_and_load();
  bool rests(HandlerState& handler, const RulesMoment& moment) const;
  void note_call(HandlerState& handler, bool done, const RulesMoment& moment);
  /// False: it failed, which is said.
  bool call_once(const ScriptFunction& function, const std::string& what, RulesMoment& moment,
                 ScriptBudget& budget, const Write& arguments, const Script::ReadResults& results);

  ModOptions options_;
  std::unique_ptr<Script> script_;
  RulesMoment* moment_ = nullptr;  ///< of the call that runs; null: files load
  RulesMoment loading_;
  std::vector<HandlerState> handlers_;
  std::vector<Timer> timers_;  ///< by number
  uint64_t next_timer_ = 1;
  std::vector<AwaitedReply> awaited_;
  std::set<uint32_t> unheard_;  ///< requests whose reply no function waits for
  std::map<std::string, std::optional<std::string>> written_;
  uint64_t timer_faults_ = 0;
  RateLimit lines_{limits::mod_lines_per_second, limits::mod_lines_burst};
  uint64_t lines_left_out_ = 0;
  double now_s_ = 0.0;
};

}  // namespace scree
