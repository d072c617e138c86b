// How many bytes a second go out to each address (Door), and to all together, of messages that can wait:
// chunks, pieces, tiles, ground, patches, files of the page. Frames, replies and other small messages are
// never held back, but they are charged, so that streams have what they leave.
//
// Each receiver, a session or a connection by HTTP, has an account. share() fills the accounts: where an
// address has too little, its receivers get equal shares of it, and where all together have, the addresses
// do. An unused budget is saved up, for some seconds. Accounts are full as long as the budget is not
// exceeded, so a client that stays within it does not notice.
//
// This machine's own addresses have no budget, as they have no bounds at the door. No sockets; time is an
// argument (seconds). Not thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "server/doors/door.h"
#include "server/doors/limits.h"

namespace scree {

/// The account of one receiver.
struct ByteAccount {
  int64_t room = 0;      ///< bytes of streams that it may be sent now; 0 and less: none
  uint64_t charged = 0;  ///< bytes that were sent, since the start
};

class BytesOut {
 public:
  /// Bytes a second; 0: no limit.
  struct Rules {
    double per_address = limits::bytes_out_per_address;
    double all = limits::bytes_out_all;
  };
  struct Receiver {
    /// As of Door; empty: a trusted proxy's, which speaks for many. Then only the budget of all holds.
    std::string address;
    ByteAccount* account;
  };

  /// `door` must outlive this object.
  BytesOut(const Rules& rules, const Door& door);

  /// A receiver begins: it has room at once, unless its address has used up what it saved.
  void open(const Receiver& receiver, double now_s);
  /// Charges bytes that are on their way.
  void charge(ByteAccount& account, uint64_t bytes);
  /// A receiver ends: its address has its room, or its debt. The account is empty then.
  void close(const Receiver& receiver);
  /// Fills the accounts of all receivers. Call it once a tick, at least a few times a second.
  void share(const std::vector<Receiver>& receivers, double now_s);

  /// Bytes that were charged, since the start.
  uint64_t bytes() const { return bytes_; }
  /// How often share() found a receiver that had used up its room, since the start.
  uint64_t held_back() const { return held_back_; }
  /// Addresses that have not saved up all they can.
  size_t addresses() const { return tanks_.size(); }

 private:
  /// What was saved up, bytes; negative: owed.
  struct Tank {
    double bytes = 0.0;
    double filled_s = 0.0;  ///< when
  };
  struct Group;

  bool is_free(const std::string& address) const;
  Tank& tank_of(const std::string& address, double now_s);
  static void refill(Tank& tank, double per_second, double saved_s, double now_s);
  int64_t left_in(const Tank& tank) const;
  void forget_the_full(double now_s);

  Rules rules_;
  const Door& door_;
  std::map<std::string, Tank> tanks_;  ///< of addresses; one that is not there is full
  Tank all_;
  uint64_t bytes_ = 0;
  uint64_t held_back_ = 0;
};

/// Parts of `total` for those who want so much: each gets what it wants, or as much as the others that lack
/// something. Nobody gets more than it wants.
std::vector<int64_t> even_parts(const std::vector<int64_t>& wants, int64_t total);

}  // namespace scree
