// The sessions that are connected, by their numbers, and what the server knows of their persons. On the
// network thread.
//
// Invariant: each session is an outsider (it has not joined, or was refused) or has joined, never both.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/doors/authorizer.h"
#include "server/doors/bytes_out.h"
#include "server/net/client_session.h"
#include "server/net/limits.h"
#include "server/net/outsider.h"
#include "shared/base/rate_limit.h"

namespace scree {

struct SessionEntry {
  std::shared_ptr<ClientSession> session;
  RateLimit requests;
  std::string name{};      ///< the person's, as others see it (person_names.h)
  std::string name_key{};  ///< of that
  Grant grant{};           ///< of a joined session
  std::string program{};
  double joined_s = 0.0;
  uint64_t party = 0;        ///< as of Command; 0: an administrator, in none of Parties
  bool relayed = false;      ///< as of Caller
  bool is_many = false;      ///< it is a trusted proxy's that names nobody
  bool administers = false;  ///< as of HelloMessage
  bool at_door = true;       ///< it has a place there (Door::enter), which it gives back
  bool is_owner = false;     ///< as of Caller; it has no place at the door, and takes nobody's room
  ByteAccount bytes_out{};   ///< of a joined session
  uint64_t refused = 0;      ///< of its requests, by the world or by a limit

  RateLimit queries{limits::queries_per_second_max, limits::queries_burst_max};  ///< of questions about space

  std::optional<RateLimit> inputs{};  ///< of a person on foot; nothing before the first

  /// As it said last, with its interest or its cursor; who never did is at the origin.
  /// Where it is on foot, its person's, from its next request on.
  glm::vec3 eye_m{0.0F};

  /// Whether it counts among the sessions that the server has room for.
  bool needs_place() const { return grant.role != Role::admin && !administers; }

  BytesOut::Receiver receiver() { return {is_many ? std::string() : session->address(), &bytes_out}; }
  Caller caller() const {
    return {session->address(), session->ip(), session->encrypted(), relayed, is_owner};
  }
};

class SessionTable {
 public:
  using Sessions = std::vector<std::shared_ptr<ClientSession>>;

  explicit SessionTable(double requests_per_second) : requests_per_second_(requests_per_second) {}

  /// Enters a session as an outsider; its number must be new.
  SessionEntry& add(std::shared_ptr<ClientSession> session, bool relayed);
  /// The session has joined, and goes on under the number `id`, which no other session has.
  SessionEntry& join(ClientSession& session, uint64_t id, glm::vec3 eye_m = glm::vec3(0.0F));
  /// A session that was refused is an outsider until it is closed.
  void refuse(uint64_t id) { outsiders_.insert(id); }
  void erase(uint64_t id);

  /// Null when there is no such session.
  SessionEntry* find(uint64_t id);
  const SessionEntry* find(uint64_t id) const;
  /// The session must be there.
  SessionEntry& at(uint64_t id) { return entries_.at(id); }
  const SessionEntry& at(uint64_t id) const { return entries_.at(id); }
  const std::map<uint64_t, SessionEntry>& entries() const { return entries_; }
  /// Charges those that have joined for all that is queued for them, and lists them.
  void charge_bytes(BytesOut& bytes_out, std::vector<BytesOut::Receiver>& receivers);
  /// A copy, for a loop that may close sessions.
  Sessions all() const;

  /// Changes how many requests a session may make a second, for sessions that are there, too.
  void set_requests_per_second(double per_second);
  double requests_per_second() const { return requests_per_second_; }

  bool empty() const { return entries_.empty(); }
  size_t outsiders() const { return outsiders_.size(); }
  size_t joined() const;
  /// Those that joined and need a place.
  size_t placed() const;
  /// Outsiders that the door turned away.
  size_t turned_away() const;
  /// Adds the outsiders to a list, but for the owner's.
  void list_outsiders(std::vector<Outsider>& outsiders) const;

  /// The owner's connections: those that were not refused, the idlest first, and how many were.
  struct OwnersSessions {
    Sessions open;
    size_t refused = 0;
  };
  OwnersSessions of_owner(double now_s) const;

  /// The sessions that have joined, for administrators.
  std::vector<SessionRow> rows(double now_s) const;

 private:
  double requests_per_second_;
  std::map<uint64_t, SessionEntry> entries_;
  std::set<uint64_t> outsiders_;
};

/// Ends the sessions whose tokens have expired or were revoked.
void end_lapsed_grants(const SessionTable& sessions, const Access& access);

}  // namespace scree
