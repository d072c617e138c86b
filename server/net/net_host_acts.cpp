// What the server and its host change of a NetHost while it runs: who may come in, the page, and what
// sessions may. And messages that this server does not carry out itself.
#include <fmt/format.h>
#include <type_traits>
#include <utility>

#include "server/net/net_host.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"

namespace scree {

void NetHost::set_access(std::shared_ptr<const Access> access) {
  CHECK(network_thread_.is_the_same());
  authorizer_.set_access(std::move(access));
  administration_.read_bans_again();
  log_access(authorizer_.access());
  end_lapsed_grants(sessions_, authorizer_.access());
}

void NetHost::send(uint64_t session, const ServerMessage& message) {
  administration_.note_answered(session, message);
  if (const SessionEntry* const entry = sessions_.find(session)) entry->session->send(message);
}

void NetHost::set_role(uint64_t session, Role role) {
  SessionEntry* const entry = sessions_.find(session);
  if (entry == nullptr) return;
  entry->grant.role = role;
  talk_.set_role(session, role);
}

void NetHost::kick(uint64_t session, const std::string& reason) {
  const SessionEntry* const entry = sessions_.find(session);
  if (entry == nullptr) return;
  const auto kicked = entry->session;  // which leaves the table
  kicked->refuse({Refusal::kicked, reason});
}

void NetHost::set_own_store(uint64_t session, uint64_t of_session) {
  if (const SessionEntry* const entry = sessions_.find(session))
    publisher_.set_store(session, store_of_person(entry->grant.token_id, of_session));
}

void NetHost::set_files(std::shared_ptr<const WebFiles> files) {
  CHECK(network_thread_.is_the_same());
  web_.set_files(std::move(files));
}

/// The client is of a later release, or made by somebody else.
tl::expected<void, Refused> NetHost::skip(ClientSession& session, const UnknownMessage& unknown) {
  ++figures_.counts().messages_unknown;
  if (unknown.request) {
    ++figures_.counts().requests;
    const std::string why =
        fmt::format("this server does not know {}: the client is of another release", unknown.value);
    requests_.refuse(session, *unknown.request, {Refusal::value_unknown, why});
    return {};
  }
  log_.say(log_of(LogPart::net, session.id()), LogLevel::info, "message_unknown",
           fmt::format("session {}: a message of an unknown kind is skipped", session.id()));
  return {};
}

tl::expected<void, Refused> NetHost::receive(ClientSession& session, const ClientMessage& message) {
  if (config_.way_back)
    if (const auto handed = hand_on(session, message)) return *handed;
  return carry_out(session, message);
}

/// Requests are bounded here as well, so that who asks too fast takes no part of the bus.
std::optional<tl::expected<void, Refused>> NetHost::hand_on(ClientSession& session,
                                                            const ClientMessage& message) {
  using Handed = std::optional<tl::expected<void, Refused>>;
  SessionEntry& entry = sessions_.at(session.id());
  return std::visit(
      Overloaded{[&]<typename Asks>(const RequestMessage<Asks>& asked) -> Handed {
                   ++figures_.counts().requests;
                   auto asks =
                       entry.requests.try_spend(steady_now_s())
                           ? config_.way_back->ask(session.id(), entry.eye_m, asked.request, message)
                           : refuse(Refusal::requests_per_second,
                                    fmt::format("more than {} requests a second (requests-per-second); "
                                                "ask again more slowly",
                                                sessions_.requests_per_second()));
                   if (!asks) requests_.refuse(session, asked.request, asks.error());
                   return tl::expected<void, Refused>();
                 },
                 [](const ChannelMessage&) -> Handed {
                   return refuse(Refusal::edge,
                                 "this server is an edge: programs that speak with a game's rules connect to "
                                 "the simulating server");
                 },
                 [](const auto&) -> Handed { return std::nullopt; }},
      message);
}

}  // namespace scree
