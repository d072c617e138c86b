// A prop (shared/prop/prop.h) as a shape that Bodies takes. Deterministic. Metres, kilograms.
#pragma once

#include "server/formats/world_value.h"
#include "shared/prop/prop.h"

namespace scree {

/// `density_kg_m3`: of its material, by which it weighs where it says no mass; positive. `spacing_m`: of the
/// points by which it touches the terrain, about. The prop must have passed validate().
BodyShape body_shape_of(const Prop& prop, float density_kg_m3, float spacing_m);

}  // namespace scree
