#include "server/net/net_host.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "proto/codec.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/token.h"

namespace scree {

namespace {

/// Period of the check for silent sessions; the shorter one while stopping.
constexpr std::chrono::milliseconds timer_period{100};
constexpr std::chrono::milliseconds timer_period_stopping{5};
/// Given to clients to read the goodbye.
constexpr double stop_seconds_max = 0.5;

double steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double burst_of(double requests_per_second) {
  return std::max(1.0, requests_per_second * limits::requests_burst_s);
}

PublisherConfig publisher_config(const NetConfig& config) {
  return {config.terrain.voxel_size_m, std::max(1U, config.tick_rate_hz),
          std::max(1U, config.ticks_per_transform)};
}

Result<float> granted_radius(glm::vec3 eye_m, float radius_m) {
  if (!std::isfinite(eye_m.x) || !std::isfinite(eye_m.y) || !std::isfinite(eye_m.z))
    return fail("the eye's position is not a number");
  if (!std::isfinite(radius_m) || radius_m < 0.0F)
    return fail("the radius of interest must be a number, and not negative");
  return std::min(radius_m, limits::interest_radius_max_m);
}

}  // namespace

NetHost::NetHost(const NetConfig& config, CommandQueue& commands)
    : config_(config),
      service_(config.service),
      commands_(commands),
      acceptor_(context_),
      timer_(context_),
      publisher_(publisher_config(config)) {}

Result<void> NetHost::listen() {
  const std::string where = config_.bind + ":" + std::to_string(config_.port);
  asio::error_code error;
  const auto address = asio::ip::make_address(config_.bind, error);
  if (error) return fail("cannot listen on " + where + ": '" + config_.bind + "' is no IP address (--bind)");
  const asio::ip::tcp::endpoint endpoint(address, config_.port);
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(asio::ip::tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use)
    return fail("cannot listen on " + where +
                ": the port is in use; stop what uses it, or choose another one (--port)");
  if (error) return fail("cannot listen on " + where + ": " + error.message());
  port_ = acceptor_.local_endpoint(error).port();
  if (error) return fail("cannot listen on " + where + ": " + error.message());
  accept();
  tick_timer();
  return {};
}

void NetHost::run() {
  CHECK(network_thread_.is_the_same());
  context_.run();
}

void NetHost::accept() {
  acceptor_.async_accept([this](asio::error_code error, asio::ip::tcp::socket socket) {
    if (error == asio::error::operation_aborted || stopping_) return;
    if (error)
      spdlog::warn("cannot accept a connection: {}", error.message());
    else
      accepted(std::move(socket));
    accept();
  });
}

void NetHost::accepted(asio::ip::tcp::socket socket) {
  const uint64_t id = next_session_++;
  const SessionTimes times{config_.hello_seconds, config_.stall_seconds, limits::linger_seconds_max};
  const auto session = std::make_shared<ClientSession>(std::move(socket), id, *this, times, steady_now_s());
  const size_t pending = sessions_.size() - joined_count();
  const double rate = service_.requests_per_second;
  CHECK(!sessions_.contains(id));
  sessions_.emplace(id, Entry{session, RateLimit(rate, burst_of(rate)), {}});
  spdlog::debug("session {}: {} connected", id, session->peer());
  if (pending >= limits::pending_sessions_max)
    session->refuse(
        {Refusal::sessions_pending,
         "too many connections that have not said hello (limits.pending_sessions_max); try again"});
  session->start();
}

void NetHost::tick_timer() {
  timer_.expires_after(stopping_ ? timer_period_stopping : timer_period);
  timer_.async_wait([this](asio::error_code error) {
    if (error) return;
    const double now_s = steady_now_s();
    std::vector<std::shared_ptr<ClientSession>> sessions;
    for (const auto& [id, entry] : sessions_) sessions.push_back(entry.session);
    for (const auto& session : sessions) session->check_time(now_s);
    if (stopping_ && (sessions_.empty() || now_s > stop_deadline_s_)) {
      for (const auto& session : sessions) session->close("the server stops");
      return;
    }
    tick_timer();
  });
}

uint32_t NetHost::joined_count() const {
  return static_cast<uint32_t>(std::ranges::count_if(sessions_, [](const auto& entry) {
    return entry.second.session->phase() == ClientSession::Phase::joined;
  }));
}

tl::expected<WelcomeMessage, Refused> NetHost::admit(ClientSession& session, const HelloMessage& hello) {
  if (hello.protocol != protocol_version)
    return refuse(Refusal::protocol_version, "this server speaks protocol version " +
                                                 std::to_string(protocol_version) + ", the client version " +
                                                 std::to_string(hello.protocol) +
                                                 ": use a client and a server of the same release");
  if (stopping_) return refuse(Refusal::server_stops, "the server stops");
  if (joined_count() >= service_.sessions_max)
    return refuse(Refusal::sessions_max, "the server is full: " + std::to_string(service_.sessions_max) +
                                             " sessions (sessions-max); try again later");
  const auto radius_m = granted_radius(hello.eye_m, hello.interest_radius_m);
  if (!radius_m) return refuse(Refusal::interest_invalid, radius_m.error().message);
  publisher_.join(session.id(), hello.eye_m, *radius_m);
  sessions_.at(session.id()).name = hello.name;
  ++counts_.sessions_joined;
  update_stats();
  spdlog::info("session {}: {} joined from {}, interest {} m", session.id(), hello.client, session.peer(),
               *radius_m);
  WelcomeMessage welcome;
  welcome.session = session.id();
  welcome.tick = publisher_.state().tick();
  welcome.tick_rate_hz = config_.tick_rate_hz;
  welcome.ticks_per_transform = config_.ticks_per_transform;
  welcome.terrain = config_.terrain;
  welcome.interest_radius_m = *radius_m;
  welcome.replay = config_.replay;
  return welcome;
}

tl::expected<void, Refused> NetHost::receive(ClientSession& session, const ClientMessage& message) {
  using Done = tl::expected<void, Refused>;
  return std::visit(Overloaded{
                        [](const HelloMessage&) -> Done {
                          return refuse(Refusal::hello_repeated,
                                        "a second hello: this connection has joined already");
                        },
                        [&](const InterestMessage& interest) { return follow(session, interest); },
                        [&]<typename Asks>(const Asked<Asks>& asked) -> Done {
                          request(session, {session.id(), asked.request, static_cast<const Asks&>(asked)});
                          return {};
                        },
                        [&](const RepairRequest& repair) -> Done {
                          spdlog::warn("session {}: {} chunks differ at tick {}", session.id(),
                                       repair.chunks.size(), repair.tick);
                          publisher_.repair(session.id(), repair);
                          return {};
                        },
                        // On TCP the bytes that wait for a client say how far behind it is.
                        [](const AckMessage&) -> Done { return {}; },
                        [&](const AdminMessage& admin) { return administer(session, admin); },
                        [&](const CursorMessage& cursor) -> Done {
                          publisher_.set_cursor(
                              {session.id(), sessions_.at(session.id()).name, cursor.eye_m, cursor.aim_m});
                          return {};
                        },
                        [&](const WatchMessage& watch) -> Done {
                          publisher_.watch(session.id(), watch.physics);
                          return {};
                        },
                    },
                    message);
}

tl::expected<void, Refused> NetHost::follow(ClientSession& session, const InterestMessage& interest) {
  const auto radius_m = granted_radius(interest.eye_m, interest.interest_radius_m);
  if (!radius_m) return refuse(Refusal::interest_invalid, radius_m.error().message);
  publisher_.set_interest(session.id(), interest.eye_m, *radius_m);
  return {};
}

void NetHost::request(ClientSession& session, const Command& command) {
  ++counts_.requests;
  const auto refused = [&](Refusal reason, const std::string& message) {
    refuse_request(session, command.request, {reason, message});
  };
  if (config_.replay)
    return refused(Refusal::replay, "this server plays a recording: nothing in it can be changed");
  if (!sessions_.at(session.id()).requests.take(steady_now_s()))
    return refused(Refusal::requests_per_second,
                   fmt::format("more than {} requests a second (requests-per-second); ask again more slowly",
                               service_.requests_per_second));
  if (!commands_.push(command))
    refused(Refusal::commands_waiting, "the server is busy: " + std::to_string(commands_.commands_max()) +
                                           " commands wait already (limits.commands_waiting_max); try again");
}

void NetHost::refuse_request(ClientSession& session, uint32_t request, const Refused& refused) {
  ++counts_.requests_refused;
  counts_.refusals.add(refused.reason);
  session.send(ServerMessage(ReplyMessage{request, refused.message, 0}));
}

/// A wrong token ends the connection, so that each connection has one attempt.
tl::expected<void, Refused> NetHost::administer(ClientSession& session, const AdminMessage& message) {
  if (config_.admin_token.empty()) {
    ++counts_.requests;
    refuse_request(session, message.request,
                   {Refusal::no_admin_token,
                    "this server was started without an admin token: nobody may change its settings "
                    "(--admin-token-file)"});
    return {};
  }
  if (!same_token(message.token, config_.admin_token))
    return refuse(Refusal::admin_token_wrong, "the admin token is wrong");
  std::string changes;
  for (const SettingValue& setting : message.settings) changes += " " + setting.name + "=" + setting.value;
  spdlog::info("session {}: {} sets{}", session.id(), session.peer(), changes);
  request(session, {session.id(), message.request, SettingsRequest{message.settings}});
  return {};
}

void NetHost::refused(ClientSession& session, const Refused& refused) {
  ++counts_.sessions_refused;
  counts_.refusals.add(refused.reason);
  spdlog::warn("session {}: {} refused ({}): {}", session.id(), session.peer(), name_of(refused.reason),
               refused.message);
  publisher_.leave(session.id());
  update_stats();
}

void NetHost::closed(ClientSession& session, const std::string& reason) {
  if (const std::optional<Refusal> cut_for = session.cut_for()) {
    ++counts_.sessions_cut;
    counts_.refusals.add(*cut_for);
    spdlog::warn("session {}: {} cut off: {}", session.id(), session.peer(), reason);
  } else {
    spdlog::info("session {}: {} closed: {}", session.id(), session.peer(), reason);
  }
  publisher_.leave(session.id());
  sessions_.erase(session.id());
  update_stats();
}

/// Settings hold for who is connected, too. A session that has joined stays, however few may now.
void NetHost::grant(const ServiceLimits& service) {
  service_ = service;
  const double rate = service.requests_per_second;
  for (auto& [id, entry] : sessions_) entry.requests.change(rate, burst_of(rate));
}

void NetHost::publish(const TickDelta& delta) {
  CHECK(network_thread_.is_the_same());
  CHECK_EQ(publisher_.clients(), joined_count());
  if (delta.service && *delta.service != service_) grant(*delta.service);
  for (const Reply& reply : delta.replies)
    if (reply.reason) counts_.refusals.add(*reply.reason);
  publisher_.set_refusals(counts_.refusals);
  const auto backlog = [this](uint64_t id) {
    const auto entry = sessions_.find(id);
    return entry == sessions_.end() ? size_t{0} : entry->second.session->backlog_bytes();
  };
  for (Outgoing& outgoing : publisher_.publish(delta, backlog)) {
    const auto entry = sessions_.find(outgoing.session);
    if (entry == sessions_.end()) continue;
    const auto session = entry->second.session;  // sending may end it
    session->send(std::move(outgoing.bytes));
  }
  update_stats();
}

void NetHost::shut_down() {
  if (stopping_) return;
  stopping_ = true;
  stop_deadline_s_ = steady_now_s() + stop_seconds_max;
  asio::error_code ignored;
  acceptor_.close(ignored);
  std::vector<std::shared_ptr<ClientSession>> sessions;
  for (const auto& [id, entry] : sessions_) sessions.push_back(entry.session);
  for (const auto& session : sessions) session->refuse({Refusal::server_stops, "the server stops"});
  timer_.cancel();
  tick_timer();
}

void NetHost::update_stats() {
  watched_ = publisher_.is_watched();
  counts_.published = publisher_.stats();
  counts_.sessions = joined_count();
  const std::scoped_lock lock(stats_mutex_);
  stats_ = counts_;
  eyes_m_ = publisher_.eyes_m();
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
