#include "server/net/room.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

#include "server/doors/descriptors.h"
#include "server/doors/limits.h"
#include "server/log/log.h"

namespace scree {

void Room::fit(uint32_t sessions_max) {
  sessions_max_ = sessions_max;
  const size_t wanted =
      sessions_max + limits::outsiders_max + limits::administrators_max + limits::descriptors_reserved;
  const size_t granted = raise_descriptors(wanted);
  descriptors_ = std::max(granted, 2 * limits::descriptors_reserved) - limits::descriptors_reserved;
  outsiders_max_ = std::min(limits::outsiders_max, descriptors_ / 4);
  if (granted >= wanted || this->sessions_max() == sessions_max) return;
  log_of(LogPart::net)
      .warn(
          "this process may open {} files: room for {} sessions, not {} (sessions-max); ulimit -n, or "
          "LimitNOFILE of a "
          "service, says how many",
          granted, this->sessions_max(), sessions_max);
}

size_t Room::sessions_max() const {
  const size_t taken = outsiders_max_ + limits::administrators_max;
  return std::min<size_t>(sessions_max_, std::max(descriptors_, taken + 1) - taken);
}

bool Room::has_free_place(const SessionTable& sessions, size_t reserved) const {
  const size_t most = sessions_max();
  const auto kept_max = static_cast<size_t>(limits::places_kept_part * static_cast<double>(most));
  return sessions.placed() + std::min(reserved, kept_max) < most;
}

tl::expected<void, Refused> Room::find_place(const SessionTable& sessions, const ClientSession& newcomer,
                                             const Grant& grant, size_t reserved, double now_s) const {
  if (has_free_place(sessions, reserved)) return {};
  if (const auto leaver = who_gives_way(sessions, newcomer.origin(), grant, now_s)) {
    leaver->session->refuse(
        {Refusal::idle_made_room,
         fmt::format("the server is full, and {}: another client has your place", leaver->why)});
    return {};
  }
  return refuse(
      Refusal::sessions_max,
      fmt::format("the server is full: {} sessions (sessions-max); try again later", sessions_max()));
}

/// Nobody who plays goes for it, and no administrator. The first of the programs that came without a token
/// goes; an administrator also takes the room of a program whose token is of another role.
tl::expected<void, Refused> Room::find_room_beside(const SessionTable& sessions, const SessionEntry& newcomer,
                                                   const Grant& grant) {
  if (newcomer.is_owner) return {};
  const SessionEntry* first_without_token = nullptr;
  const SessionEntry* first_with_token = nullptr;
  size_t beside = 0;
  for (const auto& [id, entry] : sessions.entries()) {
    if (entry.session->phase() != ClientSession::Phase::joined || entry.needs_place() || entry.is_owner)
      continue;
    ++beside;
    if (entry.grant.role == Role::admin) continue;
    const SessionEntry*& first = holds_token(entry.grant) ? first_with_token : first_without_token;
    if (first == nullptr) first = &entry;
  }
  if (beside < limits::administrators_max) return {};
  const bool is_administrator = grant.role == Role::admin;
  const SessionEntry* const leaver =
      first_without_token == nullptr && is_administrator ? first_with_token : first_without_token;
  if (leaver != nullptr) {
    leaver->session->refuse(
        {Refusal::idle_made_room, "another administrator came (limits.administrators_max)"});
    return {};
  }
  return refuse(Refusal::sessions_max,
                fmt::format("there are {} administrators already (limits.administrators_max){}",
                            limits::administrators_max, is_administrator ? "" : "; try again later"));
}

bool Room::has_place(const SessionTable& sessions, size_t reserved, double now_s) const {
  return has_free_place(sessions, reserved) || who_gives_way(sessions, Origin(), Grant(), now_s).has_value();
}

bool holds_token(const Grant& grant) {
  return grant.token_id != 0 || grant.role == Role::admin;
}

std::optional<GivesWay> who_gives_way(const SessionTable& sessions, const Origin& newcomer,
                                      const Grant& grant, double now_s) {
  Crowd held;
  for (const auto& [id, entry] : sessions.entries())
    if (entry.session->phase() == ClientSession::Phase::joined && entry.needs_place())
      held.add(entry.session->origin());
  const size_t few = std::max(held.weight(newcomer) + 1, limits::sessions_of_a_household);
  // Why a session gives way; null: it stays. Who needs no place has none to give, and holders of tokens give
  // way to such alone.
  const auto why = [&](const SessionEntry& entry) -> const char* {
    if (entry.session->phase() != ClientSession::Phase::joined || !entry.needs_place()) return nullptr;
    const bool idle = entry.session->may_make_room(now_s);
    if (holds_token(entry.grant))
      return idle && holds_token(grant) ? "you were idle for a long time" : nullptr;
    if (idle) return "you were idle for a long time";
    if (holds_token(grant)) return "clients with a token have priority";
    return held.weight(entry.session->origin()) > few
               ? "your address, or the network around it, has the most clients"
               : nullptr;
  };
  const auto rank = [&](const SessionEntry& entry) {
    return std::tuple(!holds_token(entry.grant), held.weight(entry.session->origin()),
                      entry.session->idle_s(now_s));
  };
  const SessionEntry* least = nullptr;
  for (const auto& [id, entry] : sessions.entries())
    if (why(entry) != nullptr && (least == nullptr || rank(entry) > rank(*least))) least = &entry;
  if (least == nullptr) return std::nullopt;
  return GivesWay{least->session, why(*least)};
}

}  // namespace scree
