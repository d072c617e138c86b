// Bounds of props and joints. Each says its unit, its reason, and what happens at the bound.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Parts of one prop, and corners of a part that is a hull: a step compares each with each of a neighbour's.
/// Above: refused.
inline constexpr size_t prop_parts_max = 16;
inline constexpr size_t prop_corners_max = 64;

/// Half of a side, and the distance of any point from the prop's origin, metres. Thinner ones pass between
/// the places where terrain is compared; larger ones touch hundreds of pieces at once. Beyond: refused.
inline constexpr float prop_half_min_m = 0.01F;
inline constexpr float prop_reach_max_m = 16.0F;

/// Mass of a prop, kg. A solver of eight steps bears a ratio of masses of some thousands. Beyond: refused.
inline constexpr float prop_mass_min_kg = 0.01F;
inline constexpr float prop_mass_max_kg = 1e7F;

/// Coefficient of friction at most, and gravity's share either way. Above: refused.
inline constexpr float prop_friction_max = 4.0F;
inline constexpr float prop_gravity_max = 4.0F;

/// Bytes that a game may give a prop. Above: refused.
inline constexpr size_t prop_data_bytes_max = 256;

/// Place of a joint from the origin of its body, metres: of the largest island. Beyond: refused.
inline constexpr float joint_place_max_m = 64.0F;

/// Bounds of a hinge's angle, radians, short of half a turn, where an angle has no sign; and of a slider's
/// way, metres. Beyond: refused.
inline constexpr float joint_angle_max_rad = 3.0F;
inline constexpr float joint_way_max_m = 256.0F;

/// Length of a distance or a rope, metres. A shorter one is a ball joint. Beyond: refused.
inline constexpr float joint_length_min_m = 0.01F;
inline constexpr float joint_length_max_m = 256.0F;

/// Speed of a motor: of a prop's spin, and of a fast lift. Beyond: refused.
inline constexpr float joint_spin_max_rad_s = 120.0F;
inline constexpr float joint_speed_max_m_s = 100.0F;

/// How far the places of a joint's two sides may lie apart when it is added, metres: beyond what it leaves
/// free, as the length of a rope. What is held closer than it is gets pulled together at once; a metre is
/// what bodies of 20 m/s move against each other while a request is on its way. Beyond: refused.
inline constexpr float joint_gap_max_m = 1.0F;

/// Force or torque of a motor, and those at which a joint breaks, newtons and newton metres: the weight of a
/// thousand of the heaviest props. Above: refused.
inline constexpr float joint_force_max = 1e11F;

}  // namespace scree::limits
