// IP addresses, and networks of them, as operators write them. Values.
//
// IPv4 is a kind of its own, also where an address of it is written as IPv6 (RFC 4291, 2.5.5.2): a network of
// IPv6 holds no IPv4 address, however few its bits are.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/result.h"

namespace scree {

struct IpAddress {
  std::array<uint8_t, 16> bytes{};  ///< IPv4 as IPv6 has it
  bool is_v4 = false;
};

/// Nothing: the text is no address.
std::optional<IpAddress> read_ip(std::string_view text);
bool is_loopback(const IpAddress& address);

struct IpNetwork {
  IpAddress first;    ///< 0 behind the bits
  unsigned bits = 0;  ///< of the address's bytes: those of IPv4 begin behind the 96th

  bool holds(const IpAddress& address) const;
  /// "203.0.113.0/24"; a single IPv4 address, and ::1, without bits.
  std::string text() const;
};

inline constexpr unsigned bits_of_v4 = 32, bits_of_v6 = 128;

/// `bits`: of its bytes.
IpNetwork network_of(const IpAddress& address, unsigned bits);

/// Bits that a network must have, by its kind.
struct BitsMin {
  unsigned v4 = 0, v6 = 0;
};

/// ADDRESS/BITS; an address alone is a network of itself. The error names the bits that there may be.
Result<IpNetwork> read_network(const std::string& text, BitsMin min = {});
Result<std::vector<IpNetwork>> read_networks(std::span<const std::string> texts);
/// Whether one of them holds the address; not where the text is no address.
bool any_holds(std::span<const IpNetwork> networks, std::string_view ip);

}  // namespace scree
