// What a piece does that is heard and seen: it cracks off, it strikes something, it becomes ground.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "shared/base/ids.h"
#include "shared/material/material.h"

namespace scree {

inline constexpr glm::vec3 gravity_m_s2{0.0F, -9.81F, 0.0F};

enum class PieceEventKind : uint8_t { strike, crack, settle };

struct PieceEvent {
  PieceEventKind kind = PieceEventKind::strike;
  glm::vec3 place_m{0.0F};
  float size_m = 1.0F;       ///< side of a cube of its volume
  float impulse_n_s = 0.0F;  ///< that it had, gave or lost
  Material material = material::rock;
  PieceId piece = 0;
};

}  // namespace scree
