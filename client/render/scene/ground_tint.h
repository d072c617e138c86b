// The ground's own looks in the colours of its palette: beds of rock, soil and grass, ice.
#pragma once

#include <array>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "shared/material/palette.h"

namespace scree {

/// Factors of the colours that client/shaders/rock.glsl has for the ground's three layers.
struct GroundTints {
  glm::vec3 bulk{1.0F}, soil{1.0F}, cap{1.0F};
};

/// Colours (linear RGB) of the materials that the shader's ground is of: rock, soil and ice of the built-in
/// palette, for which there is no tint.
inline constexpr std::array<std::array<float, 3>, 3> natural_colours{
    {{0.33F, 0.31F, 0.30F}, {0.20F, 0.12F, 0.06F}, {0.62F, 0.76F, 0.86F}}};

inline GroundTints ground_tints(const Palette& palette) {
  const auto tint = [&](Material material, size_t layer) {
    constexpr float brightest = 8.0F;
    const std::array<float, 3>& colour = palette.row_or_first(material).look.colour;
    const std::array<float, 3>& natural = natural_colours.at(layer);
    return glm::min(glm::vec3(colour[0] / natural[0], colour[1] / natural[1], colour[2] / natural[2]),
                    brightest);
  };
  return {tint(palette.ground.bulk, 0), tint(palette.ground.soil, 1), tint(palette.ground.cap, 2)};
}

}  // namespace scree
