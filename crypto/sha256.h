#pragma once

#include <span>

#include "shared/base/digest.h"

namespace scree {

/// FIPS 180-4. Any thread may call.
Digest sha256(std::span<const uint8_t> bytes);

}  // namespace scree
