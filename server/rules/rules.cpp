#include "server/rules/rules.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "server/rules/limits.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

namespace {

/// A seed for the tick's random numbers, of the world and the tick alone.
uint64_t seed_of(const World& world) {
  Random random((uint64_t{world.config().terrain.random_seed} << 32U) ^ world.tick());
  const uint64_t high = random.next();
  return high << 32U | random.next();
}

bool is_spent(const ScriptBudget& budget) {
  return budget.work <= 0 || budget.cpu_s <= 0.0;
}

/// Work is what is shared out. Processor time is a backstop, for what reads new ground costs more than it
/// counts; `backstop`: so many times the work's own.
ScriptBudget budget_of(double work_s, double backstop) {
  constexpr double ns_per_s = 1e9;
  return {static_cast<int64_t>(work_s * ns_per_s / limits::script_work_ns), work_s * backstop};
}

}  // namespace

Rules::Rules(RulesOptions options) : options_(std::move(options)) {}

HostHooks Rules::hooks() {
  return {.started = [this](const HostActs& acts) { start(acts); },
          .before = [this](const World& world, TickCommands& commands) { before(world, commands); },
          .after = [this](const TickDelta& delta) { after(delta); },
          .said = [this](const SaidMessage& line) { return hear_line(line); },
          .joined = [this](const JoinedPerson& person) { join(person); },
          .left = [this](uint64_t session) { leave(session); },
          .heard = [this](uint64_t session, const ChannelData& data) { hear(session, data); },
          .controlled = [this](uint64_t session, uint32_t request,
                               const ControlRulesRequest& wish) { control(session, request, wish); },
          .figures = [this] { return figures(); },
          .stopped = nullptr};
}

bool Rules::is_wanted(std::string_view event) const {
  return std::ranges::any_of(mods_, [&](const auto& mod) { return mod->has_handler(event); });
}

uint64_t Rules::faults() const {
  uint64_t faults = 0;
  for (const auto& mod : mods_) faults += mod->faults();
  return faults;
}

/// The rules that were loaded since the last tick come into force.
void Rules::begin_tick(const World& world) {
  {
    const std::scoped_lock lock(mutex_);
    if (next_mods_ != nullptr) {
      mods_ = std::move(*next_mods_);
      next_mods_.reset();
      is_new_ = was_reloaded_ = true;
      waiting_.clear();
      replies_.clear();
    }
    hears_lines_ = is_wanted("say");
  }
  if (derived_ == nullptr)
    derived_ = std::make_unique<Happenings>(world.config().terrain.voxel_size_m, world.config().palette);
  const double now_s = static_cast<double>(world.tick()) / options_.tick_rate_hz;
  for (const auto& mod : mods_) mod->begin_tick(seed_of(world), now_s);
  if (world.tick() % options_.tick_rate_hz == 0) note_figures();
}

void Rules::before(const World& world, TickCommands& commands) {
  begin_tick(world);
  Inbox inbox;
  HostActs acts;
  {
    const std::scoped_lock lock(mutex_);
    inbox = std::exchange(inbox_, {});
    acts = acts_;
  }
  RulesMoment moment;
  moment.world = &world;
  moment.commands = &commands;
  moment.persons = &persons_;
  moment.parties = &parties_;
  moment.acts = &acts;
  moment.next_request = &next_request_;
  ScriptBudget budget = budget_of(0.01 * options_.percent / options_.tick_rate_hz, options_.backstop);
  ScriptBudget start = budget_of(limits::start_work_s, options_.backstop);
  if (std::exchange(is_new_, false))
    tell_all("start", moment, start, [&](ScriptWriter& to) {
      to.name("reloaded");
      to.boolean(was_reloaded_);
      to.name("restarted");
      to.boolean(world.tick() > 0 && !was_reloaded_);
    });
  // Who came has come before he asks for something; what he asks for is decided before all else.
  take_persons(inbox, moment, budget);
  follow_parties(commands);
  decide(commands, moment, budget);
  pass_lines(inbox, moment, budget);
  queue_heard(inbox);
  tell_happenings(moment, budget);
  for (const Reply& reply : std::exchange(replies_, {}))
    for (const auto& mod : mods_) {
      mod->note_reply(reply);
      if (mod->awaits(reply.request)) mod->reply(reply, moment, budget);
    }
  for (const auto& mod : mods_) mod->run_timers(moment, budget);
  const auto write_tick = [&](ScriptWriter& to) {
    to.name("tick");
    to.integer(static_cast<int64_t>(world.tick()));
    to.name("time");
    to.number(static_cast<double>(world.tick()) / options_.tick_rate_hz);
    to.name("dt");
    to.number(1.0 / options_.tick_rate_hz);
  };
  tell_all("tick", moment, budget, write_tick);
  const auto save_period = static_cast<Tick>(limits::save_period_s * options_.tick_rate_hz);
  if (world.tick() % save_period == save_period - 1) tell_all("save", moment, budget, write_tick);
  for (const Control& control : inbox.controls) {
    std::string text = control.wish.control == RulesControl::list
                           ? list()
                           : run_line(control.wish.rules, control.wish.line, moment);
    answer(control, std::move(text));
  }
}

/// Who left is forgotten once there are many.
void Rules::follow_parties(const TickCommands& commands) {
  for (const Command& command : commands.all())
    if (persons_.contains(command.session)) parties_[party_of(command)] = command.session;
  if (parties_.size() <= 2 * persons_.size() + limits::parties_known_min) return;
  std::erase_if(parties_, [&](const auto& one) { return !persons_.contains(one.second); });
}

void Rules::tell_all(std::string_view event, RulesMoment& moment, ScriptBudget& budget,
                     const Mod::Write& write) {
  for (const auto& mod : mods_) {
    if (!mod->has_handler(event) || is_spent(budget)) continue;
    mod->tell(event, moment, budget, [&](ScriptWriter& to) {
      to.open_table();
      write(to);
      to.close_table();
    });
  }
}

void Rules::take_persons(const Inbox& inbox, RulesMoment& moment, ScriptBudget& budget) {
  const auto write_person = [](uint64_t session) {
    return [session](ScriptWriter& to) {
      to.name("person");
      to.handle({"person", session});
    };
  };
  for (const JoinedPerson& person : inbox.joined) {
    if (person.administers) continue;
    persons_[person.session] = {person};
    tell_all("join", moment, budget, [&](ScriptWriter& to) {
      write_person(person.session)(to);
      to.name("resumed");
      to.boolean(person.resumed);
    });
  }
  for (const uint64_t session : inbox.left) {
    if (!persons_.contains(session)) continue;
    tell_all("leave", moment, budget, write_person(session));
    persons_.erase(session);
  }
}

/// A line that a rule lets through is said as the person said it; else he gets the rule's words.
void Rules::pass_lines(const Inbox& inbox, RulesMoment& moment, ScriptBudget& budget) {
  for (const SaidMessage& line : inbox.said) {
    std::optional<std::string> refusal;
    const auto write = [&](ScriptWriter& to) {
      to.open_table();
      to.name("by");
      to.handle({"person", line.session});
      to.name("text");
      to.text(line.text);
      to.close_table();
    };
    const auto answered = [&](const ScriptValue& value) -> Result<bool> {
      if (value.is_nil()) return true;
      if (value.is_text())
        refusal = std::string(TRY(value.text()));
      else if (!TRY(value.boolean()))
        refusal = "";
      return !refusal.has_value();
    };
    for (const auto& mod : mods_)
      if (!refusal && !is_spent(budget)) mod->tell("say", moment, budget, write, answered);
    if (!refusal)
      for (const auto& [session, person] : persons_)
        if (person.who.meets) moment.acts->send(session, line);
    if (refusal && !refusal->empty())
      moment.acts->send(line.session, SaidMessage{0, "", showable(*refusal, limits::notice_line_bytes_max)});
  }
}

void Rules::queue(Happening happening) {
  if (waiting_.size() < limits::happenings_waiting_max)
    waiting_.push_back(std::move(happening));
  else
    ++left_out_;
}

void Rules::queue_heard(const Inbox& inbox) {
  if (!is_wanted("message")) return;
  for (const auto& [session, data] : inbox.heard) {
    if (!persons_.contains(session)) continue;
    queue({"message", [session = session, data = data](ScriptWriter& to, RulesMoment&) {
             to.name("by");
             to.handle({"person", session});
             to.name("channel");
             to.text(data.channel);
             to.name("bytes");
             to.text({reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size()});
           }});
  }
}

void Rules::tell_happenings(RulesMoment& moment, ScriptBudget& budget) {
  if (const uint64_t lost = std::exchange(left_out_, 0); lost > 0)
    told(fmt::format("rules had no time for {} happenings, and will not tell them", lost), true);
  while (!waiting_.empty() && !is_spent(budget)) {
    const Happening happening = std::move(waiting_.front());
    waiting_.pop_front();
    tell_all(happening.event, moment, budget, [&](ScriptWriter& to) { happening.write(to, moment); });
  }
}

void Rules::after(const TickDelta& delta) {
  if (derived_ == nullptr) return;
  for (Happening& happening :
       derived_->derive(delta, [this](std::string_view event) { return is_wanted(event); }))
    queue(std::move(happening));
  for (const Reply& reply : delta.replies)
    if (reply.session == 0) replies_.push_back(reply);
}

std::string Rules::run_line(const std::string& mod, const std::string& line, RulesMoment& moment) {
  const auto at = mod.empty()
                      ? mods_.begin()
                      : std::ranges::find_if(mods_, [&](const auto& one) { return one->name() == mod; });
  if (at == mods_.end()) return "error: there are no rules of the name " + mod;
  ScriptBudget budget = budget_of(limits::console_cpu_max_s, options_.backstop);
  return (*at)->run(line, moment, budget);
}

std::string Rules::list() const {
  std::string text;
  for (const auto& mod : mods_) {
    const Script::Used used = mod->script().used();
    text += fmt::format("{}: {:.1f} MB, {:.3f} s of processor time, {} timers\n", mod->name(),
                        static_cast<double>(used.memory_bytes) / 1e6, used.cpu_s, mod->timers());
    for (const HandlerState& handler : mod->handlers())
      text += fmt::format("  on.{}: {} calls, {} failed{}\n", handler.event, handler.calls,
                          handler.faults_all, handler.rests_until != 0 ? ", rests" : "");
  }
  const std::scoped_lock lock(mutex_);
  for (const std::string& line : lines_) text += line + "\n";
  return text;
}

}  // namespace scree
