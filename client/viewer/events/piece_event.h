// What a piece does that is heard and seen: it cracks off, it strikes something, it becomes ground.
#pragma once

#include <glm/vec3.hpp>

#include "client/viewer/events/piece_event_kind.h"
#include "shared/base/ids.h"
#include "shared/material/palette.h"

namespace scree {

inline constexpr glm::vec3 gravity_m_s2{0.0F, -9.81F, 0.0F};

/// The colour of the dust of the ground's own rock, which is sandstone (client/shaders/rock.glsl).
inline constexpr glm::vec3 rock_dust{0.58F, 0.37F, 0.21F};

struct PieceEvent {
  PieceEventKind kind = PieceEventKind::strike;
  glm::vec3 place_m{0.0F};
  float size_m = 1.0F;       ///< side of a cube of its volume
  float impulse_n_s = 0.0F;  ///< that it had, gave or lost
  Material material{};       ///< that most of the piece is of
  PieceId piece = 0;
  float mass_kg = 2600.0F;
  MaterialSound sound = plain_palette()->rows.front().sound;
  glm::vec3 dust = rock_dust;  ///< its colour, linear
};

}  // namespace scree
