// Who holds how many of what is short, so that the one with the most makes room first: by address and, for
// IPv6, by the wider networks that one customer may be given (RFC 6177 names /56 and /48). By more addresses
// of one network nobody gets more than a few customers do. No sockets. Not thread-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>

namespace scree {

/// Where a connection is from: a value to compare and to count by.
class Origin {
 public:
  Origin() = default;
  /// `address`: as of Door.
  explicit Origin(const std::string& address);

  bool operator==(const Origin&) const = default;

 private:
  friend class Crowd;
  /// The networks around it: an IPv6 address has three of 64, 56 and 48 bits, any other one itself alone.
  std::array<uint64_t, 3> networks_{};
  size_t levels_ = 0;
};

/// The networks of IPv6 that are wider than a door's address ("2001:db8:1:2::/64"), as texts, and how many
/// addresses each may stand for; none for any other address.
struct WideNetwork {
  std::string text;
  size_t addresses = 1;
};
std::array<WideNetwork, 2> wide_networks(const std::string& address);

class Crowd {
 public:
  void add(const Origin& origin);
  /// One from there must have been added.
  void remove(const Origin& origin);

  /// How many the address holds, or what one of the networks around it holds for each address that it may
  /// stand for, rounded up: the most of these.
  size_t weight(const Origin& origin) const;

 private:
  std::array<std::unordered_map<uint64_t, size_t>, 3> held_;
};

}  // namespace scree
