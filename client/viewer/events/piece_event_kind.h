// The kinds of what a piece does that is heard and seen.
#pragma once

#include <cstdint>

namespace scree {

enum class PieceEventKind : uint32_t { strike, crack, settle };

}  // namespace scree
