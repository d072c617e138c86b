// How pieces, bricks on the GPU and shaders say which material shows at a place: a number of paint_bits
// bits. 0: the looks of weathered, broken or piled rock. Else 1 + the material, everywhere; or, with
// paint_in_cuts added, as far as a cut lays fresh rock bare. The shaders' side is material_source.h.
//
// Vertices of terrain have the brick's paint, and beside it how far they lie within the ground's layer, which
// is interpolated: the layer's edge is drawn as a line and not triangle by triangle.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "shared/material/material.h"

namespace scree {

inline constexpr unsigned paint_material_bits = 4;
inline constexpr uint8_t paint_in_cuts = 1U << paint_material_bits;
inline constexpr unsigned paint_bits = paint_material_bits + 1;
static_assert(kind_count<Material> < paint_in_cuts, "more materials than paint_material_bits can tell");

/// The number of a brick painted with the material, if it is painted.
constexpr uint8_t paint_number(std::optional<Material> paint) {
  return paint ? static_cast<uint8_t>(1 + static_cast<int>(*paint)) : uint8_t{0};
}

/// The number of a layer that shows where a cut lays it bare. A cut through rock shows fresh rock, which is
/// no paint.
constexpr uint8_t layer_number(Material layer) {
  return layer == material::rock ? uint8_t{0} : static_cast<uint8_t>(paint_number(layer) | paint_in_cuts);
}

/// How far a vertex lies within a layer is told in steps of so many metres, up to layer_steps_max: beyond,
/// the layer shows whole (client/shaders/rock.glsl).
inline constexpr float layer_step_m = 0.02F;
inline constexpr int layer_steps_max = 255 / paint_in_cuts;

/// The byte of a vertex: the number of the brick's paint, and metres within the ground's layer.
constexpr uint8_t vertex_paint(uint8_t brick_paint, float layer_m) {
  const auto steps = static_cast<int>(layer_m / layer_step_m + 0.5F);
  return static_cast<uint8_t>(brick_paint + paint_in_cuts * std::clamp(steps, 0, layer_steps_max));
}

/// The byte of a piece's vertices, by its paint number. The place it comes from tells which layer it is of.
constexpr uint8_t vertex_paint(uint8_t piece_paint) {
  return piece_paint < paint_in_cuts ? piece_paint : vertex_paint(0, 1.0F);
}

}  // namespace scree
