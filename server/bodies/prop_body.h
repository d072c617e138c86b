// A prop (shared/prop/prop.h) as a shape that Bodies takes. Deterministic. Metres, kilograms.
#pragma once

#include "server/formats/world_value.h"
#include "shared/prop/prop_solid.h"

namespace scree {

/// `density_kg_m3`: of its material, by which it weighs where it says no mass; positive. `spacing_m`: of the
/// points by which it touches the terrain, about. The prop must have passed validate(); `measure` is what it
/// measures.
BodyShape body_shape_of(const Prop& prop, const PropMeasure& measure, float density_kg_m3, float spacing_m);
inline BodyShape body_shape_of(const Prop& prop, float density_kg_m3, float spacing_m) {
  return body_shape_of(prop, measure_of(prop), density_kg_m3, spacing_m);
}

}  // namespace scree
