#include "crypto/sha256.h"

#include "crypto/openssl.h"
#include "shared/base/check.h"

namespace scree {

Digest sha256(std::span<const uint8_t> bytes) {
  Digest digest;
  CHECK(EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(), nullptr) == 1);
  return digest;
}

}  // namespace scree
