// Bounds and constants of the simulation. Each says its unit and its reason.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Bricks at which the search for islands looks in one tick: about 1 ms. Above: it goes on in the next tick.
inline constexpr size_t island_bricks_per_tick = 1024;

/// Bricks that lost rock around which one search looks: more than one blow changes. Those of the time while
/// islands were switched off may be more: they make several searches.
inline constexpr size_t island_cut_bricks_max = 4096;

/// Bricks around a change in which a mass too heavy for its neck is looked for: 14 m at 0.25 m. What reaches
/// farther is held.
inline constexpr int support_reach_bricks = 7;

/// Bricks a side within which changes make one search for what holds: a blow of ordinary size.
inline constexpr int support_cluster_bricks = 5;

/// Seeds of a crushed neck: one for so many faces of voxels, at most so many; and how fast they part.
inline constexpr int64_t neck_faces_per_seed = 24;
inline constexpr uint32_t neck_seeds_max = 6;
inline constexpr float neck_throw_m_s = 2.0F;

/// Points of an island's surface that are tested against the ground, besides the corners of its hull. Above:
/// they are spread more thinly.
inline constexpr size_t concave_samples_max = 128;

/// Longest side of an island's volume, voxels, from which on it is a compound of convex parts to other
/// pieces, and how many there may be. Smaller ones collide as one hull; above, parts are larger.
inline constexpr int compound_side_min_voxels = 16;
inline constexpr size_t compound_parts_max = 64;

/// Parts of a component, one for each brick as a rule, that a search follows: half a million m³ at 0.25 m.
/// What is larger counts as ground, and is counted.
inline constexpr size_t island_parts_max = 65536;

/// Times that a search's budget doubles, once for each time that what it has seen changed under it: the
/// largest island is then searched in one tick, and nothing can interrupt it any more.
inline constexpr unsigned island_doublings_max = 6;
static_assert(island_bricks_per_tick << island_doublings_max >= island_parts_max);

/// Change of a piece's speed in one contact below which it is no impact, m/s: a piece at rest on the ground
/// bears 0.16, one that drops by its own height 3.
inline constexpr float impact_speed_min_m_s = 3.0F;

/// Breaks and dents in one tick: 0.7 ms each, hulls and bodies included. Above: the weaker ones do not
/// happen.
inline constexpr uint32_t breaks_per_tick_max = 4;
inline constexpr uint32_t dents_per_tick_max = 2;

/// Times that a piece's ancestors may have broken before it holds whatever strikes it.
inline constexpr uint8_t break_generations_max = 3;

/// Smallest piece that breaks, and what a child weighs at least on average, units of 1/254 voxel: 24 and 6
/// voxels. Smaller ones would be all edge, and make bodies out of gravel. Such pieces stay whole.
inline constexpr int64_t break_mass_min = 24 * 254;
inline constexpr int64_t break_child_mass_min = 6 * 254;

/// Seeds of one break, however hard.
inline constexpr float break_seeds_max = 12.0F;

/// Speed at which children part from the blow, as a share of the speed that it took: a fiftieth of its
/// energy.
inline constexpr float break_push = 0.15F;

/// Smallest dent, voxels: below, the ground gives way too little to be seen. Does not happen.
inline constexpr float dent_voxels_min = 12.0F;

/// Largest dent's radius, metres. Above: this.
inline constexpr float dent_radius_max_m = 1.5F;

/// Seeds of what a dent throws out, and how fast, as a share of the impact's speed.
inline constexpr uint32_t dent_seeds = 4;
inline constexpr float dent_throw = 0.3F;

/// Share of a tick that its work may take by the model; the rest is for what the model does not see, and for
/// other threads. Above: requests wait, pieces merge sooner, fewer break.
inline constexpr float work_share = 0.75F;

/// Share of that budget from which bodies alone count as a crowd: their rest is half as long.
inline constexpr float crowded_share = 0.5F;

/// The model, microseconds as measured on one core of a 2023 server (bench storm): a body that is awake, a
/// point of contact, a voxel of an edit's box, a seed's piece with its hull and body, a break, a dent, a
/// merge by each method.
inline constexpr float body_cost_us = 4.2F;
inline constexpr float contact_cost_us = 1.2F;
inline constexpr float edit_voxel_cost_us = 0.06F;
inline constexpr float seed_cost_us = 22.0F;
inline constexpr float break_cost_us = 500.0F;
inline constexpr float dent_cost_us = 500.0F;
inline constexpr float stamp_cost_us = 30.0F;
inline constexpr float slices_cost_us = 60.0F;
inline constexpr float sphere_cost_us = 170.0F;

/// A part of terrain of which is asked whether it holds (shared/falling/support_search.h).
inline constexpr float support_part_cost_us = 0.7F;

/// A voxel of the box around an island that is lifted.
inline constexpr float lift_voxel_cost_us = 0.05F;

/// Merges in a tick whose budget is used up: it must get better some time.
inline constexpr uint32_t merges_per_tick_min = 2;

/// Requests that wait for a tick with room for them. Above: refused.
inline constexpr size_t requests_waiting_max = 256;

/// Pieces that freeze in one tick, about 10 us each. Above: in the next.
inline constexpr size_t freezes_per_tick_max = 64;

}  // namespace scree::limits
