// The blows that a client learns of (proto/prop.proto).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "shared/base/ids.h"

namespace scree {

/// A blow in which a prop takes part, or a hard one of a piece.
struct ContactEvent {
  PieceId body = 0;
  PieceId other = 0;  ///< a piece or a prop, of a greater id than `body`; 0: the terrain
  glm::vec3 place_m{0.0F};
  glm::vec3 normal{0.0F};    ///< unit, towards `body`
  float impulse_n_s = 0.0F;  ///< along the normal
  float energy_j = 0.0F;     ///< that the contact took

  bool operator==(const ContactEvent&) const = default;
};

/// The blows of a tick, within interest, the hardest first.
struct ContactsMessage {
  Tick tick = 0;
  std::vector<ContactEvent> contacts;  ///< at most limits::contact_events_max
};

}  // namespace scree
