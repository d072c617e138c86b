#include "server/net/host_log.h"

namespace scree {

void log_access(const Access& access) {
  if (!access.tls()) return;
  log_of(LogPart::net).info("TLS: the certificate's SHA-256 fingerprint is {}", access.tls()->fingerprint());
  if (access.tls()->out_of_date())
    log_of(LogPart::net).warn("TLS: the certificate has expired, or is not valid yet: clients refuse it");
}

}  // namespace scree
