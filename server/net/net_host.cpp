#include "server/net/net_host.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "crypto/signing_key.h"
#include "proto/codec.h"
#include "server/world/world.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"
#include "shared/base/token.h"

namespace scree {

namespace {

/// Period of the check for silent sessions; the shorter one while stopping.
constexpr std::chrono::milliseconds timer_period{100};
constexpr std::chrono::milliseconds timer_period_stopping{5};
/// Given to clients to read the goodbye.
constexpr double stop_seconds_max = 0.5;

PublisherConfig publisher_config(const NetConfig& config) {
  return {config.terrain, std::max(1U, config.tick_rate_hz), std::max(1U, config.ticks_per_transform),
          config.heartbeat_s, config.chunks};
}

}  // namespace

NetHost::NetHost(const NetConfig& config, CommandQueue& commands)
    : config_(config),
      service_(config.service),
      commands_(commands),
      departures_(commands),
      entrance_(context_, config.door, *this),
      timer_(context_),
      next_session_(config.first_session),
      flush_rate_(config.tick_rate_hz),
      flush_timer_(context_),
      tickets_([this](uint64_t session) { departures_.gone(session); }),
      world_(config.world != 0 ? config.world : std::max<uint64_t>(1, random_number())),
      workers_(config.net_threads),
      publisher_(publisher_config(config), workers_),
      talk_(config.chat) {}

Result<void> NetHost::listen() {
  TRY(open_access());
  TRY(open_site());
  TRY(entrance_.listen(config_.bind, config_.port));
  fit_descriptors();
  tick_timer();
  return {};
}

void NetHost::run() {
  CHECK(network_thread_.is_the_same());
  context_.run();
}

void NetHost::say(spdlog::level::level_enum level, std::string_view kind, const std::string& line) {
  if (const auto more = log_.take(kind, steady_now_s())) spdlog::log(level, "{}{}", line, *more);
}

void NetHost::note(Event event) const {
  if (config_.noted) config_.noted(std::move(event));
}

void NetHost::tick_timer() {
  timer_.expires_after(stopping_ ? timer_period_stopping : timer_period);
  timer_.async_wait([this](asio::error_code error) {
    if (error) return;
    const double now_s = steady_now_s();
    std::vector<std::shared_ptr<ClientSession>> sessions;
    for (const auto& [id, entry] : sessions_) sessions.push_back(entry.session);
    for (const auto& session : sessions) session->check_time(now_s);
    check_http(now_s);
    end_lapsed_grants();
    tickets_.expire(now_s);
    if (!stopping_) tell_persons(now_s);
    departures_.tell();
    if (stopping_ && (sessions_.empty() || now_s > stop_deadline_s_)) {
      for (const auto& session : sessions) session->close("the server stops");
      return;
    }
    tick_timer();
  });
}

uint32_t NetHost::joined_count() const {
  CHECK(outsiders_.size() <= sessions_.size());
  return static_cast<uint32_t>(sessions_.size() - outsiders_.size());
}

tl::expected<void, Refused> NetHost::receive(ClientSession& session, const ClientMessage& message) {
  using Done = tl::expected<void, Refused>;
  return std::visit(
      Overloaded{
          [](const HelloMessage&) -> Done {
            return refuse(Refusal::hello_repeated, "a second hello: this connection has joined already");
          },
          [&](const InterestMessage& interest) { return follow(session, interest); },
          [&]<typename Asks>(const RequestMessage<Asks>& asked) -> Done {
            ask(session, {session.id(), asked.request, static_cast<const Asks&>(asked),
                          sessions_.at(session.id()).party});
            return {};
          },
          [&](const RepairMessage& repair) -> Done {
            say(spdlog::level::warn, "repair",
                fmt::format("session {}: {} chunks differ at tick {}", session.id(), repair.chunks.size(),
                            repair.tick));
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
          [&](const AdminMessage& admin) { return administer(session, admin); },
          [&](const UnknownMessage& unknown) -> Done {
            skip(session, unknown);
            return {};
          },
          [&](const CursorMessage& cursor) -> Done {
            publisher_.set_cursor(
                {session.id(), sessions_.at(session.id()).name, cursor.eye_m, cursor.aim_m});
            return {};
          },
          [&](const SayMessage& said) -> Done {
            hear(session, said);
            return {};
          },
          [&](const WatchMessage& watch) -> Done {
            publisher_.watch(session.id(), watch.physics);
            return {};
          },
          [&](const AskGroundMessage& ground) -> Done {
            if (publisher_.ask_ground(session.id(), ground)) return {};
            return refuse(Refusal::ground_waiting,
                          fmt::format("more than {} chunks of ground asked for and not answered "
                                      "(limits.ground_chunks_max)",
                                      limits::ground_chunks_max));
          },
          [&](const AskTilesMessage& tiles) -> Done {
            if (publisher_.ask_tiles(session.id(), tiles)) return {};
            return refuse(Refusal::ground_waiting,
                          fmt::format("more than {} tiles of the ground asked for and not answered "
                                      "(limits.tiles_wanted_max)",
                                      limits::tiles_wanted_max));
          },
      },
      message);
}

/// The client is of a later release, or made by somebody else.
void NetHost::skip(ClientSession& session, const UnknownMessage& unknown) {
  ++counts_.messages_unknown;
  if (unknown.request) {
    ++counts_.requests;
    return refuse_request(
        session, *unknown.request,
        {Refusal::value_unknown,
         fmt::format("this server does not know {}: it is of another release", unknown.value)});
  }
  say(spdlog::level::info, "message_unknown",
      fmt::format("session {}: a message of an unknown kind is skipped", session.id()));
}

Result<float> NetHost::granted_radius(glm::vec3 eye_m, float radius_m) {
  if (!std::isfinite(eye_m.x) || !std::isfinite(eye_m.y) || !std::isfinite(eye_m.z))
    return fail("the eye's position is not a number");
  if (!std::isfinite(radius_m) || radius_m < 0.0F)
    return fail("the radius of interest must be a number, and not negative");
  return std::min(radius_m, limits::interest_radius_max_m);
}

tl::expected<void, Refused> NetHost::follow(ClientSession& session, const InterestMessage& interest) {
  const auto radius_m = granted_radius(interest.eye_m, interest.interest_radius_m);
  if (!radius_m) return refuse(Refusal::interest_invalid, radius_m.error().message);
  publisher_.set_interest(session.id(), interest.eye_m, *radius_m);
  return {};
}

bool NetHost::request(ClientSession& session, const Command& command) {
  ++counts_.requests;
  const auto refused = [&](Refusal reason, const std::string& message) {
    refuse_request(session, command.request, {reason, message});
    return false;
  };
  if (config_.replay)
    return refused(Refusal::replay, "this server plays a recording: nothing in it can be changed");
  const double now_s = steady_now_s();
  if (!sessions_.at(session.id()).requests.take(now_s))
    return refused(Refusal::requests_per_second,
                   fmt::format("more than {} requests a second (requests-per-second); ask again more slowly",
                               service_.requests_per_second));
  if (!commands_.push(command))
    return refused(Refusal::commands_waiting,
                   "the server is busy: " + std::to_string(commands_.commands_max()) +
                       " commands wait already (limits.commands_waiting_max); try again");
  departures_.asked(session.id());
  request_times_.received(session.id(), command.request, now_s);
  return true;
}

void NetHost::refuse_request(ClientSession& session, uint32_t request, const Refused& refused) {
  ++counts_.requests_refused;
  counts_.refusals.add(refused.reason);
  session.send(
      ServerMessage(ReplyMessage{request, refused.message, 0, std::string(name_of(refused.reason))}));
}

/// A wrong token ends the connection, so that each connection has one attempt.
tl::expected<void, Refused> NetHost::administer(ClientSession& session, const AdminMessage& message) {
  const bool is_control = std::holds_alternative<ControlReplayRequest>(message.act);
  if (auto admin = may_administer(session, is_control); !admin) {
    const bool nobody_can = admin.error().reason == Refusal::no_admin_token;
    if (nobody_can || message.token.empty() || config_.admin_token.empty()) {
      ++counts_.requests;
      refuse_request(session, message.request, admin.error());
      return {};
    }
    TRY(check_admin_token(session.address(), message.token));
  }
  const auto* settings = std::get_if<SettingsRequest>(&message.act);
  if (settings == nullptr) {
    administer_sessions(session, message);
    return {};
  }
  // The act of a later release reads as none at all, and must not count as done.
  if (settings->settings.empty()) {
    ++counts_.requests;
    refuse_request(session, message.request,
                   {Refusal::value_unknown, "an administrator's request with no act that this server knows"});
    return {};
  }
  std::string changes;
  for (const SettingValue& setting : settings->settings) changes += " " + setting.name + "=" + setting.value;
  if (request(session, {session.id(), message.request, *settings}))
    settings_asked_[{session.id(), message.request}] =
        fmt::format("session {}: {} sets{}", session.id(), session.peer(), changes);
  return {};
}

void NetHost::refused(ClientSession& session, const Refused& refused) {
  CHECK(!workers_.at_work());
  ++counts_.sessions_refused;
  counts_.refusals.add(refused.reason);
  say(spdlog::level::warn, name_of(refused.reason),
      fmt::format("session {}: {} refused ({}): {}", session.id(), session.peer(), name_of(refused.reason),
                  refused.message));
  publisher_.leave(session.id());
  talk_.leave(session.id());
  request_times_.forget(session.id());
  tickets_.forget(session.id());
  outsiders_.insert(session.id());
  update_stats();
}

void NetHost::closed(ClientSession& session, const std::string& reason) {
  CHECK(!workers_.at_work());
  if (const std::optional<Refusal> cut_for = session.cut_for()) {
    ++counts_.sessions_cut;
    counts_.refusals.add(*cut_for);
    say(spdlog::level::warn, name_of(*cut_for),
        fmt::format("session {}: {} cut off: {}", session.id(), session.peer(), reason));
  } else {
    say(spdlog::level::info, "closed",
        fmt::format("session {}: {} closed: {}", session.id(), session.peer(), reason));
  }
  if (const Entry& entry = sessions_.at(session.id()); entry.joined_s > 0.0)
    note({.kind = EventKind::leave, .session = session.id(), .text = entry.name});
  entrance_.door().leave(session.address(), steady_now_s());
  publisher_.leave(session.id());
  talk_.leave(session.id());
  request_times_.forget(session.id());
  remember(session);
  outsiders_.erase(session.id());
  if (const Entry& entry = sessions_.at(session.id()); entry.party != 0)
    parties_.leave(entry.party, steady_now_s());
  sessions_.erase(session.id());
  update_stats();
}

/// Settings hold for who is connected, too. A session that has joined stays, however few may now.
void NetHost::grant(const ServiceLimits& service) {
  const bool more = service.sessions_max > service_.sessions_max;
  service_ = service;
  if (more) fit_descriptors();
  const double rate = service.requests_per_second;
  for (auto& [id, entry] : sessions_) entry.requests.change(rate, burst_of(rate));
}

void NetHost::shut_down() {
  if (stopping_) return;
  stopping_ = true;
  stop_deadline_s_ = steady_now_s() + stop_seconds_max;
  entrance_.close();
  std::vector<std::shared_ptr<ClientSession>> sessions;
  for (const auto& [id, entry] : sessions_) sessions.push_back(entry.session);
  for (const auto& session : sessions) session->refuse({Refusal::server_stops, "the server stops"});
  const auto http = http_;  // closing one erases its entry
  for (const auto& [id, connection] : http) connection->close();
  flush_timer_.cancel();
  timer_.cancel();
  tick_timer();
}

void NetHost::update_stats() {
  watched_ = publisher_.is_watched();
  counts_.published = publisher_.stats();
  counts_.sessions = joined_count();
  counts_.web.connections = static_cast<uint32_t>(http_.size());
  const std::scoped_lock lock(stats_mutex_);
  stats_ = counts_;
  eyes_m_ = publisher_.eyes_m();
  if (config_.takes_cursors && publisher_.state().tick() % ticks_per_watch == 0)
    cursors_ = publisher_.cursors();
}

std::vector<PlayerCursor> NetHost::cursors() const {
  std::vector<PlayerCursor> cursors;
  const std::scoped_lock lock(stats_mutex_);
  for (const auto& [session, cursor] : cursors_) cursors.push_back(cursor);
  return cursors;
}

std::vector<glm::vec3> NetHost::eyes_m() const {
  const std::scoped_lock lock(stats_mutex_);
  return eyes_m_;
}

NetStats NetHost::stats() const {
  const std::scoped_lock lock(stats_mutex_);
  return stats_;
}

}  // namespace scree
