// TLS over another stream.
#pragma once

#include "crypto/tls_engine.h"
#include "transport/layered_transport.h"

namespace scree {

class TlsTransport final : public LayeredTransport {
 public:
  TlsTransport(std::shared_ptr<Transport> below, TlsEngine engine, std::span<const uint8_t> arrived = {})
      : LayeredTransport(std::move(below), std::make_unique<TlsEngine>(std::move(engine)), arrived) {}
  bool encrypted() const override { return true; }
};

}  // namespace scree
