// Who may come in, by address: how many connections an address holds, how fast it opens new ones, how often
// it has guessed at a token. No sockets; time is an argument (seconds). Not thread-safe.
//
// An address is a whole IPv4 address, or the first 64 bits of an IPv6 one, which is what one customer is
// given. The /56 and the /48 around that one are bounded, too, as several addresses are (wide_networks()):
// one customer may be given as much. This machine's own addresses may hold and open as many connections as
// they like: who can run programs here needs no network to do harm. Guesses at tokens are slowed down from
// everywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/command/refusal.h"
#include "server/doors/limits.h"
#include "shared/base/rate_limit.h"

namespace scree {

/// A text as of asio::ip::address; any text that is none is an address of its own.
std::string door_address(const std::string& ip);
/// Whether that is this machine's own address.
bool is_loopback_address(const std::string& ip);

/// The same for a client for whom a proxy speaks. Nobody behind a proxy is on this machine.
std::string relayed_address(const std::string& ip);

class Door {
 public:
  struct Rules {
    size_t connections_max = 0;  ///< of one address
    double connects_per_second = 0.0;
    double connects_burst = 1.0;
    bool loopback_is_free = true;
    double requests_per_second = limits::http_requests_per_second_max;
    double requests_burst = limits::http_requests_burst_max;
    /// Strangers may come by loopback, too: then it is not free, and holds no more connections than others.
    /// It opens them as fast as it likes, because a proxy there opens one for each file of a page.
    bool loopback_is_shared = false;
  };

  explicit Door(const Rules& rules) : rules_(rules) {}

  /// A connection has come. With a reason it is not let in, and not to be given back.
  std::optional<Refusal> enter(const std::string& address, double now_s);
  /// A connection of a trusted proxy has come, who speaks for many: no bound holds.
  void enter_unbounded(const std::string& address, double now_s);
  /// A connection that was let in turns out to be of another address, and needs a place there; that it came
  /// is not counted again. With a reason it has none, and stays where it was.
  std::optional<Refusal> move(const std::string& from, const std::string& to, double now_s);
  /// A connection that was let in has ended.
  void leave(const std::string& address, double now_s);

  /// Whether the address may be answered an HTTP request now; it is counted.
  bool may_request(const std::string& address, double now_s);

  /// Seconds until this address may present a token again; 0: now.
  double wait_for_guess_s(const std::string& address, double now_s) const;
  /// The address has presented this wrong token: it waits for limits::guess_wait_min_s, twice as long after
  /// each further one, at most limits::guess_wait_max_s.
  void guessed_wrong(const std::string& address, const std::string& token, double now_s);

  /// Whether this token is one of the last wrong ones from there (limits::wrong_tokens_known). To present it
  /// again teaches nobody anything, so it costs no wait: a program that comes with an old token over and over
  /// does not keep out the person beside it who has the right one.
  bool knows_as_wrong(const std::string& address, const std::string& token) const;

  /// Whether the address is this machine's own, and the rules except it.
  bool is_free(const std::string& address) const;
  /// From now on strangers come by this machine's own address (Rules::loopback_is_shared).
  void share_loopback() { rules_.loopback_is_shared = true; }
  size_t addresses() const { return visitors_.size(); }

 private:
  struct Visitor {
    size_t connections = 0;
    RateLimit connects;
    RateLimit requests;
    uint32_t wrong_guesses = 0;
    std::vector<size_t> wrong_tokens{};  ///< hashes
    double guess_after_s = 0.0;
    double seen_s = 0.0;
  };
  /// `addresses`: for how many addresses it stands.
  Visitor& visitor(const std::string& address, double now_s, size_t addresses = 1);
  void forget_the_gone(double now_s);

  Rules rules_;
  std::unordered_map<std::string, Visitor> visitors_;
};

}  // namespace scree
