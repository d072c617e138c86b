#include "server/publish/shared_bytes.h"

#include <utility>

#include "proto/codec.h"

namespace scree {

SharedBytes share(std::vector<uint8_t> bytes) {
  return std::make_shared<const std::vector<uint8_t>>(std::move(bytes));
}

SharedBytes share(const ServerMessage& message) {
  return share(encode(message));
}

}  // namespace scree
