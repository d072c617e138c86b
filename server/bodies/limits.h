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

/// Depth of penetration that the solver is told of, metres: it undoes a fifth of it in each tick. Shallow
/// overlaps come from neighbours that merged; undone slowly (0.2 m/s) they disturb no piece at rest, which
/// took a heap twice as long to merge. What is deeper than that is buried, and pushed out at 2.4 m/s.
inline constexpr float overlap_shallow_m = 0.125F;
inline constexpr float overlap_told_m = 0.02F;
inline constexpr float overlap_told_buried_m = 0.2F;

/// Farthest between two points of a piece's surface that are tested against the terrain, voxels: spikes
/// thinner than this may poke into a face.
inline constexpr float sample_spacing_voxels = 2.0F;

/// Points of one piece that are tested against the terrain. Above: spacing doubles until they are fewer.
inline constexpr unsigned samples_max = 96;

/// Voxels around a body, beyond its bounds, of which its probe keeps a copy: it may move that far before the
/// copy is made again.
inline constexpr int probe_slack_voxels = 2;

/// Depth behind a triangle at which the mesh collider still finds it, voxels: a mesh knows no inside. What is
/// deeper falls.
inline constexpr float mesh_depth_voxels = 1.5F;

/// Blocks of 16³ voxels of which the mesh collider keeps triangles: about 25 KB each. Above: all are dropped
/// and made anew on demand.
inline constexpr unsigned mesh_blocks_max = 1024;

/// Rays of the rays collider along each side of a body's footprint.
inline constexpr int rays_side = 4;

/// Bullet's margin around a hull, metres: a tenth of the piece's thickness, but not more than this. Thinner
/// margins make GJK fall back to its slow penetration search; zero is slowest of all.
inline constexpr float margin_max_m = 0.03F;

/// Gap between the collision shapes of neighbours at birth, per side, metres.
inline constexpr float birth_gap_m = 0.004F;

/// Speed that a body loses to the air, per second, as a share; linear and angular. Keeps spin from lasting.
inline constexpr float air_damping = 0.05F;
inline constexpr float air_spin_damping = 0.2F;

/// The same while in touch with terrain and slower than `creep_m_s`: rubble has no perfect corners to rock
/// on.
inline constexpr float ground_damping = 1.5F;
inline constexpr float ground_spin_damping = 3.0F;
inline constexpr float creep_m_s = 1.0F;

/// Iterations of the contact solver. Heaps of rubble need no exact stacking; each costs a tenth of a step.
inline constexpr int solver_iterations = 8;

/// Least of a body's moments of inertia, as a share of its greatest: thinner splinters spin up without bound.
inline constexpr float inertia_ratio_min = 0.25F;

/// Overlap that the solver leaves alone, metres: contacts that last instead of flickering.
inline constexpr float penetration_slop_m = 0.004F;

/// Speeds below which Bullet counts a body as sleepy, m/s and rad/s; an island sleeps after two such seconds.
inline constexpr float sleep_speed_m_s = 0.15F;
inline constexpr float sleep_spin_rad_s = 0.3F;

/// Change of speed at which a blow thaws a frozen body, m/s: a heap's weight must not, a piece that drops on
/// it from half a metre does.
inline constexpr float thaw_speed_m_s = 2.0F;

/// How far a body that thawed may move before those that touched it thaw, too, metres.
inline constexpr float thawed_leash_m = 0.03F;

/// Upward share of a contact's normal from which on the upper piece counts as carried by the lower.
inline constexpr float carrying_slope = 0.2F;

}  // namespace scree::limits
