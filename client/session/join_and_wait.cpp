#include "client/session/join_and_wait.h"

#include "shared/base/timing.h"

namespace scree {

tl::expected<void, ConnectionEnd> join_and_wait(Client& client, const HelloMessage& hello) {
  client.join(hello, steady_now_s());
  while (true) {
    client.wait(std::chrono::milliseconds(100));
    client.poll(steady_now_s());
    const std::optional<Client::Event> event = client.next();
    if (!event) continue;
    if (const auto* lost = std::get_if<Client::Lost>(&*event)) return tl::unexpected(lost->end);
    return {};
  }
}

}  // namespace scree
