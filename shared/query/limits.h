// Bounds of questions about space, so that each has a most that it can cost. Above: refused.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Every coordinate of a place, metres from the origin: twice the world's half width. Floats there still tell
/// a half of a millimetre apart.
inline constexpr float query_place_max_m = 8192.0F;

/// Length of a cast, metres: at 0.25 m that is 4,000 voxels, and a hundred chunks or two to generate.
inline constexpr float query_cast_max_m = 1000.0F;

/// Radius of a sphere or a capsule, metres. Smaller: cast a ray.
inline constexpr float query_radius_min_m = 0.01F;
inline constexpr float query_radius_max_m = 8.0F;
/// Length of a capsule's axis, metres.
inline constexpr float query_axis_max_m = 16.0F;

/// Volume of the box that a cast of a sphere or a capsule sweeps, and volume of a box, m³: a ball of the
/// largest radius goes 48 m, one of half a metre goes as far as a ray. Boxes of solids may be larger.
inline constexpr float query_volume_max_m3 = 16384.0F;

/// Side of a box, metres.
inline constexpr float query_box_side_max_m = 256.0F;

/// How far a nearest surface is looked for, metres.
inline constexpr float query_nearest_max_m = 8.0F;

/// Convex parts of a body, points of one, and how far each point and a radius may reach from the body's
/// place, metres.
inline constexpr size_t query_parts_max = 64;
inline constexpr size_t query_points_max = 64;
inline constexpr float query_part_reach_max_m = 64.0F;
/// Rounds of one distance between two convex bodies, and distances of one cast: as a rule there are four of
/// each. What is found by then counts; a cast that has not ended has met the body.
inline constexpr int query_distance_rounds = 64;
inline constexpr int query_advances = 64;

/// Ids that a mask may except.
inline constexpr size_t query_excepted_max = 64;

/// Blocks of 8³ cells with a surface, and chunks, that a scene keeps from one question to the next: 28 MB and
/// 4 MB. Beyond: it forgets all before the next question.
inline constexpr size_t query_blocks_kept = 4096;
inline constexpr size_t query_chunks_kept = 32768;

}  // namespace scree::limits
