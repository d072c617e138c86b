#include "server/net/net_host.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <utility>

#include "crypto/signing_key.h"
#include "proto/codec.h"
#include "server/doors/unix_time.h"
#include "server/log/log.h"
#include "server/net/may_wait.h"
#include "server/net/person_eyes.h"
#include "server/net/person_names.h"
#include "server/net/queries.h"
#include "server/net/talk_delivery.h"
#include "server/net/welcome.h"
#include "server/web/web_names.h"
#include "server/world/world.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

/// Period of the check for silent sessions; the shorter one while stopping.
constexpr std::chrono::milliseconds timer_period{100};
constexpr std::chrono::milliseconds timer_period_stopping{5};
/// Given to clients to read the goodbye.
constexpr double stop_seconds_max = 0.5;

PublisherConfig publisher_config(const NetConfig& config) {
  return {config.terrain,
          std::max(1U, config.tick_rate_hz),
          std::max(1U, config.ticks_per_transform),
          config.heartbeat_s,
          config.chunks,
          config.palette,
          config.images,
          config.models};
}

/// Where strangers come by a proxy or under a name, a connection from loopback may be anybody's: then it has
/// no more rights than another.
Door::Rules door_rules(const NetConfig& config) {
  Door::Rules rules = config.door;
  const bool is_public = !config.proxies.empty() || !config.web.hosts.empty() || !config.web.origins.empty();
  rules.loopback_is_shared = rules.loopback_is_shared || is_public;
  return rules;
}

}  // namespace

NetHost::NetHost(const NetConfig& config, CommandQueue& commands)
    : config_(config),
      service_(config.service),
      world_(config.world != 0 ? config.world : std::max<uint64_t>(1, random_number())),
      door_(door_rules(config_)),
      bytes_out_(config_.bytes_out, door_),
      authorizer_(config_.access, config_.admin_token, door_),
      sessions_(service_.requests_per_second),
      requests_(commands, sessions_, figures_.counts(), config_),
      returns_([this](uint64_t session) { requests_.gone(session); }, door_),
      administration_(sessions_, requests_, authorizer_, returns_.tickets(), figures_.counts(),
                      config_.control, config_.control_rules, config_.ask_history, publisher_),
      web_(config_, authorizer_, door_, bytes_out_, figures_.counts(), log_, *this),
      arrivals_(context_,
                {config_, door_, authorizer_, sessions_, room_, web_, *this, figures_.counts(), log_},
                [this] { update_stats(); }),
      talk_(config_.chat),
      workers_(config_.net_threads),
      publisher_(publisher_config(config_), workers_),
      flush_queue_(context_, workers_, config_.tick_rate_hz),
      timer_(context_) {
  administration_.set_reports(config_.flight, config_.records);
}

Result<void> NetHost::listen() {
  TRY(authorizer_.open());
  log_access(authorizer_.access());
  if (const std::string& fault = authorizer_.bans().fault(); !fault.empty())
    log_of(LogPart::admin).warn("not all lines of the file of bans hold: {}", fault);
  for (const std::string& open : open_doors(config_.access, config_.bind))
    log_of(LogPart::admin).warn("open: {}", open);
  TRY(web_.open());
  TRY(arrivals_.listen());
  if (web_.speaks_http() && config_.web.hosts.empty() && !is_loopback_address(config_.bind))
    log_of(LogPart::net)
        .info(
            "browsers reach this server by its addresses in numbers, localhost or {}: any other name needs "
            "--web-host NAME "
            "(SCREE_WEB_HOST)",
            own_host_name());
  room_.fit(service_.sessions_max);
  tick_timer();
  return {};
}

void NetHost::run() {
  CHECK(network_thread_.is_the_same());
  context_.run();
}

// ---- sessions

tl::expected<WelcomeMessage, Refused> NetHost::admit(ClientSession& session, const HelloMessage& said) {
  const HelloMessage hello = TRY(placed(said, publisher_.state().spawn()));
  if (stopping_) return refuse(Refusal::server_stops, "the server stops");
  const double now_s = steady_now_s();
  const Grant grant = TRY(authorizer_.grant_to(sessions_.at(session.id()).caller(), hello.token,
                                               visible_name(hello.name), now_s, unix_now_s()));
  const auto radius_m = granted_radius(hello.eye_m, hello.administers ? 0.0F : hello.interest_radius_m);
  if (!radius_m) return refuse(Refusal::interest_invalid, radius_m.error().message);
  const std::optional<Departed> before = returns_.resume(hello.ticket, grant, sessions_, now_s);
  if (hello.administers || grant.role == Role::admin)
    TRY(Room::find_room_beside(sessions_, sessions_.at(session.id()), grant));
  else
    TRY(find_room(session, grant, before, now_s));
  join(session, hello, *radius_m, grant, before);
  WelcomeMessage welcome = welcome_of(config_, world_, publisher_);
  welcome.session = session.id();
  welcome.tick = publisher_.state().tick();
  welcome.interest_radius_m = *radius_m;
  welcome.role = grant.role;
  welcome.ticket = returns_.tickets().issue(session.id());
  welcome.resumed = before.has_value();
  return welcome;
}

/// Places of lost connections are kept from newcomers without a token.
tl::expected<void, Refused> NetHost::find_room(const ClientSession& newcomer, const Grant& grant,
                                               const std::optional<Departed>& before, double now_s) {
  const bool comes_first = (before && has_place(*before, now_s)) || holds_token(grant);
  const size_t reserved = comes_first ? 0 : returns_.tickets().reserved_places(now_s);
  return room_.find_place(sessions_, newcomer, grant, reserved, now_s);
}

void NetHost::join(ClientSession& session, const HelloMessage& hello, float radius_m, const Grant& grant,
                   const std::optional<Departed>& before) {
  const double now_s = steady_now_s();
  SessionEntry& entry = sessions_.join(session, before ? before->session : session.id(), hello.eye_m);
  entry.grant = grant;
  entry.administers = hello.administers;
  entry.party = returns_.join_party(session, grant, before ? before->party : 0, now_s);
  publisher_.join(session.id(), hello.eye_m, radius_m, hello.lacks_kernels ? 0 : hello.operations,
                  hello.world == world_, entry.party);
  publisher_.set_store(session.id(), store_of_person(grant.token_id, session.id()));
  publisher_.set_team(session.id(), grant.team, hello.meets);
  publisher_.want_stones(session.id(), hello.stones);
  bytes_out_.open(entry.receiver(), now_s);
  name_person(sessions_, session.id(), talk_);
  entry.program = hello.client;
  entry.joined_s = before ? before->joined_s : now_s;
  if (before) entry.requests = before->requests;
  if (config_.control)
    if (const auto control = authorizer_.may_administer(grant.role, entry.caller(), true); !control)
      publisher_.set_control_refusal(session.id(), control.error().message);
  if (hello.meets && !hello.administers)
    talk_.join(session.id(), entry.party != 0 ? entry.party : session.id(), entry.name, grant.role);
  note(EventKind::join, entry, hello.eye_m);
  if (config_.joined)
    config_.joined({session.id(), entry.name, grant.role, grant.team, grant.token_id,
                    hello.meets && !hello.administers, before.has_value(), hello.administers, session.ip()});
  if (config_.way_back) config_.way_back->joined(session.id(), hello);
  ++figures_.counts().sessions_joined;
  figures_.counts().sessions_resumed += before ? 1 : 0;
  update_stats();
  log_.say(log_of(LogPart::net, session.id()), LogLevel::info, "joined",
           fmt::format("session {}: {} {} from {} as {}, interest {} m", session.id(), hello.client,
                       before ? "goes on" : "joined", session.peer(), name_of(grant.role), radius_m));
}

tl::expected<void, Refused> NetHost::carry_out(ClientSession& session, const ClientMessage& message) {
  using Done = tl::expected<void, Refused>;
  return std::visit(
      Overloaded{
          [](const HelloMessage&) -> Done {
            return refuse(Refusal::hello_repeated, "a second hello: this connection has joined already");
          },
          [&](const InterestMessage& interest) { return follow(session, interest); },
          [&]<typename Asks>(const RequestMessage<Asks>& asked) -> Done {
            return ask(session, asked.request, static_cast<const Asks&>(asked));
          },
          [&](const RepairMessage& repair) -> Done {
            log_.say(log_of(LogPart::net, session.id()), LogLevel::warn, "repair",
                     fmt::format("session {}: {} chunks differ at tick {}", session.id(),
                                 repair.chunks.size(), repair.tick));
            publisher_.repair(session.id(), repair);
            return {};
          },
          [&](const OfferMessage& offer) -> Done {
            if (offer.world == world_) publisher_.offer(session.id(), offer);
            return {};
          },
          [&](const GoodbyeMessage&) -> Done {
            session.leave();
            return {};
          },
          // On TCP the bytes that wait for a client say how far behind it is.
          [](const AckMessage&) -> Done { return {}; },
          [](const AskHealthMessage&) -> Done {
            return refuse(Refusal::hello_repeated, "health is asked for by a connection of its own");
          },
          [&](const AdminMessage& admin) { return administration_.administer(session, admin); },
          [&](const UnknownMessage& unknown) { return skip(session, unknown); },
          [&](const CursorMessage& cursor) -> Done {
            SessionEntry& entry = sessions_.at(session.id());
            entry.eye_m = believed_eye_m(publisher_.state(), session.id(), cursor.eye_m);
            publisher_.set_cursor({session.id(), entry.name, entry.eye_m, cursor.aim_m}, entry.party);
            return {};
          },
          [&](const SayMessage& said) -> Done {
            pass_on(said, session, talk_, sessions_, steady_now_s(), {config_.said, config_.log_chat});
            return {};
          },
          [&](const PhysicsSubscriptionMessage& subscription) -> Done {
            publisher_.subscribe_physics(session.id(), subscription.physics);
            publisher_.subscribe_contacts(session.id(), subscription.contacts_j);
            return {};
          },
          [&](const AskGroundMessage& ground) -> Done {
            return may_wait(publisher_.ask_ground(session.id(), ground), limits::ground_chunks_max,
                            "chunks of ground", "ground_chunks_max");
          },
          [&](const AskTilesMessage& tiles) -> Done {
            return may_wait(publisher_.ask_tiles(session.id(), tiles), limits::tiles_wanted_max,
                            "tiles of the ground", "tiles_wanted_max");
          },
          [&](const AskContentMessage& content) -> Done {
            return may_wait(publisher_.ask_content(session.id(), content), limits::contents_wanted_max,
                            "palettes, images and models", "contents_wanted_max");
          },
          [&](const ChannelMessage& channel) -> Done {
            return config_.heard ? config_.heard(session.id(), channel), Done() : Done();
          },
          [&](const QueryMessage& query) -> Done {
            pass_query(query, session, sessions_, publisher_, figures_.counts());
            return {};
          },
      },
      message);
}

/// A session that takes no place changes no terrain.
tl::expected<void, Refused> NetHost::ask(ClientSession& session, uint32_t request, const Request& body) {
  SessionEntry& entry = sessions_.at(session.id());
  if (!entry.administers || !shape_of(body)) {
    const auto from = look_from_person(publisher_.state(), service_, session.id(), body, entry);
    if (from || config_.replay) {
      if (requests_.ask(session, request, body)) administration_.note_asked(session, request, body);
    } else {
      ++figures_.counts().requests;
      requests_.refuse(session, request, from.error());
    }
    return {};
  }
  ++figures_.counts().requests;
  requests_.refuse(
      session, request,
      {Refusal::role, "this session administers alone (Hello.administers): it changes no terrain"});
  return {};
}

tl::expected<void, Refused> NetHost::follow(ClientSession& session, const InterestMessage& interest) {
  const bool sees_nothing = sessions_.at(session.id()).administers;
  const auto radius_m = granted_radius(interest.eye_m, sees_nothing ? 0.0F : interest.interest_radius_m);
  if (!radius_m) return refuse(Refusal::interest_invalid, radius_m.error().message);
  const glm::vec3 eye_m = believed_eye_m(publisher_.state(), session.id(), interest.eye_m);
  sessions_.at(session.id()).eye_m = eye_m;
  publisher_.set_interest(session.id(), eye_m, *radius_m);
  return {};
}

void NetHost::refused(ClientSession& session, const Refused& refused) {
  CHECK(!workers_.at_work());
  if (!session.turned_away()) {  // which is counted already
    ++figures_.counts().sessions_refused;
    figures_.counts().refusals.add(refused.reason);
    log_.say(log_of(LogPart::net, session.id()), LogLevel::warn, name_of(refused.reason),
             fmt::format("session {}: {} refused ({}): {}", session.id(), session.peer(),
                         name_of(refused.reason), refused.message));
  }
  forget(session.id());
  returns_.tickets().forget(session.id());
  sessions_.refuse(session.id());
  update_stats();
}

void NetHost::closed(ClientSession& session, const std::string& reason) {
  CHECK(!workers_.at_work());
  if (const std::optional<Refusal> disconnect_reason = session.disconnect_reason()) {
    ++figures_.counts().sessions_disconnected;
    figures_.counts().refusals.add(*disconnect_reason);
    log_.say(log_of(LogPart::net, session.id()), LogLevel::warn, name_of(*disconnect_reason),
             fmt::format("session {}: {} cut off: {}", session.id(), session.peer(), reason));
  } else if (!session.only_asked() && !session.turned_away()) {
    log_.say(log_of(LogPart::net, session.id()), LogLevel::info, "closed",
             fmt::format("session {}: {} closed: {}", session.id(), session.peer(), reason));
  }
  SessionEntry& entry = sessions_.at(session.id());
  if (entry.joined_s > 0.0) {
    note(EventKind::leave, entry);
    if (config_.left) config_.left(session.id());
    const uint64_t sent = std::max(entry.bytes_out.charged, session.queued_bytes());
    bytes_out_.charge(entry.bytes_out, sent - entry.bytes_out.charged);
    bytes_out_.close(entry.receiver());
  }
  if (entry.at_door) door_.leave(session.address(), steady_now_s());
  forget(session.id());
  returns_.closed(entry, steady_now_s());
  sessions_.erase(session.id());
  update_stats();
}

/// The session gets nothing any more, and nobody hears of it.
void NetHost::forget(uint64_t session) {
  publisher_.leave(session);
  talk_.leave(session);
  requests_.forget(session);
  if (config_.way_back) config_.way_back->left(session);
}

// ---- time, and settings that change

void NetHost::tick_timer() {
  timer_.expires_after(stopping_ ? timer_period_stopping : timer_period);
  timer_.async_wait([this](asio::error_code error) {
    if (!error) check_time();
  });
}

void NetHost::check_time() {
  const double now_s = steady_now_s();
  const SessionTable::Sessions sessions = sessions_.all();
  for (const auto& session : sessions) session->check_time(now_s);
  web_.check_time(now_s);
  share_bytes_out();  // where no ticks are published
  if (config_.checked) config_.checked(now_s);
  end_lapsed_grants(sessions_, authorizer_.access());
  returns_.tickets().expire(now_s);
  if (!stopping_) send_persons(talk_, sessions_, now_s);
  requests_.tell_departures();
  if (stopping_ && (sessions_.empty() || now_s > stop_deadline_s_)) {
    for (const auto& session : sessions) session->close("the server stops");
    return;
  }
  tick_timer();
}

/// Settings hold for who is connected, too. A session that has joined stays, however few may now.
void NetHost::grant(const ServiceLimits& service) {
  if (service.sessions_max > service_.sessions_max)
    room_.fit(service.sessions_max);
  else
    room_.bound(service.sessions_max);
  service_ = service;
  requests_.grant(service);
}

void NetHost::shut_down() {
  if (stopping_) return;
  stopping_ = true;
  stop_deadline_s_ = steady_now_s() + stop_seconds_max;
  arrivals_.close();
  for (const auto& session : sessions_.all()) session->refuse({Refusal::server_stops, "the server stops"});
  web_.stop();
  flush_queue_.cancel();
  timer_.cancel();
  tick_timer();
}

// ---- counts

void NetHost::update_stats() {
  NetStats& counts = figures_.counts();
  counts.sessions = static_cast<uint32_t>(sessions_.joined());
  counts.sessions_max = static_cast<uint32_t>(room_.sessions_max());
  counts.tickets_void = returns_.tickets_void();
  counts.bytes_out = bytes_out_.bytes();
  counts.bytes_out_held = bytes_out_.held_back();
  counts.web.connections = static_cast<uint32_t>(web_.size());
  figures_.show(publisher_, config_.takes_cursors && publisher_.state().tick() % ticks_per_physics == 0);
}

}  // namespace scree
