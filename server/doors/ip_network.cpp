#include "server/doors/ip_network.h"

#include <asio/ip/address.hpp>
#include <charconv>
#include <fmt/format.h>

namespace scree {

namespace {

constexpr unsigned v4_at = bits_of_v6 - bits_of_v4;  ///< where the bits of an IPv4 address begin

std::optional<unsigned> read_bits(std::string_view text, unsigned least, unsigned most) {
  unsigned bits = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bits);
  if (error != std::errc() || end != text.data() + text.size() || bits < least || bits > most)
    return std::nullopt;
  return bits;
}

/// The byte's bits that belong to a network of so many bits.
uint8_t mask_of(size_t byte, unsigned bits) {
  const unsigned before = static_cast<unsigned>(byte) * 8;
  if (bits >= before + 8) return 0xFF;
  return bits <= before ? uint8_t{0} : static_cast<uint8_t>(0xFF00U >> (bits - before));
}

}  // namespace

std::optional<IpAddress> read_ip(std::string_view text) {
  asio::error_code error;
  const asio::ip::address address = asio::ip::make_address(text, error);
  if (error) return std::nullopt;
  if (address.is_v4())
    return IpAddress{asio::ip::make_address_v6(asio::ip::v4_mapped, address.to_v4()).to_bytes(), true};
  return IpAddress{address.to_v6().to_bytes(), address.to_v6().is_v4_mapped()};
}

bool is_loopback(const IpAddress& address) {
  const asio::ip::address_v6 v6(address.bytes);
  return address.is_v4 ? asio::ip::make_address_v4(asio::ip::v4_mapped, v6).is_loopback() : v6.is_loopback();
}

bool IpNetwork::holds(const IpAddress& address) const {
  if (address.is_v4 != first.is_v4) return false;
  for (size_t i = 0; i < address.bytes.size(); ++i)
    if ((address.bytes[i] & mask_of(i, bits)) != first.bytes[i]) return false;
  return true;
}

std::string IpNetwork::text() const {
  const asio::ip::address_v6 v6(first.bytes);
  if (!first.is_v4)
    return v6.is_loopback() && bits == bits_of_v6 ? v6.to_string()
                                                  : fmt::format("{}/{}", v6.to_string(), bits);
  const std::string v4 = asio::ip::make_address_v4(asio::ip::v4_mapped, v6).to_string();
  return bits == bits_of_v6 ? v4 : fmt::format("{}/{}", v4, bits - v4_at);
}

IpNetwork network_of(const IpAddress& address, unsigned bits) {
  IpNetwork network{address, bits};
  for (size_t i = 0; i < network.first.bytes.size(); ++i) network.first.bytes[i] &= mask_of(i, bits);
  return network;
}

Result<IpNetwork> read_network(const std::string& text, BitsMin min) {
  const size_t slash = text.find('/');
  const std::string written = text.substr(0, slash);
  const auto address = read_ip(written);
  if (!address) return fail(fmt::format("'{}' is not an IPv4 or IPv6 address", written));
  if (slash == std::string::npos) return network_of(*address, bits_of_v6);
  // An IPv4 address that is written as IPv6 has its bits counted as such.
  const bool as_v6 = written.find(':') != std::string::npos;
  const unsigned least = !address->is_v4 ? min.v6 : as_v6 ? v4_at + min.v4 : min.v4;
  const unsigned most = as_v6 ? bits_of_v6 : bits_of_v4;
  const auto bits = read_bits(std::string_view(text).substr(slash + 1), least, most);
  if (!bits)
    return fail(
        fmt::format("'{}' is not a network: it has {} to {} bits behind the slash", text, least, most));
  return network_of(*address, as_v6 ? *bits : v4_at + *bits);
}

Result<std::vector<IpNetwork>> read_networks(std::span<const std::string> texts) {
  std::vector<IpNetwork> networks;
  for (const std::string& text : texts) networks.push_back(TRY(read_network(text)));
  return networks;
}

bool any_holds(std::span<const IpNetwork> networks, std::string_view ip) {
  if (networks.empty()) return false;
  const auto address = read_ip(ip);
  return address &&
         std::ranges::any_of(networks, [&](const IpNetwork& network) { return network.holds(*address); });
}

}  // namespace scree
