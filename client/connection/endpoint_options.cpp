#include "client/connection/endpoint_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

#include "proto/limits.h"
#include "shared/base/option_check.h"
#include "shared/base/token.h"

namespace scree {

namespace {

constexpr NumberWithin ports{1, 65535, true};
constexpr const char* socket_variable = "SCREE_ADMIN_SOCKET";

/// CLI11 does not keep whether a value comes from the environment: where the variable is set, it may.
bool is_surely_a_flag(const CLI::Option& option) {
  return option.count() > 0 && std::getenv(option.get_envname().c_str()) == nullptr;
}

void declare_host_and_port(CLI::App& app, ServerEndpoint& endpoint) {
  app.add_option("--host", endpoint.host, "name or address of the server")
      ->envname("SCREE_HOST")
      ->capture_default_str();
  bounded(app.add_option("--port", endpoint.port, "TCP port of the server"), ports)
      ->envname("SCREE_PORT")
      ->capture_default_str();
}

}  // namespace

EndpointOptions::EndpointOptions(CLI::App& app, ServerEndpoint& endpoint,
                                 const std::string& token_environment, EndpointNaming naming)
    : endpoint_(endpoint) {
  if (naming == EndpointNaming::server)
    app.add_option(
        "--server", server_,
        fmt::format("HOST[:PORT] of a server, [ADDRESS]:PORT with an IPv6 address; default port: {}",
                    default_port));
  else
    declare_host_and_port(app, endpoint);
  app.add_flag("--tls", endpoint.tls,
               "encrypt the connection; the server's certificate must be for its name, and from an authority "
               "that this system trusts")
      ->envname("SCREE_TLS");
  CLI::Option* ca = app.add_option("--tls-ca", endpoint.trust.ca_path,
                                   "PEM file of the certificates to trust instead; implies --tls")
                        ->envname("SCREE_TLS_CA");
  app.add_option("--tls-fingerprint", endpoint.trust.fingerprint,
                 "SHA-256 fingerprint of the only certificate to trust, as the server logs it; implies --tls")
      ->envname("SCREE_TLS_FINGERPRINT")
      ->excludes(ca);
  CLI::Option* token = app.add_option("--token", endpoint.token,
                                      "access token, or the server's admin token; --token-file is safer, "
                                      "because other users can see command lines")
                           ->envname(token_environment);
  app.add_option("--token-file", token_path_, "file whose first line is the token")
      ->envname(token_environment + "_FILE")
      ->excludes(token);
  app.add_flag("--insecure-token", endpoint.insecure_token,
               "send the token without TLS to other machines, too, where everybody on its way can read it")
      ->envname("SCREE_INSECURE_TOKEN");
  app.add_option("--link", link_,
                 "simulate a slow link: delay=50ms,jitter=20ms,rate=1Mbit,buffer=16kB,seed=1 (buffer: that "
                 "of the bottleneck). cut=100000 ends each connection after so many bytes; after "
                 "half-open=50kB nothing passes. down. and up. choose one direction: down.rate=100kbit")
      ->envname("SCREE_LINK");
  if (naming == EndpointNaming::or_socket) declare_socket(app);
}

void EndpointOptions::declare_socket(CLI::App& app) {
  for (const char* name : {"--host", "--port", "--tls", "--tls-ca", "--tls-fingerprint", "--token",
                           "--token-file", "--insecure-token"})
    of_network_.push_back(app.get_option(name));
  app.add_option(
         "--socket", endpoint_.socket,
         fmt::format("file of the server's --admin-socket, instead of host, port and token (variable: {})",
                     socket_variable))
      ->check([](const std::string& file) { return std::string(file.empty() ? "no file is named" : ""); });
}

Result<void> EndpointOptions::choose_socket() {
  if (of_network_.empty()) return {};
  const char* const told = std::getenv(socket_variable);
  const bool is_free =
      std::ranges::none_of(of_network_, [](const auto* option) { return option->count() > 0; });
  if (endpoint_.socket.empty() && told != nullptr && is_free) endpoint_.socket = told;
  if (endpoint_.socket.empty()) return {};
  const auto beside =
      std::ranges::find_if(of_network_, [](const auto* option) { return is_surely_a_flag(*option); });
  if (beside != of_network_.end())
    return fail(fmt::format("--socket has no use for {}: it is on this machine, and its owner needs no token",
                            (*beside)->get_name()));
  endpoint_.tls = false;
  endpoint_.trust = {};
  drop_token();
  return {};
}

/// A colon divides host and port, unless it is one of several without brackets: an IPv6 address alone.
Result<void> EndpointOptions::parse_server() {
  const size_t colon = server_.rfind(':');
  const bool bracketed = server_.starts_with('[');
  const bool has_port = colon != std::string::npos &&
                        (bracketed ? server_.find("]:") + 1 == colon : server_.find(':') == colon);
  std::string host = has_port ? server_.substr(0, colon) : server_;
  if (bracketed) {
    if (!host.ends_with(']')) return fail(fmt::format("--server: '{}' has no ] after the address", server_));
    host = host.substr(1, host.size() - 2);
  }
  if (host.empty()) return fail(fmt::format("--server: '{}' names no host", server_));
  endpoint_.host = host;
  if (!has_port) return {};
  const std::string port = server_.substr(colon + 1);
  if (const std::string wrong = ports(port); !wrong.empty())
    return fail(fmt::format("--server: the port of '{}': {}", server_, wrong));
  endpoint_.port = static_cast<uint16_t>(std::stod(port));
  return {};
}

/// One colon is none of an IPv6 address.
Result<void> EndpointOptions::check_host() const {
  const std::string& host = endpoint_.host;
  const size_t colon = host.find(':');
  if (colon == std::string::npos || host.find(':', colon + 1) != std::string::npos) return {};
  return fail(fmt::format("--host: '{}' has a port in it: --host {} --port {}", host, host.substr(0, colon),
                          host.substr(colon + 1)));
}

void EndpointOptions::drop_token() {
  token_path_.clear();
  endpoint_.token.clear();
}

Result<void> EndpointOptions::complete() {
  TRY(choose_socket());
  if (names_server()) TRY(parse_server());
  TRY(check_host());
  endpoint_.tls = endpoint_.tls || !endpoint_.trust.ca_path.empty() || !endpoint_.trust.fingerprint.empty();
  if (!link_.empty()) {
    const auto link = read_link(link_);
    if (!link) return fail("--link: " + link.error().message);
    endpoint_.link = *link;
  }
  if (!token_path_.empty()) {
    auto token = TRY(read_secret(token_path_, limits::access_token_bytes_max));
    if (token.empty())
      return fail(fmt::format("--token-file: {} has no token in its first line", token_path_));
    endpoint_.token = std::move(token);
  }
  if (endpoint_.token.empty()) return {};
  return check_secret(endpoint_.token, limits::access_token_bytes_max);
}

}  // namespace scree
