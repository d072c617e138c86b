// Encoded messages, which several clients may share. The length prefix is part of the bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "proto/messages.h"

namespace scree {

using SharedBytes = std::shared_ptr<const std::vector<uint8_t>>;

SharedBytes share(std::vector<uint8_t> bytes);

SharedBytes share(const ServerMessage& message);

inline int64_t size_of(const SharedBytes& bytes) {
  return static_cast<int64_t>(bytes->size());
}

}  // namespace scree
