// Bounds and constants of the simulation. Each says its unit and its reason.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Pieces alive at once that a world may be asked for. Above, no machine of today keeps the tick; none at all
/// is no carve at all. Refused where a world is created.
inline constexpr uint32_t pieces_max_min = 1;
inline constexpr uint32_t pieces_max_max = 20000;

/// Props that a world may be asked for. Above, no machine of today keeps the tick. Refused where a world is
/// created.
inline constexpr uint32_t props_max_max = 10000;

/// Joints that a world may be asked for. Above, no machine of today keeps the tick. Refused where a world is
/// created.
inline constexpr uint32_t joints_max_max = 10000;

/// Place of a push from the body's bounding sphere, metres: clients see where a body was some ticks ago.
/// Beyond: refused.
inline constexpr float push_slack_m = 4.0F;

/// The blast's wave is weakened by the rock on its way to a body, which is sampled every half voxel; at so
/// many places for all bodies of a blast: some 2 ms. Beyond: at fewer places, farther apart.
inline constexpr size_t blast_rock_samples_max = 40'000;

/// The blows of props that a tick tells of change a body's speed by at least so much, m/s, and take at least
/// so much energy, J: a crate that lies still makes none. Blows between rock are many more: a tick tells of
/// so many, and only where they are impacts. Beyond: the weakest are left out.
inline constexpr float contact_event_min_m_s = 0.5F;
inline constexpr float contact_event_min_j = 1.0F;
/// Such a blow that goes on for several ticks is told when it is over, with the sum of its energy, at the
/// latest after so many seconds: then the next begins.
inline constexpr float contact_sum_s = 0.25F;
inline constexpr size_t contact_events_of_rock_max = 64;

/// The greatest impulse of a push, newton seconds: of the heaviest prop at 100 m/s. Above: refused.
inline constexpr float push_impulse_max_n_s = 1e9F;

/// Memory that a world may be asked to keep to, megabytes: below, hardly more than the program fits. Above:
/// as good as no limit. Refused where a world is created.
inline constexpr uint32_t memory_max_min_mb = 256;
inline constexpr uint32_t memory_max_max_mb = 1024 * 1024;

/// Merges in one tick that a world may be asked for; 0: nothing merges. So many take two ticks of 60 Hz.
/// Above: refused where a world is created.
inline constexpr uint32_t merges_per_tick_max_max = 1000;

/// Bricks that the search for islands reads in one tick: what the tick has room for, at least about 1 ms, at
/// most 4. Above: it continues in the next tick.
inline constexpr size_t island_bricks_per_tick_min = 1024;
inline constexpr size_t island_bricks_per_tick_max = 4096;

/// Bricks around which one search for islands looks: a blow of ordinary size changes fewer. Above: several
/// searches.
inline constexpr size_t island_loosened_bricks_max = 512;

/// Distance around a change within which the search for support looks, bricks: 14 m at 0.25 m. Terrain that
/// reaches farther counts as held.
inline constexpr int support_reach_bricks = 7;

/// Side of a cube of bricks whose changes make one search for support: a blow of ordinary size.
inline constexpr int support_cluster_bricks = 5;

/// A crushed neck has one seed for so many voxel faces of its section, at most `neck_seeds_max`; its pieces
/// part at `neck_throw_m_s`.
inline constexpr int64_t neck_faces_per_seed = 24;
inline constexpr uint32_t neck_seeds_max = 6;
inline constexpr float neck_throw_m_s = 2.0F;

/// Searches for islands and islands that wait to fall, of all parties. A party may have as many as there are
/// places left, so that one more party always finds one, and its even share even if others went beyond
/// theirs: nobody knows how much a carve loosens before it is searched. A finished search takes some 0.1 MB.
/// Above: what may loosen more is refused.
inline constexpr size_t falls_waiting_max = 512;

/// How long a party's islands may wait until the last has fallen, seconds, where none fits and one falls in
/// island_rest_s: who waits longer does not see any more what it was that he cut. Above: what may loosen more
/// is refused.
inline constexpr float falls_wait_max_s = 30.0F;

/// Points of an island's surface that are tested against the ground, besides the corners of its hull. Above:
/// they are spread more widely.
inline constexpr size_t concave_samples_max = 128;

/// Longest side of an island's volume, voxels, from which on it collides with other pieces as a compound of
/// convex parts; a smaller island collides as one hull. Above `compound_parts_max` parts: they are larger.
inline constexpr int compound_side_min_voxels = 16;
inline constexpr size_t compound_parts_max = 64;

/// Chunks of terrain that hangs on one region which forbids falls, as a world remembers them: all around a
/// town. Above: what hangs in others falls when a change touches it after the region is over.
inline constexpr size_t hung_chunks_max = 2048;

/// Chunks whose terrain is searched in one tick after the region on which it hung is over: two searches.
inline constexpr size_t released_chunks_per_tick = 16;

/// Chunks for which a world remembers the regions that hold terrain there, some 100 bytes each. Above: all
/// are forgotten, and looked for again.
inline constexpr size_t region_chunks_kept_max = 16384;

/// How much a body's middle is put back before the surface of a region that it may not enter, metres: a
/// step of a pose on the wire is a thousandth.
inline constexpr float region_skin_m = 0.01F;

/// Seconds since the last fall up to which pieces that lean on hanging terrain do not become terrain: the
/// search for a large island takes one. Above: falls wait for room that only merges make.
inline constexpr uint32_t lean_s_max = 5;

/// Height of an island over its width, both with the voxels at the surface, from which on it counts as a
/// post: it stands no better than a pencil, and topples.
inline constexpr float post_slenderness = 12.0F;

/// Parts of a component, one for each brick as a rule, that a search follows: half a million m³ at 0.25 m. A
/// larger component counts as ground, and is counted.
inline constexpr size_t island_parts_max = 65536;

/// Times that a search's budget doubles, once for each restart, up to island_bricks_per_tick_max: an island
/// of so many bricks is then searched in one tick also when ticks are full, so that no change can interrupt
/// the search. A larger one falls when changes near it pause.
inline constexpr unsigned island_doublings_max = 2;

/// Change of a piece's speed in one contact below which it is no impact, m/s: a piece at rest on the ground
/// bears 0.16, one that drops by its own height 3.
inline constexpr float impact_speed_min_m_s = 3.0F;

/// Breaks and dents in one tick: 0.7 ms each, hulls and bodies included. Above: the weaker ones do not
/// happen.
inline constexpr uint32_t breaks_per_tick_max = 4;
inline constexpr uint32_t dents_per_tick_max = 2;

/// Blows that are searched for what they break off, in one tick: 3 ms, spans more. Above: the weaker ones do
/// not break terrain.
inline constexpr uint32_t blows_per_tick_max = 1;

/// Bricks around a blow that its search reads: terrain that reaches farther is held.
inline constexpr int blow_reach_bricks = 4;

/// Least force of a blow that may break terrain, newtons: on rock, that of a stone of 600 kg that falls by a
/// metre. Below: nothing is looked for. Ten times less made each blast search the walls of its own hole.
inline constexpr float blow_min_n = 3.0e5F;

/// Least impulse of a prop's blow that may break terrain, newton seconds. What is light and fast has stopped
/// before sound went through some metres of rock, so that nothing bends: a bullet has 30, a cannonball of 10
/// kg 2,000. Below: it breaks nothing.
inline constexpr float prop_blow_min_n_s = 500.0F;

/// Places whose blows were too weak for a dent. Above: the one that was struck least lately is forgotten.
inline constexpr size_t struck_places_max = 256;

/// Number of breaks among a piece's ancestors from which on it does not break any more.
inline constexpr uint8_t break_generations_max = 3;

/// Least mass of a piece that breaks, and least mean mass of its children, units of 1/254 voxel: 24 and 6
/// voxels. Bodies of smaller pieces would cost time and show gravel. Below: the piece stays whole.
inline constexpr int64_t break_mass_min = 24 * 254;
inline constexpr int64_t break_child_mass_min = 6 * 254;

/// Seeds of one break. Above: this many.
inline constexpr float break_seeds_max = 12.0F;

/// Speed at which children part from the blow, as a share of the speed that it took: a fiftieth of its
/// energy.
inline constexpr float break_push = 0.15F;

/// Smallest dent, voxels: a smaller one could not be seen. Below: there is no dent.
inline constexpr float dent_voxels_min = 12.0F;

/// Largest dent's radius, metres. Above: this.
inline constexpr float dent_radius_max_m = 1.5F;

/// Seeds of a dent; the speed of its pieces at most, as a share of the impact's speed; and their energy at
/// most, as a share of the impact's: nearly all of it crushes the ground.
inline constexpr uint32_t dent_seeds = 4;
inline constexpr float dent_throw = 0.3F;
inline constexpr float dent_energy_share = 0.1F;

/// A heavier piece stays a block of what it is when it merges, voxels: as rubble it would need a surface that
/// lies more than a voxel farther out, which merges do not make. With 12 to a side it would still find room.
inline constexpr int64_t rubble_voxels_max = 1000;

/// Merges of a tick whose budget is used up may cost so much, microseconds: 14 of small pieces, which so many
/// fewer bodies save in a few ticks. One piece merges in any case.
inline constexpr float merge_least_us = 2500.0F;

/// Share of its speed that a piece may lose to the air in a second, percent: all of it. Refused where a world
/// is created.
inline constexpr uint32_t air_drag_max_percent = 100;

/// Places whose slopes are looked at in one tick. Above: in the next.
inline constexpr size_t slide_looks_per_tick = 64;

/// Side of the squares whose slopes count, m: stones of that size stand steeper.
inline constexpr float slide_cell_m = 0.5F;

/// Cells around a place in which its rubble may run; the outermost stay.
inline constexpr int slide_margin_cells = 2;

/// How far below a place the ground is looked for, bricks: 24 m at 0.25 m. Deeper: rubble stays at the edge.
inline constexpr int slide_depth_bricks = 12;

/// Tension that loose ground bears, Pa, above which it does not slide: it holds together, as soil and clay
/// do.
inline constexpr float slide_hanging_max_pa = 1.0e4F;

/// How much steeper a slope starts to slide, in 64ths of the tangent: about two degrees.
inline constexpr int slide_excess = 2;

/// Clients at once that a server may be asked for.
inline constexpr uint32_t sessions_max_max = 4096;

/// Requests a second of one client that a server may be asked for: from one in ten seconds to no limit in
/// practice.
inline constexpr double requests_per_second_min = 0.1;
inline constexpr double requests_per_second_max = 1.0e6;

/// Reach of a client from its eye that a server may be asked for, metres: up to beyond any place of a world.
/// 0: there is no limit.
inline constexpr double reach_min_m = 0.0;
inline constexpr double reach_max_m = 16384.0;

/// Least reach of a request's shape, voxels: between the centres of voxels a smaller one would change
/// nothing. Refused.
inline constexpr float request_reach_min_voxels = 0.75F;

/// Code at which a place is deeper than a voxel in rock.
inline constexpr int buried_code = -42;

/// Share of a piece that must be so deep for the piece to count as buried, and about how many of its voxels
/// are looked at.
inline constexpr float buried_share = 0.5F;
inline constexpr int buried_samples = 64;

/// Looks a second at a piece that no merge enclosed. Two looks in a row must find it buried: a piece that
/// struck the ground hard is in it for a tick or two.
inline constexpr uint32_t buried_scan_hz = 20;

/// Stones where pieces merged that a world keeps, for the eye alone, and what their volumes take in memory,
/// bytes: nearly three times as many as a viewer draws at once. Above: those whose pieces were made first go
/// first; who was there when they merged goes on seeing them.
inline constexpr size_t kept_stones_max = 4096;
inline constexpr size_t kept_stone_bytes_max = size_t{64} << 20U;

/// Pieces that freeze in one tick, about 10 us each. Above: in the next.
inline constexpr size_t freezes_per_tick_max = 64;

}  // namespace scree::limits
