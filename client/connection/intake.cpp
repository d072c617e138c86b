#include "client/connection/intake.h"

#include <fmt/format.h>

#include "proto/codec.h"

namespace scree {
namespace {

tl::unexpected<ConnectionEnd> end(const std::string& why, const std::string& refusal = {}) {
  return tl::unexpected(ConnectionEnd{{why}, refusal});
}

}  // namespace

tl::expected<std::optional<Intake::Next>, ConnectionEnd> Intake::next() {
  for (;; ++unknown_) {
    const auto bytes = reader_.next();
    if (!bytes) return end("the server's data does not follow this protocol: " + bytes.error().message);
    if (!*bytes) return std::nullopt;
    Result<ServerMessage> message = decode_server(**bytes);
    if (!message) return end("the server's data does not follow this protocol: " + message.error().message);
    if (std::holds_alternative<UnknownMessage>(*message)) continue;
    if (tl::expected<void, ConnectionEnd> fits = inspect(*message); !fits)
      return tl::unexpected(fits.error());
    return Next{std::move(*message), (*bytes)->size() + length_prefix_bytes};
  }
}

tl::expected<void, ConnectionEnd> Intake::inspect(const ServerMessage& message) {
  if (const auto* refusal = std::get_if<RefusalMessage>(&message))
    return end("the server refused: " + refusal->reason, refusal->name);
  const auto* first = std::get_if<WelcomeMessage>(&message);
  if (welcome_ && first != nullptr) return end("the server sent a second welcome");
  if (!welcome_ && first == nullptr) return end("the server did not begin with a welcome");
  if (first == nullptr) {
    sends_frames_ = sends_frames_ || std::holds_alternative<FrameMessage>(message);
    return {};
  }
  if (first->protocol != protocol_version)
    return end(fmt::format("the server speaks protocol {}, this client {}; use the same version of both",
                           first->protocol, protocol_version));
  welcome_ = *first;
  return {};
}

}  // namespace scree
