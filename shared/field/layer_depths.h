// How deep the layers of material.h reach below the undisturbed ground; metres. For who draws them, too.
#pragma once

namespace scree {

inline constexpr float soil_depth_m = 1.0F;
inline constexpr float ice_depth_m = 1.5F;

}  // namespace scree
