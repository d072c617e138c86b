// New pieces become bodies.
#pragma once

#include <functional>

#include "server/world/world_state.h"
#include "shared/operation/request.h"

namespace scree {

/// The initial state of a new piece; spawn() fills in `body.id`.
struct Newborn {
  BodyState body;
  PieceTraits traits;
  bool may_be_concave = false;  ///< collides with the ground by its own surface instead of its hull's
};

/// The motion of a part, which is not frozen, of a body whose centre of mass is `offset_m` (in the volume's
/// axes) from the body's.
BodyState part_of(const BodyState& body, glm::vec3 offset_m);

/// Gives each piece that the operation made a hull, a body and its traits, enters it in the delta, and
/// advances State::next_piece past its id. Call right after apply_and_record().
void spawn(World::State& state, const Applied& applied,
           const std::function<Newborn(PieceId, const Volume&)>& born, TickDelta& delta);

/// Changes how a part of a piece that broke sets out.
using SetsOut = std::function<void(PieceId, BodyState&)>;

/// Breaks a living piece by a valid operation. Its parts go on as it moved, and as its own; `sets_out` may be
/// empty.
Applied shatter_piece(World::State& state, const ShatterOperation& operation, const SetsOut& sets_out,
                      TickDelta& delta);

/// By its materials.
float mass_kg(const Volume& volume, const Palette& palette, float voxel_size_m);
/// As the palette stands.
float mass_kg(const World::State& state, const Volume& volume);

}  // namespace scree
