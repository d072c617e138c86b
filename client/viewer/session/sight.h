// Counts the pieces that a camera sees.
#pragma once

#include <cstddef>

#include "client/render/scene/draw_method.h"

namespace scree {

/// Pieces within the picture whose centre no rock of the field hides. Pieces do not hide each other.
size_t pieces_in_sight(const Scene& scene, const Camera& camera, float aspect, float view_radius_m);

}  // namespace scree
