// The server's end of a WebSocket over another stream, behind its opening handshake.
#pragma once

#include "transport/layered_transport.h"
#include "transport/websocket_engine.h"

namespace scree {

class WebSocketTransport final : public LayeredTransport {
 public:
  /// As of WebSocketEngine, and LayeredTransport.
  WebSocketTransport(std::shared_ptr<Transport> below, uint64_t frame_bytes_max,
                     std::span<const uint8_t> arrived)
      : LayeredTransport(std::move(below), std::make_unique<WebSocketEngine>(frame_bytes_max), arrived) {}
};

}  // namespace scree
