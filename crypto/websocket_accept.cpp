#include "crypto/websocket_accept.h"

#include <array>

#include "crypto/openssl.h"
#include "shared/base/check.h"

namespace scree {

std::string websocket_accept(std::string_view key) {
  constexpr std::string_view fixed = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
  constexpr size_t sha1_bytes = 20;
  const std::string text = std::string(key) + std::string(fixed);
  std::array<uint8_t, sha1_bytes> digest{};
  CHECK(EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha1(), nullptr) == 1);
  std::array<uint8_t, (sha1_bytes + 2) / 3 * 4 + 1> base64{};
  const int length = EVP_EncodeBlock(base64.data(), digest.data(), static_cast<int>(digest.size()));
  return {base64.begin(), base64.begin() + length};
}

}  // namespace scree
