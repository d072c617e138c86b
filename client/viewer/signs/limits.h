// Bounds of how signs are shown. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Lines and bars at once: more would cover the picture. Above: the first ones by name.
inline constexpr size_t sign_rows_max = 12;

/// Markers at once: the same. Above: the nearest.
inline constexpr size_t sign_markers_max = 48;

/// Distance within which a marker beside the picture has an arrow at its edge, metres.
inline constexpr float sign_arrow_max_m = 200.0F;

/// A marker is whole up to the first distance, metres, and at its faintest from the second one on.
inline constexpr float sign_near_m = 40.0F;
inline constexpr float sign_far_m = 240.0F;
inline constexpr float sign_faintest = 0.35F;

}  // namespace scree::limits
