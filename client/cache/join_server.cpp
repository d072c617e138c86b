#include "client/cache/join_server.h"

#include <fmt/format.h>
#include <utility>

#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

tl::expected<std::unique_ptr<Connection>, ConnectionEnd> join_server(Rejoin& rejoin,
                                                                     const ServerEndpoint& server,
                                                                     HelloMessage hello,
                                                                     std::chrono::milliseconds within) {
  Rejoin::Opening opening = rejoin.open(fmt::format("{}:{}", server.host, server.port), std::move(hello));
  return Connection::connect(server, std::move(opening.hello), within, opening.then);
}

ServerConnector::~ServerConnector() {
  if (attempt_.valid()) attempt_.wait();
}

void ServerConnector::begin(Rejoin& rejoin, const HelloMessage& hello, double /*now_s*/) {
  CHECK(!busy());
  attempt_ = std::async(std::launch::async, [this, &rejoin, hello, within = within_] {
    auto made = join_server(rejoin, server_, hello, within);
    Attempt attempt;
    if (made) {
      attempt.channel = std::move(*made);
    } else {
      attempt.end = std::move(made.error());
    }
    return attempt;
  });
}

std::optional<Connector::Attempt> ServerConnector::poll(double /*now_s*/) {
  if (!busy() || attempt_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return attempt_.get();
}

std::string ServerConnector::where() const {
  return endpoint_text(server_.host, server_.port);
}

}  // namespace scree
