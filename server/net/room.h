// How many sessions and other connections the process has room for, and which session gives its place to a
// newcomer when the server is full. Administrators need no place, and nobody goes for them. On the network
// thread.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "server/net/limits.h"
#include "server/net/session_table.h"

namespace scree {

class Room {
 public:
  /// Raises the process's limit of descriptors for so many sessions, and takes what it gets. Says so in the
  /// log if that is too few.
  void fit(uint32_t sessions_max);
  /// Changes how many sessions there may be, within the descriptors that are there already.
  void bound(uint32_t sessions_max) { sessions_max_ = sessions_max; }

  size_t sessions_max() const;
  /// Outsiders (SessionTable) and HTTP connections, all together.
  size_t outsiders_max() const { return outsiders_max_; }

  /// Finds a place for the newcomer; ends a session for it if need be. `reserved`: places kept for lost
  /// connections, of which limits::places_kept_part at most count.
  tl::expected<void, Refused> find_place(const SessionTable& sessions, const ClientSession& newcomer,
                                         const Grant& grant, size_t reserved, double now_s) const;
  /// Finds room for a newcomer that needs no place: an administrator, or a program that administers alone.
  /// The owner's connections are bounded where they come in (limits::owner_connections_max).
  static tl::expected<void, Refused> find_room_beside(const SessionTable& sessions,
                                                      const SessionEntry& newcomer, const Grant& grant);
  /// Whether a newcomer without a token, of an address that holds none, would find a place; `reserved`: as of
  /// find_place().
  bool has_place(const SessionTable& sessions, size_t reserved, double now_s) const;

 private:
  bool has_free_place(const SessionTable& sessions, size_t reserved) const;

  uint32_t sessions_max_ = 0;
  size_t descriptors_ = 0;  ///< for connections
  size_t outsiders_max_ = limits::outsiders_max;
};

/// A session that gives its place to another one.
struct GivesWay {
  std::shared_ptr<ClientSession> session;
  std::string why;
};

/// The session to end for a newcomer with that grant: one without a token if there is any, of the address or
/// network (Crowd) with the most sessions, the idlest of these. One that is not idle goes only if its address
/// holds more than the newcomer's then will, and more than a household. Nothing when all stay.
std::optional<GivesWay> who_gives_way(const SessionTable& sessions, const Origin& newcomer,
                                      const Grant& grant, double now_s);

/// Whether the grant was given for a token, an access token or the admin token.
bool holds_token(const Grant& grant);

}  // namespace scree
