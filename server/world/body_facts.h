// What a world tells its host of one body. Metres, seconds, kilograms.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "shared/base/ids.h"
#include "shared/field/piece.h"

namespace scree {

struct BodyFacts {
  PieceId id = 0;
  bool is_piece = false;  ///< else a prop
  Pose pose;
  glm::vec3 velocity_m_s{0.0F};
  glm::vec3 spin_rad_s{0.0F};
  float mass_kg = 0.0F;
  MassUnits mass = 0;    ///< of a piece, as the ledger has it
  float reach_m = 0.0F;  ///< how far it reaches from its place
  bool kept = false;     ///< of a piece: it never becomes terrain until it is released
  uint64_t owner = 0;    ///< party that caused it (command.h); 0: the world itself
  uint64_t tag = 0;      ///< of a prop
  bool awake = false;    ///< it moves, or may: else it neither moved nor was touched for some seconds
};

}  // namespace scree
