// Bounds and constants of the simulation. Each says its unit and its reason.
#pragma once

namespace scree::limits {

/// Density of every piece, kg/m³: broken rock. Only ratios of masses matter to the bodies.
inline constexpr float rock_density_kg_m3 = 2000.0F;

}  // namespace scree::limits
