// The body of a person on foot, as the prop that it is in the world.
#pragma once

#include <cstdint>
#include <optional>

#include "shared/prop/prop.h"

namespace scree {

/// A capsule of a walker's size, which goes as it is told.
Prop body_of_person(uint64_t session, float mass_kg);

/// The session of whom the prop is, by its form. For those who have nothing else to go by, as in a recording.
std::optional<uint64_t> person_of_body(const Prop& prop);

}  // namespace scree
