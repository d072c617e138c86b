// Sessions that lost their connections and may go on: by tickets, in the party that they had, with their
// request limit as it was. On the network thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "server/doors/door.h"
#include "server/doors/parties.h"
#include "server/doors/tickets.h"
#include "server/net/session_table.h"

namespace scree {

class Returns {
 public:
  /// `over`: as of Tickets. `door` must outlive this object.
  Returns(std::function<void(uint64_t session)> over, const Door& door)
      : tickets_(std::move(over)), door_(door) {}

  /// The session of the ticket, without a connection: if it has one, that ends. The ticket holds until the
  /// session has another one. A ticket that does not hold for this grant is counted.
  std::optional<Departed> resume(const std::string& ticket, const Grant& grant, const SessionTable& sessions,
                                 double now_s);
  /// Tickets that were presented, and did not hold.
  uint64_t tickets_void() const { return tickets_void_; }

  /// The party of a session that has joined. Who has no token shares with its address; programs on this
  /// machine, and administrators, share with nobody. `before`: the party that the session had, if it goes on.
  uint64_t join_party(const ClientSession& session, const Grant& grant, uint64_t before, double now_s);
  /// The session is closed: it may go on, or is forgotten.
  void closed(const SessionEntry& entry, double now_s);

  Tickets& tickets() { return tickets_; }

 private:
  Tickets tickets_;
  Parties parties_;
  const Door& door_;
  uint64_t tickets_void_ = 0;
};

}  // namespace scree
