// The table of materials (shared/material/material.h) for shaders, as text in GLSL.
#pragma once

#include <string_view>

namespace scree {

/// A part of every program that has bricks.glsl, rock.glsl or surface.vert, before them:
///   paint_bits, paint_in_cuts, layer_step_m   as in client/render/scene/paint_number.h
///   material_rock, …            the material's number: 1 + its place in the table
///   material_albedo[]           by that number − 1
///   paint_colour(int)           the colour of a brick's paint, and whether there is any
std::string_view material_source();

}  // namespace scree
