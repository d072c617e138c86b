#include "server/net/administration.h"

#include <algorithm>
#include <fmt/format.h>
#include <variant>

#include "auth/access_token.h"
#include "proto/limits.h"
#include "proto/spawn_direction.h"
#include "server/doors/unix_time.h"
#include "server/log/log.h"
#include "server/net/party_rows.h"
#include "server/world/settings.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

constexpr uint64_t seconds_per_minute = 60;
constexpr uint64_t ms_per_second = 1000;

bool is_for_directors(const AdminRequest& act) {
  return std::holds_alternative<ListBodiesRequest>(act) || std::holds_alternative<ListJointsRequest>(act) ||
         std::holds_alternative<ListStoresRequest>(act) ||
         std::holds_alternative<ListRegionMassesRequest>(act);
}

/// Not a look at what would be, or at how far it is.
bool changes_world(const UndoRequest& undo) {
  return undo.mode != UndoMode::preview && undo.mode != UndoMode::progress;
}

std::string words_of(const UndoRequest& undo) {
  if (undo.mode == UndoMode::stop) return "stops the undo";
  std::string words = undo.by.empty() ? "takes back edits" : "takes back edits of " + undo.by;
  if (undo.since_s != 0) words += fmt::format(" of the last {} s", undo.since_s);
  if (undo.to_tick != 0) words += fmt::format(", to tick {}", undo.to_tick);
  if (undo.lo_m && undo.hi_m)
    words += fmt::format(" in the box {:g},{:g},{:g} to {:g},{:g},{:g}", undo.lo_m->x, undo.lo_m->y,
                         undo.lo_m->z, undo.hi_m->x, undo.hi_m->y, undo.hi_m->z);
  if (undo.mode == UndoMode::keep_others) words += ", keeping what others edited since";
  if (undo.mode == UndoMode::over_others) words += ", over what others edited since";
  return words;
}

/// Which undo it is, and what it takes back: the first line of the answer in words, the number of that in
/// JSON.
std::string result_in(const std::string& answer) {
  if (!answer.starts_with('{')) return ": " + answer.substr(0, answer.find('\n'));
  constexpr std::string_view key = "\"undo\":";
  const size_t at = answer.find(key);
  if (at == std::string::npos) return {};
  const size_t from = at + key.size();
  return ": undo " + answer.substr(from, answer.find_first_not_of("0123456789", from) - from);
}

std::string name_in_brackets(const SessionEntry* entry) {
  return entry == nullptr || entry->name.empty() ? std::string() : " (" + entry->name + ")";
}

}  // namespace

tl::expected<void, Refused> Administration::administer(ClientSession& session, const AdminMessage& message) {
  const SessionEntry& entry = sessions_.at(session.id());
  if (is_for_directors(message.act)) {
    const auto may = check_role(entry.grant.role, Role::director);
    if (may) {
      act(session, message);
      return {};
    }
    if (message.token.empty()) {
      ++counts_.requests;
      requests_.refuse(session, message.request, may.error());
      return {};
    }
  }
  const bool is_control = std::holds_alternative<ControlReplayRequest>(message.act);
  if (auto admin = authorizer_.may_administer(entry.grant.role, entry.caller(), is_control); !admin) {
    const bool nobody_can = admin.error().reason == Refusal::no_admin_token;
    if (nobody_can || message.token.empty() || !authorizer_.has_admin_token()) {
      ++counts_.requests;
      requests_.refuse(session, message.request, admin.error());
      return {};
    }
    TRY(authorizer_.check_admin_token(session.address(), message.token, steady_now_s()));
  }
  if (const auto* settings = std::get_if<SettingsRequest>(&message.act))
    set(session, message.request, *settings);
  else
    act(session, message);
  return {};
}

void Administration::set(ClientSession& session, uint32_t request, SettingsRequest asked) {
  // The act of a later release reads as none at all, and must not count as done.
  if (asked.settings.empty()) {
    ++counts_.requests;
    return requests_.refuse(
        session, request,
        {Refusal::value_unknown, "an administrator's request that this server does not know"});
  }
  if (const Result<void> found = find_here(session, asked); !found) {
    ++counts_.requests;
    return requests_.refuse(session, request, {Refusal::settings_invalid, found.error().message});
  }
  std::string changes;
  for (const SettingValue& setting : asked.settings) changes += " " + setting.name + "=" + setting.value;
  if (requests_.pass(session, {session.id(), request, asked})) note_later(session, request, "sets" + changes);
}

Result<void> Administration::find_here(const ClientSession& session, SettingsRequest& asked) const {
  for (SettingValue& setting : asked.settings) {
    if (setting.name != spawn_setting || !setting.value.starts_with(spawn_here)) continue;
    const std::string number = setting.value.substr(std::min(setting.value.size(), spawn_here.size() + 1));
    const PlayerCursor& person = *TRY(person_at(session, number));
    setting.value = text_of(spawn_looking_at(person.eye_m, person.aim_m));
  }
  return {};
}

Result<const PlayerCursor*> Administration::person_at(const ClientSession& session,
                                                      const std::string& number) const {
  const auto& cursors = publisher_.cursors();
  std::vector<const PlayerCursor*> here;
  for (const auto& [id, cursor] : cursors) {
    const SessionEntry* const entry = sessions_.find(id);
    const bool meant = number.empty() ? entry != nullptr && entry->session->ip() == session.ip()
                                      : number == std::to_string(id);
    if (meant) here.push_back(&cursor.cursor);
  }
  if (here.size() == 1) return here.front();
  const std::string way_out = ": say whose eye it is (spawn here SESSION; scree admin sessions lists them)";
  if (!number.empty()) return fail("session " + number + " has no eye, or is not there" + way_out);
  return fail(here.empty() ? "nobody is here from this address" + way_out
                           : std::to_string(here.size()) + " persons are here from this address" + way_out);
}

void Administration::note(const std::string& author, const std::string& act, uint64_t about) const {
  log_of(LogPart::admin, about).info("{} {}", author, act);
  if (records_.acted) records_.acted(author, act);
}

void Administration::note_asked(const ClientSession& session, uint32_t request, const Request& body) {
  if (const auto* set = std::get_if<SetRegionRequest>(&body))
    note_later(session, request, "sets the region " + set->region.name);
  if (const auto* gone = std::get_if<RemoveRegionRequest>(&body))
    note_later(session, request, "removes the region " + gone->name);
}

void Administration::note_later(const ClientSession& session, uint32_t request, std::string act) {
  asked_[{session.id(), request}] = {author_of(session), std::move(act)};
}

void Administration::note_done(const TickDelta& delta) {
  if (asked_.empty()) return;
  for (const Reply& reply : delta.replies) {
    const auto asked = asked_.extract({reply.session, reply.request});
    if (!asked.empty() && reply.refusal.empty())
      note(asked.mapped().author, asked.mapped().act, reply.session);
  }
}

void Administration::note_answered(uint64_t session, const ServerMessage& answer) {
  if (const auto* const refused = std::get_if<ReplyMessage>(&answer))
    asked_.erase({session, refused->request});
  const auto* const list = std::get_if<AdminListMessage>(&answer);
  if (list == nullptr) return;
  const auto asked = asked_.extract({session, list->request});
  if (!asked.empty()) note(asked.mapped().author, asked.mapped().act + result_in(list->text), session);
}

void Administration::act(ClientSession& session, const AdminMessage& message) {
  ++counts_.requests;
  if (!sessions_.at(session.id()).requests.try_spend(steady_now_s()))
    return requests_.refuse(session, message.request,
                            {Refusal::requests_per_second, "too many requests: ask again more slowly"});
  const auto list = [&](AdminListMessage rows) {
    rows.request = message.request;
    session.send(ServerMessage(std::move(rows)));
  };
  const auto history = [&](const HistoryAct& asked) {
    const auto* const undo = std::get_if<UndoRequest>(&asked);
    if (undo != nullptr && undo->show_session != 0 && sessions_.find(undo->show_session) == nullptr)
      return requests_.refuse(
          session, message.request,
          {Refusal::admin_invalid, fmt::format("there is no session {}", undo->show_session)});
    if (ask_history_ && undo != nullptr && changes_world(*undo))
      note_later(session, message.request, words_of(*undo));
    if (ask_history_) return ask_history_(session.id(), message.request, asked, author_of(session));
    requests_.refuse(session, message.request,
                     {Refusal::admin_invalid, "this server remembers no edits (--history-mb)"});
  };
  const auto reply = [&](const Result<void>& done) {
    if (!done)
      return requests_.refuse(session, message.request, {Refusal::admin_invalid, done.error().message});
    session.send(ServerMessage(ReplyMessage{message.request, "", 0}));
  };
  std::visit(
      Overloaded{[](const SettingsRequest&) {},  // set() hands them to the world
                 [&](const ListSessionsRequest&) { list({.sessions = sessions_.rows(steady_now_s())}); },
                 [&](const ListBansRequest&) { list({.bans = ban_rows()}); },
                 [&](const ListBodiesRequest& bodies) { list(publisher_.list(bodies)); },
                 [&](const ListJointsRequest& joints) { list(publisher_.list(joints)); },
                 [&](const ListStoresRequest& stores) { list(publisher_.list(stores)); },
                 [&](const ListRegionMassesRequest& masses) { list(publisher_.list(masses)); },
                 [&](const HistoryRequest& asked) { history(asked); },
                 [&](const UndoRequest& asked) { history(asked); },
                 [&](const ListFlightRequest& flight) { list(this->flight(flight)); },
                 [&](const ListLinesRequest& lines) { list(this->lines(lines)); },
                 [&](const KickRequest& kick) { reply(this->kick(kick, author_of(session))); },
                 [&](const BanRequest& ban) { reply(this->ban(ban, author_of(session))); },
                 [&](const LiftBanRequest& lift) { reply(this->lift(lift, author_of(session))); },
                 [&](const ControlRulesRequest& rules) {
                   if (!control_rules_) return reply(fail("this server runs no rules (--rules)"));
                   if (rules.control != RulesControl::list)
                     note(author_of(session),
                          rules.control == RulesControl::reload ? "reads the rules again"
                                                                : "runs a line of rules: " + rules.line,
                          session.id());
                   control_rules_(session.id(), message.request, rules);
                 },
                 [&](const ControlReplayRequest& control) {
                   reply(control_ ? control_(control) : fail("this server plays no recording (--replay)"));
                 }},
      message.act);
}

AdminListMessage Administration::flight(const ListFlightRequest& request) const {
  AdminListMessage message;
  if (request.list == FlightList::parties)
    message.parties = with_sessions(flight_.parties ? flight_.parties() : std::vector<PartyRow>(), sessions_);
  else if (flight_.ticks)
    message.slow_ticks = flight_.ticks(request);
  return message;
}

/// The newest, as many as were asked for and as the text holds.
AdminListMessage Administration::lines(const ListLinesRequest& request) const {
  AdminListMessage message;
  if (!records_.lines) return message;
  const std::vector<std::string> all = records_.lines(request.of);
  size_t first = all.size();
  for (size_t bytes = 0; first > 0 && (request.most == 0 || all.size() - first < request.most); --first) {
    bytes += all[first - 1].size() + 1;
    if (bytes > limits::admin_text_bytes_max) break;
  }
  for (; first < all.size(); ++first) message.text += all[first] + "\n";
  return message;
}

std::vector<BanRow> Administration::ban_rows() const {
  std::vector<BanRow> rows;
  const uint64_t now_s = unix_now_s();
  for (const auto& [key, ban] : authorizer_.bans().all())
    if (ban.until_s == 0 || ban.until_s > now_s)
      rows.push_back({key, ban.until_s == 0 ? 0 : ban.until_s - now_s, ban.reason});
  return rows;
}

std::string Administration::author_of(const ClientSession& session) const {
  const SessionEntry& entry = sessions_.at(session.id());
  const std::string token =
      entry.grant.token_id == 0 ? std::string() : ", token " + id_text(entry.grant.token_id);
  return fmt::format("session {} ({}{}) from {}", session.id(), entry.name.empty() ? "no name" : entry.name,
                     token, session.peer());
}

Result<void> Administration::kick(const KickRequest& kick, const std::string& author) {
  const SessionEntry* const entry = sessions_.find(kick.session);
  const bool is_away = entry == nullptr && tickets_.departed(kick.session) != nullptr;
  if (entry == nullptr && !is_away) return fail(fmt::format("there is no session {}", kick.session));
  note(author,
       with_reason(fmt::format("kicks session {}{}{}", kick.session, name_in_brackets(entry),
                               is_away ? ", while its connection is lost" : ""),
                   kick.reason),
       kick.session);
  if (is_away) {
    tickets_.forget(kick.session);
    return {};
  }
  const auto session = entry->session;
  session->refuse({Refusal::kicked, with_reason("an administrator ended this session", kick.reason)});
  return {};
}

Result<std::string> Administration::ip_of(uint64_t session) const {
  if (const Departed* const departed = tickets_.departed(session)) return departed->ip;
  if (const SessionEntry* const entry = sessions_.find(session)) return entry->session->ip();
  return fail(fmt::format("there is no session {}", session));
}

/// The ban holds even when it cannot be written.
Result<void> Administration::ban(const BanRequest& ban, const std::string& author) {
  const std::string target = ban.session != 0 ? TRY(ip_of(ban.session)) : ban.address;
  const std::string key = TRY(ban_key(target));
  const uint64_t now_s = unix_now_s();
  const uint64_t until_s = ban.minutes == 0 ? 0 : now_s + ban.minutes * seconds_per_minute;
  Result<void> added = authorizer_.bans().add(key, {until_s, ban.reason}, now_s);
  const std::string whom = ban.session == 0 ? std::string()
                                            : fmt::format(" of session {}{}", ban.session,
                                                          name_in_brackets(sessions_.find(ban.session)));
  const std::string until =
      until_s == 0 ? "until that is lifted" : "until " + iso_time(until_s * ms_per_second);
  note(author, with_reason(fmt::format("bans {}{} {}", key, whom, until), ban.reason), ban.session);
  end_banned();
  return added;
}

void Administration::end_banned() {
  const uint64_t now_s = unix_now_s();
  const Bans& bans = authorizer_.bans();
  tickets_.forget_departed([&](const Departed& away) {
    return bans.find({away.ip, away.grant.name, away.grant.token_id}, now_s).has_value();
  });
  std::vector<std::pair<std::shared_ptr<ClientSession>, std::string>> there;
  for (const auto& [id, entry] : sessions_.entries()) {
    if (entry.grant.role == Role::admin) continue;
    for (const std::string& name : {entry.grant.name, entry.name})  // by a number it is the other's name, too
      if (const auto found = bans.find({entry.session->ip(), name, entry.grant.token_id}, now_s)) {
        there.emplace_back(entry.session, words_of(*found));
        break;
      }
  }
  for (const auto& [session, words] : there) session->refuse({Refusal::banned, words});
}

void Administration::read_bans_again() {
  if (const auto read = authorizer_.bans().read_again(); !read)
    log_of(LogPart::admin).warn("not all bans were read again: {}", read.error().message);
  end_banned();
}

Result<void> Administration::lift(const LiftBanRequest& lift, const std::string& author) {
  const std::string key = TRY(ban_key(lift.address));
  Result<void> lifted = authorizer_.bans().lift(key);
  if (lifted) note(author, "lifts the ban of " + key);
  return lifted;
}

}  // namespace scree
