// What a ban refuses: a network of addresses, a person's name, or an access token. As text, by which
// administrators, files and lists name it. Pure functions and a value.
//
// 203.0.113.9, 203.0.113.0/24, 2001:db8:1:2::/64, name:Ann%20B, token:0123456789abcdef. In a name a space is
// written as %20 and % as %25, because lines of the file are split at spaces.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "server/doors/ip_network.h"
#include "shared/base/result.h"

namespace scree {

/// Who comes.
struct BanSubject {
  std::string ip;         ///< the IP address
  std::string name{};     ///< the person's
  uint64_t token_id = 0;  ///< 0: it has none
};

class BanTarget {
 public:
  /// An IPv4 address is banned itself, also where it is written as IPv6; an IPv6 address without bits stands
  /// for its network of 64 bits, because who has one address has them all. Networks have 8 bits at least, or
  /// 16 of IPv6 (limits::ban_bits_min_v4). The error says what can be banned.
  static Result<BanTarget> read(const std::string& text);

  bool fits(const BanSubject& subject) const { return fits(subject, read_ip(subject.ip)); }
  /// The same, for many targets. `address`: the subject's, as read_ip() reads it.
  bool fits(const BanSubject& subject, const std::optional<IpAddress>& address) const;
  /// The only way to write it.
  std::string text() const;
  /// "this address", "this name" or "this token".
  const char* words() const;

 private:
  struct Name {
    std::string name;
  };
  struct Token {
    uint64_t id = 0;
  };
  using Target = std::variant<IpNetwork, Name, Token>;
  explicit BanTarget(Target target) : target_(std::move(target)) {}

  Target target_;
};

/// BanTarget::text() of what is written so.
Result<std::string> ban_key(const std::string& text);

}  // namespace scree
