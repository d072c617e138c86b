// A shade of its own for each piece, so that neighbours in a heap can be told apart.
#pragma once

#include "shared/base/ids.h"

namespace scree {

/// 0..1, different for neighbours in the order of ids.
inline float tint_of(PieceId id) {
  return static_cast<float>((id * 0x9E3779B1U) >> 8U) / 16777216.0F;
}

}  // namespace scree
