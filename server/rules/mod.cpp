#include "server/rules/mod.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "server/rules/api.h"
#include "server/rules/limits.h"
#include "server/rules/mod_name.h"
#include "server/rules/prelude.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// "main.lua:3: no such …", with the traceback below.
std::string words_of(const std::string& what, const ScriptFault& fault) {
  return what + ": " + fault.text();
}

}  // namespace

Mod::Mod(ModOptions options) : options_(std::move(options)) {}
Mod::~Mod() = default;

Result<std::unique_ptr<Mod>> Mod::load(ModOptions options) {
  if (options.name.empty())
    options.name = std::filesystem::weakly_canonical(options.folder).filename().string();
  if (!is_mod_name(options.name))
    return fail("the folder of rules " + options.folder + " has the name '" + options.name +
                "', and rules have names of 1 to " + std::to_string(limits::mod_name_bytes_max) +
                " of A-Z, a-z, 0-9, _ and -");
  auto mod = std::unique_ptr<Mod>(new Mod(std::move(options)));
  TRY(mod->bind_and_load());
  return mod;
}

Result<void> Mod::bind_and_load() {
  auto script = TRY(Script::create({.name = options_.name,
                                    .folder = options_.folder,
                                    .memory_max_bytes = options_.memory_bytes,
                                    .work_max = limits::load_work_max,
                                    .cpu_max_s = limits::load_cpu_max_s,
                                    .print = [this](std::string_view line) { say(std::string(line)); }}));
  script_ = std::make_unique<Script>(std::move(script));
  for (const ApiFunction& row : all_api()) {
    const auto bound = [this, row](ScriptCall& call) -> Result<void> {
      if (moment_ == nullptr && !row.at_load)
        return fail("files only say what is to happen: ask for this in a handler, such as on.start");
      RulesCall rules{*this, moment_ != nullptr ? *moment_ : loading_, call};
      return row.run(rules);
    };
    if (row.table.ends_with(':'))
      script_->define_method(row.table.substr(0, row.table.size() - 1), row.name, bound);
    else
      script_->define(row.table, row.name, bound);
  }
  ScriptBudget budget{limits::load_work_max, limits::load_cpu_max_s};
  if (const auto loaded = load_prelude(*script_, budget); !loaded)
    return fail("the prelude of rules: " + loaded.error().text());
  if (const auto loaded = script_->load("init.lua", budget); !loaded)
    return fail("rules " + options_.name + ": " + loaded.error().text());
  return {};
}

bool Mod::has_handler(std::string_view event) const {
  return std::ranges::any_of(handlers_, [&](const HandlerState& one) { return one.event == event; });
}

void Mod::add_handler(std::string_view event, ScriptFunction function) {
  handlers_.push_back({.event = std::string(event), .function = std::move(function)});
}

bool Mod::call_once(const ScriptFunction& function, const std::string& what, RulesMoment& moment,
                    ScriptBudget& budget, const Write& arguments, const Script::ReadResults& results) {
  moment_ = &moment;
  const auto ended = script_->call(function, arguments, budget, results);
  moment_ = nullptr;
  if (!ended) complain(words_of(what, ended.error()));
  return ended.has_value();
}

namespace {

/// How long what failed so often in a row rests, ticks.
Tick rest_ticks(uint32_t faults, uint32_t tick_rate_hz) {
  const uint32_t doublings = std::min(faults - limits::handler_faults_max, limits::handler_rest_doublings);
  return static_cast<Tick>(limits::handler_rest_s * tick_rate_hz) << doublings;
}

}  // namespace

bool Mod::rests(HandlerState& handler, const RulesMoment& moment) const {
  if (handler.rests_until == 0) return false;
  if (moment.world->tick() < handler.rests_until) return true;
  handler.rests_until = 0;
  return false;
}

void Mod::note_call(HandlerState& handler, bool done, const RulesMoment& moment) {
  ++handler.calls;
  if (done) {
    handler.faults = 0;
    return;
  }
  ++handler.faults_all;
  if (++handler.faults < limits::handler_faults_max) return;
  const Tick rest = rest_ticks(handler.faults, options_.tick_rate_hz);
  handler.rests_until = moment.world->tick() + rest;
  complain("on." + handler.event + " failed " + std::to_string(handler.faults) +
           " times in a row: it rests for " + std::to_string(rest / options_.tick_rate_hz) + " s");
}

void Mod::tell(std::string_view event, RulesMoment& moment, ScriptBudget& budget, const Write& event_table,
               const Answered& answered) {
  CHECK(moment.world != nullptr);
  bool goes_on = true;
  // A handler may add others, which hear of the next event.
  for (size_t i = 0, count = handlers_.size(); i < count && goes_on; ++i) {
    if (handlers_[i].event != event || rests(handlers_[i], moment)) continue;
    const ScriptFunction function = handlers_[i].function;
    Script::ReadResults read;
    if (answered)
      read = [&](const std::vector<ScriptValue>& results) -> Result<void> {
        if (results.empty()) return {};
        const Result<bool> may_go_on = answered(results.front());
        if (!may_go_on) return fail(may_go_on.error().message);
        goes_on = *may_go_on;
        return {};
      };
    const bool done = call_once(function, "on." + handlers_[i].event, moment, budget, event_table, read);
    note_call(handlers_[i], done, moment);
  }
}

bool Mod::any_rests(std::string_view event, const RulesMoment& moment) const {
  return std::ranges::any_of(handlers_, [&](const HandlerState& one) {
    return one.event == event && one.rests_until > moment.world->tick();
  });
}

uint64_t Mod::faults() const {
  uint64_t faults = timer_faults_;
  for (const HandlerState& handler : handlers_) faults += handler.faults_all;
  return faults;
}

void Mod::run_timers(RulesMoment& moment, ScriptBudget& budget) {
  const Tick now = moment.world->tick();
  std::vector<uint64_t> due;
  for (const Timer& timer : timers_)
    if (timer.due <= now) due.push_back(timer.number);
  for (const uint64_t number : due) {
    if (budget.work <= 0 || budget.cpu_s <= 0.0) return;  // the others are due in the next tick, too
    const auto at = std::ranges::find(timers_, number, &Timer::number);
    if (at == timers_.end()) continue;  // one before it took it away
    const ScriptFunction function = at->function;
    at->due = now + at->every;
    const bool repeats = at->every != 0;
    if (!repeats) timers_.erase(at);
    const bool done = call_once(function, "a timer", moment, budget, nullptr, nullptr);
    if (!done) ++timer_faults_;
    const auto after = std::ranges::find(timers_, number, &Timer::number);
    if (after == timers_.end()) continue;
    after->faults = done ? 0 : after->faults + 1;
    if (after->faults < limits::handler_faults_max) continue;
    const Tick rest = rest_ticks(after->faults, options_.tick_rate_hz);
    after->due = now + rest;
    complain("a timer failed " + std::to_string(after->faults) + " times in a row: it rests for " +
             std::to_string(rest / options_.tick_rate_hz) + " s");
  }
}

void Mod::reply(const Reply& reply, RulesMoment& moment, ScriptBudget& budget) {
  const auto at = std::ranges::find(awaited_, reply.request, &AwaitedReply::request);
  if (at == awaited_.end()) return;
  const ScriptFunction function = at->function;
  awaited_.erase(at);
  const auto write = [&](ScriptWriter& to) { write_reply(to, reply, moment); };
  if (!call_once(function, "a reply", moment, budget, write, nullptr)) ++timer_faults_;
}

void Mod::note_reply(const Reply& reply) {
  if (unheard_.erase(reply.request) > 0 && !reply.refusal.empty())
    complain("what it asked for was refused (" + refusal_name(reply) + "): " + reply.refusal);
}

bool Mod::awaits(uint32_t request) const {
  return std::ranges::any_of(awaited_, [&](const AwaitedReply& one) { return one.request == request; });
}

std::string Mod::run(std::string_view line, RulesMoment& moment, ScriptBudget& budget) {
  moment_ = &moment;
  const auto shown = script_->run(line, budget);
  moment_ = nullptr;
  return shown ? *shown : "error: " + shown.error().text();
}

Result<uint32_t> Mod::ask(RulesMoment& moment, Request request, uint64_t party, ScriptFunction reply) {
  CHECK(moment.commands != nullptr);
  if (moment.commands->added() >= limits::rules_commands_max)
    return fail("rules ask for " + std::to_string(limits::rules_commands_max) + " things a tick at most");
  const uint32_t number = (*moment.next_request)++;
  moment.commands->add(std::move(request), number, "rules " + options_.name, party);
  if (reply && awaited_.size() < limits::awaited_replies_max)
    awaited_.push_back({number, std::move(reply)});
  else if (unheard_.size() < limits::awaited_replies_max)
    unheard_.insert(number);
  return number;
}

uint64_t Mod::add_timer(const RulesMoment& moment, Tick after_ticks, Tick every_ticks,
                        ScriptFunction function) {
  const Tick now = moment.world != nullptr ? moment.world->tick() : 0;
  timers_.push_back({next_timer_, now + after_ticks, every_ticks, std::move(function)});
  return next_timer_++;
}

bool Mod::remove_timer(uint64_t timer) {
  return std::erase_if(timers_, [&](const Timer& one) { return one.number == timer; }) > 0;
}

std::optional<std::optional<std::string>> Mod::written(const std::string& key) const {
  const auto at = written_.find(key);
  if (at == written_.end()) return std::nullopt;
  return std::optional<std::optional<std::string>>(std::in_place, at->second);
}

void Mod::say(const std::string& line) {
  tell_log(line, false);
}

void Mod::complain(const std::string& line) {
  tell_log(line, true);
}

void Mod::tell_log(const std::string& line, bool is_fault) {
  if (!lines_.try_spend(now_s_)) {
    ++lines_left_out_;
    return;
  }
  const std::string more =
      lines_left_out_ == 0 ? ""
                           : " (" + std::to_string(std::exchange(lines_left_out_, 0)) + " lines left out)";
  options_.told("[" + options_.name + "] " + line + more, is_fault);
}

void Mod::begin_tick(uint64_t random_seed, double now_s) {
  now_s_ = now_s;
  written_.clear();
  script_->seed(random_seed);
}

}  // namespace scree
