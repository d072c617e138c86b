// A client as people have it, beside those that misbehave.
#pragma once

#include <memory>
#include <optional>

#include "client/cache/join_server.h"
#include "client/session/join_and_wait.h"
#include "shared/base/timing.h"
#include "tests/support/patience.h"

namespace scree {

class HonestClient {
 public:
  explicit HonestClient(uint16_t port)
      : client_(std::make_unique<ServerConnector>(ServerEndpoint{.port = port}, patience)),
        joined_(join_and_wait(client_, {protocol_version, "honest", {0.0F, 2.0F, 0.0F}, 64.0F})) {}
  bool joined() const { return joined_.has_value(); }
  /// Whether its terrain comes to have that hash.
  bool comes_to_hash(uint64_t hash) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (client_.mirror()->field().hash() != hash && std::chrono::steady_clock::now() < end)
      if (!hash_at(client_.mirror()->tick() + 1)) return false;
    return client_.mirror()->field().hash() == hash;
  }
  /// Applies all up to the tick; the hash then.
  std::optional<uint64_t> hash_at(Tick tick) {
    while (client_.mirror()->tick() < tick) {
      client_.wait(patience);
      client_.poll(steady_now_s());
      std::optional<Client::Event> event = client_.next();
      if (!event) return std::nullopt;
      for (; event; event = client_.next())
        if (std::holds_alternative<Client::Lost>(*event)) return std::nullopt;
    }
    return client_.mirror()->field().hash();
  }

 private:
  Client client_;
  tl::expected<void, ConnectionEnd> joined_;
};

}  // namespace scree
