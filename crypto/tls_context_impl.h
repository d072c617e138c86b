// What the contexts hold, for the engine. Internal to crypto/.
#pragma once

#include "crypto/openssl.h"
#include "crypto/tls_context.h"

namespace scree {

struct TlsServerContext::Impl {
  OwnedContext context;
};

struct TlsClientContext::Impl {
  OwnedContext context;
  std::string fingerprint;  ///< as fingerprint_of() writes it; empty: authorities are trusted
};

}  // namespace scree
