#include "tools/rules/test_world.h"

#include <algorithm>
#include <utility>

#include "server/doors/access.h"
#include "server/doors/authorizer.h"
#include "server/formats/world_value.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"

namespace scree {

namespace {

/// A processor that is busy with other things must not decide whether a test passes: as much time as a tick
/// has. What the script may do is still bounded, as it is on a server with --rules-work 50.
constexpr uint32_t percent_in_tests = limits::rules_percent_max;

/// Numbers of the server's own requests here, which the rules number from 1.
constexpr uint32_t first_own_request = 0x80000000U;

}  // namespace

Result<std::unique_ptr<TestWorld>> TestWorld::create(TestWorldOptions options) {
  auto test = std::unique_ptr<TestWorld>(new TestWorld(std::move(options)));
  test->world_ = TRY(World::create(test->options_.world));
  TRY(test->load_rules());
  return test;
}

Result<void> TestWorld::load_rules() {
  RulesOptions options;
  options.folders = options_.folders;
  options.percent = percent_in_tests;
  options.tick_rate_hz = options_.world.tick_rate_hz;
  options.log = [this](const std::string& line, bool /*is_fault*/) { log_.push_back(line); };
  options.backstop = 1000.0;  // by work alone: a test ends the same on each machine
  rules_ = TRY(Rules::load(std::move(options)));
  rules_->start(acts());
  return {};
}

HostActs TestWorld::acts() {
  HostActs acts;
  acts.send = [this](uint64_t session, const ServerMessage& message) { receive(session, message); };
  acts.set_role = [this](uint64_t session, Role role) {
    if (const auto at = persons_.find(session); at != persons_.end()) at->second.who.role = role;
  };
  acts.kick = [this](uint64_t session, const std::string& words) {
    if (const auto at = persons_.find(session); at != persons_.end()) at->second.lines.push_back(words);
    kicked_.push_back(session);
  };
  return acts;
}

void TestWorld::receive(uint64_t session, const ServerMessage& message) {
  if (const auto* const list = std::get_if<AdminListMessage>(&message)) {
    answers_[list->request] = list->text;
    return;
  }
  const auto* const said = std::get_if<SaidMessage>(&message);
  const auto at = persons_.find(session);
  if (said != nullptr && at != persons_.end()) at->second.lines.push_back(said->text);
}

void TestWorld::step() {
  for (const uint64_t session : std::exchange(kicked_, {})) leave(session);
  TickCommands commands(std::exchange(waiting_, {}));
  rules_->before(*world_, commands);
  const auto delta = world_->step(commands.let_through());
  rules_->after(*delta);
  for (const Reply& reply : commands.refused()) replies_[{reply.session, reply.request}] = reply;
  deliver(*delta);
  ledger_ = delta->ledger;
}

void TestWorld::deliver(const TickDelta& delta) {
  for (const Reply& reply : delta.replies) replies_[{reply.session, reply.request}] = reply;
  for (const Notice& notice : delta.notices) {
    if (const auto* const cue = std::get_if<Cue>(&notice.what)) cues_.push_back({notice.to, *cue});
    for (auto& entry : persons_) {
      TestPerson& person = entry.second;
      if (!person.here || !is_meant(notice.to, entry.first, team_of(entry.first))) continue;
      std::visit(
          Overloaded{[&](const NoticeLine& line) { person.lines.push_back(line.text); },
                     [&](const ChannelData& data) { person.messages.push_back(data); }, [](const Cue&) {}},
          notice.what);
    }
  }
}

uint64_t TestWorld::join(const std::string& name, Role role, const std::string& team) {
  const uint64_t session = next_session_++;
  TestPerson& person = persons_[session];
  person.who = {.session = session, .name = name, .role = role, .team = team, .meets = true};
  present_[session] = {person.who};
  rules_->join(person.who);
  return session;
}

void TestWorld::leave(uint64_t session) {
  const auto at = persons_.find(session);
  if (at == persons_.end() || !at->second.here) return;
  at->second.here = false;
  present_.erase(session);
  rules_->leave(session);
  waiting_.push_back({session, 0, LeaveRequest{}});
}

const TestPerson* TestWorld::person(uint64_t session) const {
  const auto at = persons_.find(session);
  return at != persons_.end() ? &at->second : nullptr;
}

std::string TestWorld::team_of(uint64_t session) const {
  const std::vector<Player>& players = *world_->game().players;
  const auto at = std::ranges::find(players, session, &Player::session);
  if (at != players.end() && !at->team.empty()) return at->team;
  const TestPerson* const who = person(session);
  return who != nullptr ? who->who.team : std::string();
}

std::optional<PersonPlace> TestWorld::place_of(uint64_t session) const {
  for (const PersonPlace& place : world_->persons())
    if (place.session == session) return place;
  return std::nullopt;
}

/// As the network side knows them: the name counts, as if an access token stated it.
Asker TestWorld::asker_of(uint64_t session) const {
  const JoinedPerson& who = persons_.at(session).who;
  return {who.role, who.name, who.team};
}

uint32_t TestWorld::ask(uint64_t session, Request request) {
  if (session == 0) {
    const uint32_t number = first_own_request + ++next_own_;
    waiting_.push_back({.request = number, .body = std::move(request), .asker = {Role::admin, {}, {}}});
    return number;
  }
  TestPerson& person = persons_.at(session);
  const uint32_t number = ++person.requests;
  if (const auto may = check_role(person.who.role, role_for(request)); !may) {
    Reply reply{session, number, may.error().message, 0};
    reply.reason = may.error().reason;
    replies_[{session, number}] = reply;
    return number;
  }
  if (auto* const stand = std::get_if<StandRequest>(&request))
    if (!may_act_as(person.who.role, Role::director)) stand->place_m.reset();
  Command command{.session = session, .request = number, .body = std::move(request)};
  command.body = with_own_store(std::move(command.body), store_of_person(0, session));
  command.asker = asker_of(session);
  waiting_.push_back(std::move(command));
  return number;
}

std::optional<Reply> TestWorld::take_reply(uint64_t session, uint32_t request) {
  const auto at = replies_.find({session, request});
  if (at == replies_.end()) return std::nullopt;
  Reply reply = std::move(at->second);
  replies_.erase(at);
  return reply;
}

void TestWorld::walk(uint64_t session, const WalkRequest& input) {
  waiting_.push_back({.session = session,
                      .request = ++persons_.at(session).inputs,
                      .body = input,
                      .asker = asker_of(session)});
}

void TestWorld::say(uint64_t session, const std::string& text) {
  const SaidMessage line{session, persons_.at(session).who.name, text};
  if (!rules_->hear_line(line)) return;
  for (auto& [number, person] : persons_)
    if (person.here) person.lines.push_back(text);
}

void TestWorld::send(uint64_t session, ChannelData data) {
  rules_->hear(session, data);
}

Result<void> TestWorld::restart() {
  faults_before_ += rules_->faults();
  rules_.reset();
  const WorldSnapshot saved = world_->snapshot();
  world_ = TRY(World::restore(saved));
  waiting_.clear();
  kicked_.clear();
  replies_.clear();
  for (auto& [session, person] : persons_) {
    if (person.here) waiting_.push_back({session, 0, LeaveRequest{}});
    person.here = false;
  }
  present_.clear();
  return load_rules();
}

Result<void> TestWorld::reload() {
  const uint64_t faults = rules_->faults();
  TRY(rules_->reload());
  faults_before_ += faults;
  step();
  return {};
}

std::string TestWorld::run(const std::string& rules, const std::string& line) {
  const uint32_t request = ++next_control_;
  rules_->control(0, request, {RulesControl::console, rules, line});
  step();
  return answers_[request];
}

std::vector<Sign> TestWorld::signs_of(uint64_t session) const {
  std::vector<Sign> signs;
  const std::string team = team_of(session);
  for (const Sign& sign : *world_->game().signs)
    if (is_meant(sign.to, session, team)) signs.push_back(sign);
  return signs;
}

MassUnits TestWorld::ledger_error() {
  return std::max(std::abs(ledger_.error()), std::abs(world_->measure_terrain() - ledger_.terrain));
}

RulesMoment TestWorld::moment() const {
  RulesMoment moment;
  moment.world = world_.get();
  moment.persons = &present_;
  return moment;
}

}  // namespace scree
