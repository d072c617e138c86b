// NetHost's part of joining: room in a full server, sessions that go on by a ticket, the welcome.
#include <algorithm>
#include <fmt/format.h>
#include <tuple>

#include "crypto/sha256.h"
#include "server/net/net_host.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

bool holds_token(const Grant& grant) {
  return grant.token_id != 0 || grant.role == Role::admin;
}

/// Whether a session may go on for who holds the other grant.
bool same_right(const Grant& a, const Grant& b) {
  return a.token_id == b.token_id && a.role == b.role;
}

}  // namespace

tl::expected<WelcomeMessage, Refused> NetHost::admit(ClientSession& session, const HelloMessage& hello) {
  if (!shares_protocol(hello.protocol, hello.oldest_protocol)) {
    const bool one = hello.oldest_protocol == 0 || hello.oldest_protocol == hello.protocol;
    const std::string spoken = one ? fmt::format("version {}", hello.protocol)
                                   : fmt::format("versions {} to {}", hello.oldest_protocol, hello.protocol);
    return refuse(Refusal::protocol_version,
                  fmt::format("this server speaks protocol version {}, the client {}: use a client and a "
                              "server of the same release",
                              protocol_version, spoken));
  }
  if (stopping_) return refuse(Refusal::server_stops, "the server stops");
  const auto grant = TRY(grant_to(session, hello));
  const auto radius_m = granted_radius(hello.eye_m, hello.interest_radius_m);
  if (!radius_m) return refuse(Refusal::interest_invalid, radius_m.error().message);
  const std::optional<Departed> before = resume(hello.ticket, grant);
  const bool has_place = before && scree::has_place(*before, steady_now_s());
  TRY(find_room(session, grant, has_place));
  Entry& entry = enter(session, before ? before->session : session.id());
  publisher_.join(session.id(), hello.eye_m, *radius_m, hello.lacks_kernels ? 0 : hello.operations,
                  hello.world == world_);
  entry.grant = grant;
  entry.party = join_party(session, grant, before ? before->party : 0);
  entry.name = grant.name;
  entry.program = hello.client;
  entry.joined_s = before ? before->joined_s : steady_now_s();
  if (before) entry.requests = before->requests;
  if (config_.control)
    if (const auto control = may_administer(session, true); !control)
      publisher_.set_control_refusal(session.id(), control.error().message);
  if (hello.meets)
    talk_.join(session.id(), entry.party != 0 ? entry.party : session.id(), entry.name, grant.role);
  note({.kind = EventKind::join, .place_m = hello.eye_m, .session = session.id(), .text = entry.name});
  ++counts_.sessions_joined;
  counts_.sessions_resumed += before ? 1 : 0;
  update_stats();
  say(spdlog::level::info, "joined",
      fmt::format("session {}: {} {} from {} as {}, interest {} m", session.id(), hello.client,
                  before ? "goes on" : "joined", session.peer(), name_of(grant.role), *radius_m));
  WelcomeMessage welcome;
  welcome.session = session.id();
  welcome.tick = publisher_.state().tick();
  welcome.tick_rate_hz = config_.tick_rate_hz;
  welcome.ticks_per_transform = config_.ticks_per_transform;
  welcome.terrain = config_.terrain;
  welcome.interest_radius_m = *radius_m;
  welcome.replay = config_.replay;
  welcome.role = grant.role;
  welcome.world = world_;
  welcome.ticket = tickets_.issue(session.id());
  welcome.resumed = before.has_value();
  if (const auto& ground = config_.terrain.heights) {
    welcome.heights = HeightGround{ground->layout(), sha256(ground->packed(ground->layout().top())), {}};
    if (const auto& bricks = ground->bricks())
      welcome.heights->bricks = BrickGround{*bricks, sha256(ground->packed(bricks->root()))};
  }
  return welcome;
}

/// The session of the ticket, without a connection: if it has one, that ends. The ticket holds until the
/// session has another one.
std::optional<Departed> NetHost::resume(const std::string& ticket, const Grant& grant) {
  if (ticket.empty()) return std::nullopt;
  tickets_.expire(steady_now_s());
  const std::optional<uint64_t> id = tickets_.session_of(ticket);
  const auto there = id ? sessions_.find(*id) : sessions_.end();
  const bool connected = there != sessions_.end() && same_right(there->second.grant, grant);
  if (connected) {
    const auto session = there->second.session;  // closing it erases the entry
    session->close("it goes on by another connection");
  }
  const Departed* const departed = id ? tickets_.departed(*id) : nullptr;
  if (departed == nullptr || !same_right(departed->grant, grant)) {
    ++counts_.tickets_void;
    return std::nullopt;
  }
  Departed before = *departed;
  before.keeps_place = before.keeps_place || connected;
  return before;
}

void NetHost::remember(const ClientSession& session) {
  if (!session.may_go_on()) return tickets_.forget(session.id());
  const Entry& entry = sessions_.at(session.id());
  tickets_.depart({session.id(), entry.grant, session.ip(), entry.requests, entry.joined_s, entry.party,
                   steady_now_s(), session.was_lost()});
}

/// The session is one of those that have joined, from now on under this number.
NetHost::Entry& NetHost::enter(ClientSession& session, uint64_t id) {
  outsiders_.erase(session.id());
  auto node = sessions_.extract(session.id());
  CHECK(!node.empty());
  node.key() = id;
  session.continue_as(id);
  const auto placed = sessions_.insert(std::move(node));
  CHECK(placed.inserted);
  return placed.position->second;
}

/// Places of lost connections are kept from newcomers without a token.
tl::expected<void, Refused> NetHost::find_room(const ClientSession& newcomer, const Grant& grant,
                                               bool has_place) {
  const size_t sessions_max = std::min<size_t>(service_.sessions_max, descriptors_ - outsiders_max_);
  const auto kept_max = static_cast<size_t>(limits::places_kept_part * static_cast<double>(sessions_max));
  const bool comes_first = has_place || holds_token(grant);
  const size_t kept = comes_first ? 0 : std::min(tickets_.places_kept(steady_now_s()), kept_max);
  if (joined_count() + kept < sessions_max || make_room(newcomer, grant)) return {};
  return refuse(Refusal::sessions_max, "the server is full: " + std::to_string(sessions_max) +
                                           " sessions (sessions-max); try again later");
}

/// Ends one session for the newcomer: one without a token if there is any, of the address with the most, the
/// idlest of these. False when all stay.
bool NetHost::make_room(const ClientSession& newcomer, const Grant& grant) {
  const double now_s = steady_now_s();
  std::map<std::string, size_t> held;
  for (const auto& [id, entry] : sessions_)
    if (entry.session->phase() == ClientSession::Phase::joined) ++held[entry.session->address()];
  const size_t few = held[newcomer.address()] + joined_count() / 4;
  // Why a session gives way; null: it stays. Administrators give way to nobody, holders of tokens to such
  // alone.
  const auto why = [&](const Entry& entry) -> const char* {
    if (entry.session->phase() != ClientSession::Phase::joined || entry.grant.role == Role::admin)
      return nullptr;
    const bool idle = entry.session->may_make_room(now_s);
    if (holds_token(entry.grant)) return idle && holds_token(grant) ? "you did nothing for long" : nullptr;
    if (idle) return "you did nothing for long";
    if (holds_token(grant)) return "those who hold a token go first";
    return held[entry.session->address()] > few ? "your address holds many places" : nullptr;
  };
  const auto rank = [&](const Entry& entry) {
    return std::tuple(!holds_token(entry.grant), held[entry.session->address()],
                      entry.session->idle_s(now_s));
  };
  const Entry* least = nullptr;
  for (const auto& [id, entry] : sessions_)
    if (why(entry) != nullptr && (least == nullptr || rank(entry) > rank(*least))) least = &entry;
  if (least == nullptr) return false;
  const std::string words = why(*least);
  const auto session = least->session;
  session->refuse({Refusal::idle_made_room, "the server is full, and " + words + ": another has your place"});
  return true;
}

}  // namespace scree
