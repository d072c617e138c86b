#include "server/doors/ban_target.h"

#include <fmt/format.h>

#include "auth/access_token.h"
#include "proto/limits.h"
#include "server/doors/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/small_letters.h"
#include "shared/base/text.h"

namespace scree {

namespace {

constexpr std::string_view name_prefix = "name:", token_prefix = "token:";
constexpr unsigned usual_bits_of_v6 = 64;

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

Result<IpNetwork> read_banned(const std::string& text) {
  const size_t slash = text.find('/');
  const auto address = read_ip(std::string_view(text).substr(0, slash));
  if (!address)
    return fail(fmt::format(
        "'{}' is not an IPv4 or IPv6 address, a network such as 203.0.113.0/24, name:NAME or token:ID",
        text));
  if (slash == std::string::npos && !address->is_v4 && !is_loopback(*address))
    return network_of(*address, usual_bits_of_v6);
  return read_network(text, {limits::ban_bits_min_v4, limits::ban_bits_min_v6});
}

}  // namespace

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
  return BanTarget(TRY(read_banned(text)));
}

bool BanTarget::fits(const BanSubject& subject, const std::optional<IpAddress>& address) const {
  return std::visit(
      Overloaded{
          [&](const IpNetwork& network) { return address && network.holds(*address); },
          [&](const Name& name) { return in_small_letters(name.name) == in_small_letters(subject.name); },
          [&](const Token& token) { return subject.token_id != 0 && token.id == subject.token_id; }},
      target_);
}

std::string BanTarget::text() const {
  return std::visit(
      Overloaded{[](const IpNetwork& network) { return network.text(); },
                 [](const Name& name) { return std::string(name_prefix) + escaped(name.name); },
                 [](const Token& token) { return std::string(token_prefix) + id_text(token.id); }},
      target_);
}

const char* BanTarget::words() const {
  return std::visit(
      Overloaded{[](const IpNetwork&) { return "this address"; }, [](const Name&) { return "this name"; },
                 [](const Token&) { return "this token"; }},
      target_);
}

Result<std::string> ban_key(const std::string& text) {
  const auto target = TRY(BanTarget::read(text));
  return target.text();
}

}  // namespace scree
