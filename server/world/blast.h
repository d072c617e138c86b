// The motion that a carve's blow gives to its pieces. Deterministic; metres.
#pragma once

#include "server/world/ejecta.h"
#include "server/world/world_state.h"
#include "shared/operation/request.h"

namespace scree {

/// A number that a place has, and others near it have not: what is random there depends on nothing that
/// happens elsewhere.
uint32_t number_of_place(glm::vec3 place_m);

/// Whether a blow strikes a carve's rock from outside, or goes off within it.
enum class BlowSide : uint8_t { outside, within };

class Blast {
 public:
  /// In the terrain as it is after the carve.
  Blast(const World::State& state, const CarveRequest& request, BlowSide side);

  /// The motion of a piece of the carve: it flies away from the mirror image of the impact behind the shape's
  /// centre, so towards the impact, more slowly with distance, and spins. Away from the impact itself, most
  /// pieces would be pressed into the rock behind them. All are pushed to the carve's open side, too. A blow
  /// within throws them as ejecta (ejecta.h).
  BodyState thrown(PieceId id, glm::vec3 centre_m) const;

 private:
  EjectedMotion flight(glm::vec3 centre_m) const;

  const CarveRequest& request_;
  glm::vec3 open_side_{0.0F, 1.0F, 0.0F};
  bool spins_by_place_ = true;
  bool ejects_ = false;
};

}  // namespace scree
