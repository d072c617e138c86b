#include "server/doors/proxies.h"

#include <algorithm>
#include <asio/ip/address.hpp>
#include <charconv>
#include <optional>

namespace scree {

namespace {

constexpr unsigned v4_bits = 32;
constexpr unsigned v6_bits = 128;

std::optional<asio::ip::address> address_of(std::string_view text) {
  asio::error_code error;
  const auto address = asio::ip::make_address(text, error);
  return error ? std::nullopt : std::optional(address);
}

asio::ip::address_v6::bytes_type wide_bytes(const asio::ip::address& address) {
  return address.is_v6() ? address.to_v6().to_bytes()
                         : asio::ip::make_address_v6(asio::ip::v4_mapped, address.to_v4()).to_bytes();
}

std::optional<unsigned> number_of(std::string_view text) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string_view trimmed(std::string_view text) {
  const size_t from = text.find_first_not_of(" \t");
  if (from == text.npos) return {};
  return text.substr(from, text.find_last_not_of(" \t") - from + 1);
}

/// "192.0.2.7", "192.0.2.7:50000", "2001:db8::1", "[2001:db8::1]:50000": what proxies write.
std::string_view without_port(std::string_view entry) {
  if (entry.starts_with('[')) return entry.substr(1, entry.find(']') - 1);
  const size_t colon = entry.find(':');
  const bool has_port = colon != entry.npos && entry.find(':', colon + 1) == entry.npos;
  return has_port ? entry.substr(0, colon) : entry;
}

}  // namespace

Result<Proxies> Proxies::parse(const std::vector<std::string>& networks) {
  Proxies proxies;
  for (const std::string& text : networks) {
    const size_t slash = text.find('/');
    const auto address = address_of(std::string_view(text).substr(0, slash));
    if (!address) return fail("'" + text + "' is no address of a proxy: ADDRESS or ADDRESS/BITS");
    const unsigned most = address->is_v4() ? v4_bits : v6_bits;
    const auto bits = slash == text.npos ? most : number_of(std::string_view(text).substr(slash + 1));
    if (!bits || *bits > most)
      return fail("'" + text + "': a network of this kind has 0 to " + std::to_string(most) + " bits");
    proxies.networks_.push_back({wide_bytes(*address), *bits + v6_bits - most});
  }
  return proxies;
}

bool Proxies::contains(std::string_view ip) const {
  if (networks_.empty()) return false;
  const auto address = address_of(ip);
  if (!address) return false;
  const Bytes bytes = wide_bytes(*address);
  return std::ranges::any_of(networks_, [&](const Network& network) {
    const size_t whole = network.bits / 8;
    if (!std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(whole),
                    network.address.begin()))
      return false;
    const auto rest = static_cast<uint8_t>(0xFF00U >> (network.bits % 8));
    return network.bits % 8 == 0 || ((bytes[whole] ^ network.address[whole]) & rest) == 0;
  });
}

std::string Proxies::client_of(std::string_view forwarded_for, const std::string& sender) const {
  std::string client = sender;
  while (!forwarded_for.empty() && contains(client)) {
    const size_t comma = forwarded_for.rfind(',');
    const std::string_view entry = trimmed(forwarded_for.substr(comma == forwarded_for.npos ? 0 : comma + 1));
    forwarded_for = forwarded_for.substr(0, comma == forwarded_for.npos ? 0 : comma);
    const auto address = address_of(without_port(entry));
    if (!address) break;
    client = address->to_string();
  }
  return client;
}

}  // namespace scree
