#include "server/net/session_table.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "server/doors/unix_time.h"
#include "server/net/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

double request_burst(double per_second) {
  return std::max(1.0, per_second * limits::requests_burst_s);
}

}  // namespace

SessionEntry& SessionTable::add(std::shared_ptr<ClientSession> session, bool relayed) {
  const uint64_t id = session->id();
  const RateLimit requests(requests_per_second_, request_burst(requests_per_second_));
  const auto [entry, is_new] = entries_.emplace(id, SessionEntry{std::move(session), requests});
  CHECK(is_new);
  entry->second.relayed = relayed;
  outsiders_.insert(id);
  return entry->second;
}

SessionEntry& SessionTable::join(ClientSession& session, uint64_t id, glm::vec3 eye_m) {
  outsiders_.erase(session.id());
  auto node = entries_.extract(session.id());
  CHECK(!node.empty());
  node.key() = id;
  session.continue_as(id);
  const auto placed = entries_.insert(std::move(node));
  CHECK(placed.inserted);
  SessionEntry& entry = placed.position->second;
  entry.eye_m = eye_m;
  return entry;
}

void SessionTable::erase(uint64_t id) {
  outsiders_.erase(id);
  entries_.erase(id);
}

SessionEntry* SessionTable::find(uint64_t id) {
  const auto found = entries_.find(id);
  return found == entries_.end() ? nullptr : &found->second;
}

const SessionEntry* SessionTable::find(uint64_t id) const {
  const auto found = entries_.find(id);
  return found == entries_.end() ? nullptr : &found->second;
}

void SessionTable::charge_bytes(BytesOut& bytes_out, std::vector<BytesOut::Receiver>& receivers) {
  for (auto& [id, entry] : entries_) {
    if (entry.session->phase() != ClientSession::Phase::joined) continue;
    bytes_out.charge(entry.bytes_out, entry.session->queued_bytes() - entry.bytes_out.charged);
    receivers.push_back(entry.receiver());
  }
}

SessionTable::Sessions SessionTable::all() const {
  Sessions sessions;
  for (const auto& [id, entry] : entries_) sessions.push_back(entry.session);
  return sessions;
}

void SessionTable::set_requests_per_second(double per_second) {
  requests_per_second_ = per_second;
  for (auto& [id, entry] : entries_) entry.requests.change(per_second, request_burst(per_second));
}

size_t SessionTable::joined() const {
  CHECK(outsiders_.size() <= entries_.size());
  return entries_.size() - outsiders_.size();
}

size_t SessionTable::placed() const {
  return static_cast<size_t>(std::ranges::count_if(entries_, [](const auto& one) {
    return one.second.session->phase() == ClientSession::Phase::joined && one.second.needs_place();
  }));
}

size_t SessionTable::turned_away() const {
  return static_cast<size_t>(std::ranges::count_if(
      outsiders_, [this](uint64_t id) { return entries_.at(id).session->turned_away().has_value(); }));
}

void SessionTable::list_outsiders(std::vector<Outsider>& outsiders) const {
  for (const uint64_t id : outsiders_) {
    const SessionEntry& entry = entries_.at(id);
    if (entry.is_owner) continue;
    const ClientSession& session = *entry.session;
    outsiders.push_back(
        {id, session.origin(), session.phase() == ClientSession::Phase::refused, session.is_silent()});
  }
}

SessionTable::OwnersSessions SessionTable::of_owner(double now_s) const {
  OwnersSessions owners;
  for (const auto& [id, entry] : entries_) {
    if (!entry.is_owner) continue;
    if (entry.session->phase() == ClientSession::Phase::refused)
      ++owners.refused;
    else
      owners.open.push_back(entry.session);
  }
  std::ranges::stable_sort(owners.open, std::ranges::greater(),
                           [now_s](const auto& session) { return session->idle_s(now_s); });
  return owners;
}

std::vector<SessionRow> SessionTable::rows(double now_s) const {
  std::vector<SessionRow> rows;
  for (const auto& [id, entry] : entries_) {
    if (entry.session->phase() != ClientSession::Phase::joined) continue;
    rows.push_back({id, entry.name, entry.program, entry.session->ip(), entry.grant.role,
                    entry.grant.token_id, static_cast<uint32_t>(now_s - entry.joined_s),
                    entry.session->sent_bytes(), entry.session->encrypted()});
  }
  return rows;
}

void end_lapsed_grants(const SessionTable& sessions, const Access& access) {
  const uint64_t now_s = unix_now_s();
  std::vector<std::pair<std::shared_ptr<ClientSession>, Refused>> lapsed;
  for (const auto& [id, entry] : sessions.entries())
    if (auto holds = access.still_holds(entry.grant, now_s); !holds)
      lapsed.emplace_back(entry.session, holds.error());
  for (const auto& [session, refused] : lapsed) session->refuse(refused);
}

}  // namespace scree
