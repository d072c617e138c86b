#include "server/net/returns.h"

namespace scree {

namespace {

/// Whether a session may go on for who holds the other grant.
bool same_right(const Grant& a, const Grant& b) {
  return a.token_id == b.token_id && a.role == b.role;
}

}  // namespace

std::optional<Departed> Returns::resume(const std::string& ticket, const Grant& grant,
                                        const SessionTable& sessions, double now_s) {
  if (ticket.empty()) return std::nullopt;
  tickets_.expire(now_s);
  const std::optional<uint64_t> id = tickets_.session_of(ticket);
  const SessionEntry* const there = id ? sessions.find(*id) : nullptr;
  const bool connected = there != nullptr && same_right(there->grant, grant);
  if (connected) {
    const auto session = there->session;  // closing it erases the entry
    session->close("the session continues on another connection");
  }
  const Departed* const departed = id ? tickets_.departed(*id) : nullptr;
  if (departed == nullptr || !same_right(departed->grant, grant)) {
    ++tickets_void_;
    return std::nullopt;
  }
  Departed before = *departed;
  before.reserves_place = before.reserves_place || connected;
  return before;
}

uint64_t Returns::join_party(const ClientSession& session, const Grant& grant, uint64_t before,
                             double now_s) {
  if (grant.token_id != 0)
    return parties_.join("token " + std::to_string(grant.token_id), session.id(), now_s);
  if (grant.role == Role::admin) return 0;
  if (door_.is_free(session.address())) return parties_.join_apart(session.id(), before, now_s);
  return parties_.join(session.address(), session.id(), now_s);
}

void Returns::closed(const SessionEntry& entry, double now_s) {
  const ClientSession& session = *entry.session;
  if (session.may_go_on())
    tickets_.depart({session.id(), entry.grant, session.ip(), session.origin(), entry.requests,
                     entry.joined_s, entry.party, now_s, session.was_lost() && entry.needs_place()});
  else
    tickets_.forget(session.id());
  if (entry.party != 0) parties_.leave(entry.party, now_s);
}

}  // namespace scree
