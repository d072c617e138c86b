// NetHost's part of who may come in and do what, and of the administrators' requests.
#include <cmath>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "server/doors/unix_time.h"
#include "server/net/net_host.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"
#include "shared/base/token.h"

namespace scree {

namespace {

constexpr uint64_t seconds_per_minute = 60;

std::string with_reason(const std::string& what, const std::string& reason) {
  return reason.empty() ? what : what + ": " + reason;
}

void tell(const Access& access) {
  if (!access.tls()) return;
  spdlog::info("TLS: the certificate's SHA-256 fingerprint is {}", access.tls()->fingerprint());
  if (access.tls()->out_of_date())
    spdlog::warn("TLS: the certificate has expired, or is not valid yet: clients refuse it");
}

}  // namespace

Result<void> NetHost::open_access() {
  auto access = Access::load(config_.access, config_.admin_token);
  TRY(access);
  auto bans = TRY(Bans::open(config_.access.bans_path));
  access_ = std::move(*access);
  bans_ = std::move(bans);
  tell(*access_);
  for (const std::string& open : open_doors(config_.access, config_.bind)) spdlog::warn("open: {}", open);
  return {};
}

void NetHost::take_access(std::shared_ptr<const Access> access) {
  CHECK(network_thread_.is_the_same());
  access_ = std::move(access);
  tell(*access_);
  end_lapsed_grants();
}

/// A wrong token ends the connection, and costs its address a wait (Door). The right one waits, too: if it
/// were taken at once, any answer would tell who guesses what he wants to know, as fast as he likes.
tl::expected<void, Refused> NetHost::check_admin_token(const std::string& address, const std::string& token) {
  Door& door = entrance_.door();
  const double now_s = steady_now_s();
  if (door.knows_as_wrong(address, token))
    return refuse(Refusal::admin_token_wrong, "the admin token is wrong, as it was before");
  if (const double wait_s = door.wait_for_guess_s(address, now_s); wait_s > 0.0)
    return refuse(Refusal::token_guesses,
                  fmt::format("wrong tokens came from your address: the next is looked at in {:.0f} s",
                              std::ceil(wait_s)));
  if (same_token(token, config_.admin_token)) return {};
  door.guessed_wrong(address, token, now_s);
  return refuse(Refusal::admin_token_wrong, "the admin token is wrong");
}

tl::expected<Grant, Refused> NetHost::grant_to(const ClientSession& session, const HelloMessage& hello) {
  if (config_.access.tls_required && !session.encrypted())
    return refuse(Refusal::tls_required, "this server is reached by TLS alone (--tls)");
  const bool guesses = !hello.token.empty() && !config_.admin_token.empty() && !is_access_token(hello.token);
  if (guesses) TRY(check_admin_token(session.address(), hello.token));
  const uint64_t now_s = unix_now_s();
  auto grant = access_->grant(hello.token, now_s);
  if (!grant) return grant;
  if (grant->name.empty()) grant->name = hello.name;
  const Ban* ban = bans_.find(session.ip(), now_s);
  // An administrator could not lift the ban of his own address.
  if (ban != nullptr && grant->role != Role::admin)
    return refuse(Refusal::banned, with_reason("this address is banned from the server", ban->reason));
  return grant;
}

/// Who has no token shares with its address. Programs on this machine, and administrators, share with nobody.
/// `before`: the party that the session had, if it goes on.
uint64_t NetHost::join_party(const ClientSession& session, const Grant& grant, uint64_t before) {
  const double now_s = steady_now_s();
  if (grant.token_id != 0)
    return parties_.join("token " + std::to_string(grant.token_id), session.id(), now_s);
  if (grant.role == Role::admin) return 0;
  if (entrance_.door().is_free(session.address())) return parties_.join_apart(session.id(), before, now_s);
  return parties_.join(session.address(), session.id(), now_s);
}

/// Tokens expire and are revoked while their sessions last.
void NetHost::end_lapsed_grants() {
  const uint64_t now_s = unix_now_s();
  std::vector<std::pair<std::shared_ptr<ClientSession>, Refused>> lapsed;
  for (const auto& [id, entry] : sessions_)
    if (auto holds = access_->still_holds(entry.grant, now_s); !holds)
      lapsed.emplace_back(entry.session, holds.error());
  for (const auto& [session, refused] : lapsed) session->refuse(refused);
}

tl::expected<void, Refused> NetHost::may(const ClientSession& session, Role needed) const {
  const Role role = sessions_.at(session.id()).grant.role;
  if (may_act_as(role, needed)) return {};
  return refuse(Refusal::role, "that takes the role " + std::string(name_of(needed)) +
                                   ": this session is a " + std::string(name_of(role)) +
                                   " (ask for a token, --token)");
}

/// Where nobody could be an administrator, a replay is this machine's own programs' to control.
tl::expected<void, Refused> NetHost::may_administer(const ClientSession& session, bool is_control) {
  const auto admin = may(session, Role::admin);
  const bool nobody_can = config_.admin_token.empty() && !access_->takes_tokens();
  if (admin || !nobody_can) return admin;
  const bool from_here = entrance_.door().is_free(session.address()) && !sessions_.at(session.id()).relayed;
  if (is_control && from_here) return {};
  const std::string what =
      is_control ? "it is controlled from its own machine alone" : "nobody may administer it";
  return refuse(Refusal::no_admin_token, "this server was started without an admin token: " + what +
                                             " (--admin-token-file, --token-key)");
}

/// Requests beyond the session's role never reach the world.
void NetHost::ask(ClientSession& session, const Command& command) {
  const auto may_ask = may(session, role_for(command.body));
  if (may_ask) {
    request(session, command);
    return;
  }
  ++counts_.requests;
  refuse_request(session, command.request, may_ask.error());
}

void NetHost::administer_sessions(ClientSession& session, const AdminMessage& message) {
  ++counts_.requests;
  if (!sessions_.at(session.id()).requests.take(steady_now_s()))
    return refuse_request(session, message.request,
                          {Refusal::requests_per_second, "too many requests: ask again more slowly"});
  const auto list = [&](AdminListMessage rows) {
    rows.request = message.request;
    session.send(ServerMessage(std::move(rows)));
  };
  const auto reply = [&](const Result<void>& done) {
    if (!done)
      return refuse_request(session, message.request, {Refusal::admin_invalid, done.error().message});
    session.send(ServerMessage(ReplyMessage{message.request, "", 0}));
  };
  std::visit(Overloaded{[](const SettingsRequest&) {},  // administer() hands them to the world
                        [&](const ListSessionsRequest&) { list({.sessions = session_rows()}); },
                        [&](const ListBansRequest&) { list({.bans = ban_rows()}); },
                        [&](const KickRequest& kick) { reply(this->kick(kick)); },
                        [&](const BanRequest& ban) { reply(this->ban(ban)); },
                        [&](const LiftBanRequest& lift) { reply(this->lift(lift)); },
                        [&](const ControlReplayRequest& control) {
                          reply(config_.control ? config_.control(control)
                                                : fail("this server plays no recording (--replay)"));
                        }},
             message.act);
}

std::vector<SessionRow> NetHost::session_rows() const {
  std::vector<SessionRow> rows;
  const double now_s = steady_now_s();
  for (const auto& [id, entry] : sessions_) {
    if (entry.session->phase() != ClientSession::Phase::joined) continue;
    rows.push_back({id, entry.name, entry.program, entry.session->ip(), entry.grant.role,
                    entry.grant.token_id, static_cast<uint32_t>(now_s - entry.joined_s),
                    entry.session->sent_bytes(), entry.session->encrypted()});
  }
  return rows;
}

std::vector<BanRow> NetHost::ban_rows() const {
  std::vector<BanRow> rows;
  const uint64_t now_s = unix_now_s();
  for (const auto& [key, ban] : bans_.all())
    if (ban.until_s == 0 || ban.until_s > now_s)
      rows.push_back({key, ban.until_s == 0 ? 0 : ban.until_s - now_s, ban.reason});
  return rows;
}

Result<void> NetHost::kick(const KickRequest& kick) {
  const auto found = sessions_.find(kick.session);
  if (found == sessions_.end() && tickets_.departed(kick.session) != nullptr) {
    tickets_.forget(kick.session);
    spdlog::info("session {}: kicked by an administrator while its connection was lost", kick.session);
    return {};
  }
  if (found == sessions_.end()) return fail("there is no session " + std::to_string(kick.session));
  const auto session = found->second.session;
  spdlog::info("session {}: kicked by an administrator", kick.session);
  session->refuse({Refusal::kicked, with_reason("an administrator ended this session", kick.reason)});
  return {};
}

/// Ends the sessions that are there, administrators' excepted; the ban holds even when it cannot be written.
Result<void> NetHost::ban(const BanRequest& ban) {
  std::string address = ban.address;
  if (ban.session != 0) {
    const auto found = sessions_.find(ban.session);
    const Departed* const departed = tickets_.departed(ban.session);
    if (found == sessions_.end() && departed == nullptr)
      return fail("there is no session " + std::to_string(ban.session));
    address = departed != nullptr ? departed->ip : found->second.session->ip();
  }
  const auto key = TRY(ban_key(address));
  const uint64_t now_s = unix_now_s();
  const uint64_t until_s = ban.minutes == 0 ? 0 : now_s + ban.minutes * seconds_per_minute;
  Result<void> added = bans_.add(key, {until_s, ban.reason}, now_s);
  spdlog::info("{} is banned by an administrator", key);
  tickets_.forget_departed(
      [&](const Departed& departed) { return bans_.find(departed.ip, now_s) != nullptr; });
  std::vector<std::shared_ptr<ClientSession>> there;
  for (const auto& [id, entry] : sessions_)
    if (entry.grant.role != Role::admin && bans_.find(entry.session->ip(), now_s) != nullptr)
      there.push_back(entry.session);
  for (const auto& session : there)
    session->refuse({Refusal::banned, with_reason("this address is banned from the server", ban.reason)});
  return added;
}

Result<void> NetHost::lift(const LiftBanRequest& lift) {
  const auto key = TRY(ban_key(lift.address));
  return bans_.lift(key);
}

}  // namespace scree
