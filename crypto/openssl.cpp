#include "crypto/openssl.h"

#include <array>
#include <openssl/err.h>

#include "shared/base/check.h"

namespace scree {

std::string pop_openssl_error() {
  const unsigned long first = ERR_get_error();
  ERR_clear_error();
  const char* words = first == 0 ? nullptr : ERR_reason_error_string(first);
  return words == nullptr ? "unknown error" : words;
}

std::string fingerprint_of(const X509& certificate) {
  std::array<uint8_t, EVP_MAX_MD_SIZE> digest{};
  unsigned int bytes = 0;
  CHECK(X509_digest(&certificate, EVP_sha256(), digest.data(), &bytes) == 1);
  static constexpr char digits[] = "0123456789ABCDEF";
  std::string text;
  for (unsigned int i = 0; i < bytes; ++i) {
    if (i > 0) text += ':';
    text += digits[digest[i] >> 4U];
    text += digits[digest[i] & 15U];
  }
  return text;
}

}  // namespace scree
