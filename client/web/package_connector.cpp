// Connections of the npm package: by the socket that its JavaScript owns, whose functions socket_bridge.h
// tells.
#include <algorithm>
#include <array>
#include <string>

#include "client/library/call.h"
#include "client/library/handle.h"
#include "client/web/socket_bridge.h"

namespace scree {
namespace {

/// Whether bytes to this host stay on the machine. Names other than localhost may lead anywhere.
bool stays_here(const std::string& host) {
  constexpr std::array here{"localhost", "::1", "[::1]"};
  return host.starts_with("127.") || std::find(here.begin(), here.end(), host) != here.end();
}

}  // namespace

Result<std::unique_ptr<Connector>> make_connector(const scree_options& options) {
  const std::string host = text_of(options.host, "127.0.0.1");
  if (!text_of(options.ca_file).empty() || !text_of(options.fingerprint).empty())
    return fail("whom a WebSocket trusts is not the client's to say");
  if (!text_of(options.cache_folder).empty()) return fail("there are no folders here");
  if (options.connect_ms > 3'600'000) return fail("an attempt may take an hour at most");
  const std::string token = text_of(options.token);
  const bool open_way = (options.flags & (SCREE_TLS | SCREE_INSECURE_TOKEN)) == 0 && !stays_here(host);
  if (!token.empty() && open_way)
    return fail(
        "the token was not sent: without TLS, everybody on the way to " + host +
        " could read it. Use wss: if the server has a certificate; insecureToken sends it all the same");
  auto connector = std::make_unique<SocketConnector>(page_socket(), host);
  connector->set_token(token);
  if (options.connect_ms != 0) connector->set_patience(options.connect_ms / 1000.0);
  return connector;
}

/// What a page sends is checked where it is made (client/library/requests.cpp).
std::string fault_of(const Request& /*request*/) {
  return {};
}

}  // namespace scree
