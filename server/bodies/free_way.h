// The way out of rock: where a body that lies in the terrain finds the nearest free place. Metres. Reads the
// terrain: one thread. Private to this folder.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "server/bodies/body.h"
#include "shared/field/field.h"

namespace scree {

/// Whether the middle of a prop that contacts move, and most of its points, lie in the terrain. Its contacts
/// then push it to all sides, or have no direction.
bool is_sunk(const Body& body, const Field& field);

/// The direction, of unit length, to the nearest place at which none of the body's points lies in the
/// terrain: along the terrain's gradient about it, or one of 26 directions, and no farther than the body is
/// long. Nothing: there is none.
std::optional<glm::vec3> free_way(const Body& body, const Field& field);

}  // namespace scree
