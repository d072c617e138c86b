// Bounds and tunings of the rigid bodies. Each says its unit, its reason, and what happens there.
#pragma once

namespace scree::limits {

/// Rock's density, kg/m³: a full voxel's mass. Only ratios of masses matter to the solver.
inline constexpr float rock_density_kg_m3 = 2000.0F;

/// Farthest that any point of a piece may travel in one tick, voxels. The narrow band is 3 voxels, so a piece
/// cannot cross it unseen. Above: linear speed is cut to ⅘ of it, spin to the rest.
inline constexpr float travel_max_voxels = 2.5F;

/// Spin of any piece, rad/s: beyond it a convex contact is meaningless from one tick to the next. Cut.
inline constexpr float spin_max_rad_s = 20.0F;

/// Hull points within this distance of the ground make contacts, metres, even without approaching it; keeps
/// a resting piece's contacts from flickering.
inline constexpr float contact_slack_m = 0.02F;

/// Depth of penetration that the solver is told of, metres; deeper is pushed out over several ticks. Pushing
/// out all at once throws pieces at their neighbours.
inline constexpr float depth_max_m = 0.2F;

/// Farthest between two points of a piece's surface that are tested against the terrain, voxels: spikes
/// thinner than this may poke into a face.
inline constexpr float sample_spacing_voxels = 2.0F;

/// Points of one piece that are tested against the terrain. Above: spacing doubles until they are fewer.
inline constexpr unsigned samples_max = 96;

}  // namespace scree::limits
