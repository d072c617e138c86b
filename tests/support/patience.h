// How long tests wait for another thread or process.
#pragma once

#include <chrono>

namespace scree {

/// Far longer than any wait takes, even under a sanitizer and beside other tests.
inline constexpr std::chrono::seconds patience{60};

}  // namespace scree
