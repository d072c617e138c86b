// Connections by this machine's sockets.
#include "client/cache/join_server.h"
#include "client/library/call.h"
#include "client/library/handle.h"

namespace scree {

Result<std::unique_ptr<Connector>> make_connector(const scree_options& options) {
  const std::chrono::milliseconds within(options.connect_ms == 0 ? limits::connect_ms_max
                                                                 : static_cast<int>(options.connect_ms));
  if (options.connect_ms > 3'600'000) return fail("an attempt may take an hour at most");
  ServerEndpoint server;
  server.host = text_of(options.host, "127.0.0.1");
  if (options.port != 0) server.port = static_cast<uint16_t>(options.port);
  server.tls = (options.flags & SCREE_TLS) != 0;
  server.trust = {text_of(options.ca_file), text_of(options.fingerprint)};
  if (!server.tls && !(server.trust.ca_path.empty() && server.trust.fingerprint.empty()))
    return fail("a file of authorities or a fingerprint needs SCREE_TLS");
  server.token = text_of(options.token);
  server.insecure_token = (options.flags & SCREE_INSECURE_TOKEN) != 0;
  return std::make_unique<ServerConnector>(std::move(server), within);
}

}  // namespace scree
