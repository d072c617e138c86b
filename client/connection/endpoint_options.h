// The options by which every client is told its server.
#pragma once

#include <string>
#include <vector>

#include "client/connection/endpoint.h"
#include "shared/base/result.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace scree {

/// How a program is told where its server is. host_and_port: by --host, --port and the environment, for those
/// that always have one. or_socket: by these or --socket, for those of administrators. server: by --server
/// HOST[:PORT] alone, for those that may do without.
enum class EndpointNaming { host_and_port, or_socket, server };

/// Declares --host, --port, --tls and so on, with their names in the environment; the token's is the
/// caller's, and its file's is that with _FILE. Outlives the parsing.
class EndpointOptions {
 public:
  EndpointOptions(CLI::App& app, ServerEndpoint& endpoint,
                  const std::string& token_environment = "SCREE_TOKEN",
                  EndpointNaming naming = EndpointNaming::host_and_port);
  EndpointOptions(const EndpointOptions&) = delete;
  EndpointOptions& operator=(const EndpointOptions&) = delete;

  /// After the parsing: reads the token's file and the link, and understands what to trust as a wish for TLS.
  /// A socket makes all of these superfluous: with --socket, variables for them are ignored; the variable
  /// SCREE_ADMIN_SOCKET counts where nothing says host, port, TLS or token.
  Result<void> complete();
  /// Before complete(): what needs no token reads none, and is not refused for a file of it that is not
  /// there.
  void drop_token();
  /// Whether there was a --server.
  bool names_server() const { return !server_.empty(); }

 private:
  void declare_socket(CLI::App& app);
  Result<void> parse_server();
  Result<void> check_host() const;
  Result<void> choose_socket();

  ServerEndpoint& endpoint_;
  std::vector<const CLI::Option*> of_network_;  ///< that a socket has no use for; empty: there is no --socket
  std::string server_;
  std::string token_path_;
  std::string link_;
};

}  // namespace scree
