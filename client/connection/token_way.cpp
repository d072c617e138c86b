#include "client/connection/token_way.h"

#include <asio/ip/address.hpp>
#include <fmt/format.h>

namespace scree {

namespace {

bool is_this_machine(const std::string& ip) {
  asio::error_code error;
  const asio::ip::address address = asio::ip::make_address(ip, error);
  if (error) return false;
  if (!address.is_v6() || !address.to_v6().is_v4_mapped()) return address.is_loopback();
  return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).is_loopback();
}

}  // namespace

std::optional<std::string> fault_of_way(const ServerEndpoint& server, const std::string& ip) {
  if (server.token.empty() || server.tls || server.insecure_token || is_this_machine(ip)) return std::nullopt;
  return fmt::format(
      "the token was not sent: without TLS, everybody on the way to {} could read it. Use --tls if the "
      "server "
      "has a certificate; --insecure-token sends the token all the same",
      ip);
}

}  // namespace scree
