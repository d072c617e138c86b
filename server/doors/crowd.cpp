#include "server/doors/crowd.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "server/doors/ip_network.h"
#include "server/doors/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Bits of the networks, and how many addresses each may stand for.
struct Level {
  unsigned bits;
  size_t addresses;
};
constexpr std::array<Level, 3> levels = {
    {{64, 1}, {56, limits::addresses_of_a_site}, {48, limits::addresses_of_a_provider}}};

/// Nothing: the door's address is none of IPv6.
std::optional<IpAddress> v6_of(const std::string& address) {
  if (!address.ends_with("/64")) return std::nullopt;
  const auto ip = read_ip(std::string_view(address).substr(0, address.size() - 3));
  return ip && !ip->is_v4 ? ip : std::nullopt;
}

uint64_t first_bits(const IpAddress& address, unsigned bits) {
  uint64_t number = 0;
  for (size_t i = 0; i < sizeof(number); ++i) number = number << 8U | address.bytes[i];
  return number >> (64 - bits);
}

}  // namespace

Origin::Origin(const std::string& address) {
  const auto ip = v6_of(address);
  if (!ip) {
    networks_[0] = std::hash<std::string>()(address);
    levels_ = 1;
    return;
  }
  for (const Level& level : levels) networks_[levels_++] = first_bits(*ip, level.bits);
}

std::array<WideNetwork, 2> wide_networks(const std::string& address) {
  std::array<WideNetwork, 2> wide;
  const auto ip = v6_of(address);
  if (!ip) return wide;
  for (size_t i = 0; i < wide.size(); ++i)
    wide[i] = {network_of(*ip, levels[i + 1].bits).text(), levels[i + 1].addresses};
  return wide;
}

void Crowd::add(const Origin& origin) {
  for (size_t i = 0; i < origin.levels_; ++i) ++held_[i][origin.networks_[i]];
}

void Crowd::remove(const Origin& origin) {
  for (size_t i = 0; i < origin.levels_; ++i) {
    const auto held = held_[i].find(origin.networks_[i]);
    CHECK(held != held_[i].end());
    if (--held->second == 0) held_[i].erase(held);
  }
}

size_t Crowd::weight(const Origin& origin) const {
  size_t weight = 0;
  for (size_t i = 0; i < origin.levels_; ++i) {
    const auto held = held_[i].find(origin.networks_[i]);
    if (held == held_[i].end()) break;
    weight = std::max(weight, (held->second + levels[i].addresses - 1) / levels[i].addresses);
  }
  return weight;
}

}  // namespace scree
