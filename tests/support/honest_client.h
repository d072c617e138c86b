// A client as people have it, beside those that misbehave.
#pragma once

#include <memory>
#include <optional>

#include "client/connection/connection.h"
#include "client/mirror/mirror.h"
#include "tests/support/patience.h"

namespace scree {

class HonestClient {
 public:
  explicit HonestClient(uint16_t port) {
    auto connected = Connection::connect({.port = port},
                                         {protocol_version, "honest", {0.0F, 2.0F, 0.0F}, 64.0F}, patience);
    if (!connected) return;
    connection_ = std::move(*connected);
    mirror_ = std::make_unique<Mirror>(connection_->welcome());
  }
  bool joined() const { return connection_ != nullptr; }
  /// Applies all up to the tick; the hash then.
  std::optional<uint64_t> hash_at(Tick tick) {
    while (mirror_->tick() < tick) {
      const auto received =
          connection_->wait(std::chrono::duration_cast<std::chrono::milliseconds>(patience));
      if (received.empty()) return std::nullopt;
      for (const Received& one : received)
        if (!mirror_->apply(one.message)) return std::nullopt;
    }
    return mirror_->field().hash();
  }

 private:
  std::unique_ptr<Connection> connection_;
  std::unique_ptr<Mirror> mirror_;
};

}  // namespace scree
