#include "server/doors/proxies.h"

#include <asio/ip/address.hpp>

namespace scree {

namespace {

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
  proxies.networks_ = TRY(read_networks(networks));
  return proxies;
}

bool Proxies::contains(std::string_view ip) const {
  return any_holds(networks_, ip);
}

std::string Proxies::client_of(std::string_view forwarded_for, const std::string& sender) const {
  std::string client = sender;
  while (!forwarded_for.empty() && contains(client)) {
    const size_t comma = forwarded_for.rfind(',');
    const std::string_view entry = trimmed(forwarded_for.substr(comma == forwarded_for.npos ? 0 : comma + 1));
    forwarded_for = forwarded_for.substr(0, comma == forwarded_for.npos ? 0 : comma);
    asio::error_code error;
    const auto address = asio::ip::make_address(without_port(entry), error);
    if (error) break;
    client = address.to_string();
  }
  return client;
}

}  // namespace scree
