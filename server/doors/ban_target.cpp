#include "server/doors/ban_target.h"

#include <algorithm>
#include <asio/ip/address.hpp>
#include <charconv>
#include <fmt/format.h>
#include <optional>

#include "auth/access_token.h"
#include "proto/limits.h"
#include "server/doors/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/text.h"

namespace scree {

namespace {

constexpr std::string_view name_prefix = "name:", token_prefix = "token:";
constexpr unsigned v4_at = 96;  ///< bits before an IPv4 address that is written as IPv6
constexpr unsigned bits_of_v4 = 32, bits_of_v6 = 128, usual_bits_of_v6 = 64;

std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) text += c == ' ' ? "%20" : c == '%' ? "%25" : std::string(1, c);
  return text;
}

std::string unescaped(std::string_view text) {
  std::string name;
  for (size_t i = 0; i < text.size(); ++i) {
    const std::string_view code = text.substr(i, 3);
    if (code == "%20" || code == "%25") i += 2;
    name += code == "%20" ? ' ' : text[i - (code == "%25" ? 2 : 0)];
  }
  return name;
}

/// Both kinds of addresses as 16 bytes.
std::array<uint8_t, 16> bytes_of(const asio::ip::address& address) {
  const asio::ip::address_v6 v6 =
      address.is_v4() ? asio::ip::make_address_v6(asio::ip::v4_mapped, address.to_v4()) : address.to_v6();
  return v6.to_bytes();
}

std::optional<unsigned> read_bits(const std::string& text, unsigned least, unsigned most) {
  unsigned bits = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bits);
  if (error != std::errc() || end != text.data() + text.size() || bits < least || bits > most)
    return std::nullopt;
  return bits;
}

bool same_bits(const std::array<uint8_t, 16>& a, const std::array<uint8_t, 16>& b, unsigned bits) {
  for (unsigned i = 0; i < bits; ++i)
    if (((a[i / 8] ^ b[i / 8]) & (0x80U >> (i % 8))) != 0) return false;
  return true;
}

}  // namespace

Result<BanTarget::Network> BanTarget::read_network(const std::string& text) {
  const size_t slash = text.find('/');
  asio::error_code error;
  const asio::ip::address address = asio::ip::make_address(text.substr(0, slash), error);
  if (error)
    return fail(fmt::format(
        "'{}' is not an IPv4 or IPv6 address, a network such as 203.0.113.0/24, name:NAME or token:ID",
        text));
  const bool is_mapped = address.is_v6() && address.to_v6().is_v4_mapped();
  Network network{bytes_of(address), 0, address.is_v4() || is_mapped};
  const bool of_v4 = address.is_v4();
  const unsigned most = of_v4 ? bits_of_v4 : bits_of_v6;
  unsigned bits = of_v4 || is_mapped || address.is_loopback() ? most : usual_bits_of_v6;
  if (slash != std::string::npos) {
    const unsigned least = of_v4           ? limits::ban_bits_min_v4
                           : network.is_v4 ? v4_at + limits::ban_bits_min_v4
                                           : limits::ban_bits_min_v6;
    const auto read = read_bits(text.substr(slash + 1), least, most);
    if (!read)
      return fail(
          fmt::format("'{}' is not a network: it has {} to {} bits behind the slash", text, least, most));
    bits = *read;
  }
  network.bits = of_v4 ? v4_at + bits : bits;
  for (unsigned i = network.bits; i < bits_of_v6; ++i)
    network.bytes[i / 8] &= static_cast<uint8_t>(~(0x80U >> (i % 8)));
  return network;
}

Result<BanTarget> BanTarget::read(const std::string& text) {
  if (text.starts_with(name_prefix)) {
    const std::string name = unescaped(std::string_view(text).substr(name_prefix.size()));
    if (name.empty() || name.size() > limits::person_name_bytes_max || fault_of_text(name) ||
        escaped(name).size() + name_prefix.size() > limits::address_bytes_max)
      return fail(fmt::format("'{}' is not a name: a name has 1 to {} bytes, all of which can be shown", text,
                              limits::person_name_bytes_max));
    return BanTarget(Name{name});
  }
  if (text.starts_with(token_prefix)) {
    const auto id = read_id(text.substr(token_prefix.size()));
    if (!id) return fail(fmt::format("'{}' is not the id of a token: an id has 16 hex digits", text));
    return BanTarget(Token{*id});
  }
  return BanTarget(TRY(read_network(text)));
}

bool BanTarget::fits(const BanSubject& subject) const {
  return std::visit(
      Overloaded{[&](const Network& network) {
                   asio::error_code error;
                   const auto address = asio::ip::make_address(subject.ip, error);
                   return !error && same_bits(bytes_of(address), network.bytes, network.bits);
                 },
                 [&](const Name& name) { return name.name == subject.name; },
                 [&](const Token& token) { return subject.token_id != 0 && token.id == subject.token_id; }},
      target_);
}

std::string BanTarget::text() const {
  return std::visit(
      Overloaded{[](const Network& network) {
                   const asio::ip::address_v6 v6(network.bytes);
                   const unsigned bits = network.is_v4 ? network.bits - v4_at : network.bits;
                   if (network.is_v4) {
                     const std::string v4 = asio::ip::make_address_v4(asio::ip::v4_mapped, v6).to_string();
                     return bits == bits_of_v4 ? v4 : v4 + "/" + std::to_string(bits);
                   }
                   return v6.is_loopback() && bits == bits_of_v6
                              ? v6.to_string()
                              : v6.to_string() + "/" + std::to_string(bits);
                 },
                 [](const Name& name) { return std::string(name_prefix) + escaped(name.name); },
                 [](const Token& token) { return std::string(token_prefix) + id_text(token.id); }},
      target_);
}

const char* BanTarget::words() const {
  return std::visit(
      Overloaded{[](const Network&) { return "this address"; }, [](const Name&) { return "this name"; },
                 [](const Token&) { return "this token"; }},
      target_);
}

Result<std::string> ban_key(const std::string& text) {
  const auto target = TRY(BanTarget::read(text));
  return target.text();
}

}  // namespace scree
