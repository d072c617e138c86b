// Lengths of time as people write them.
#pragma once

#include <cstdint>
#include <string>

#include "shared/base/result.h"

namespace scree {

/// Seconds of "30d", "12h", "45m" or "90s": a whole number, at least 1, and at most ten years.
Result<uint64_t> read_duration_s(const std::string& text);

}  // namespace scree
