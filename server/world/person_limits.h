// Bounds and constants of persons on foot. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Inputs of a person that wait to be carried out: half a second of them at 60 ticks a second, which a viewer
/// of three frames a second sends at once. Above: refused.
inline constexpr size_t walk_inputs_max = 32;

/// How far the number of an input may be ahead of the last one that came: ten seconds of them, which a link
/// may have lost. Above: refused, as is one that is not ahead.
inline constexpr uint32_t walk_numbers_ahead_max = 600;

/// Each tick a person gains a little more than one input that may be carried out, in parts of one: a clock
/// that is 1.5 % fast makes no queue. A person has so many at most, for those that a link held back. So who
/// sent nothing is no more than a fifth of a second ahead of the world's time.
inline constexpr uint32_t walk_credit_parts = 64;
inline constexpr uint32_t walk_credit_a_tick = 65;
inline constexpr uint32_t walk_credit_max = 12 * walk_credit_parts;

/// Seconds without an input after which a person goes on without one: falls, and is pushed by pieces.
inline constexpr float walk_idle_s = 0.25F;

/// Kilograms of a person's body, by which blows are judged.
inline constexpr float person_mass_kg = 80.0F;

/// Energy of the least blow that hurts, J: of a stone of a kilogram that falls from a metre.
inline constexpr float hurt_energy_min_j = 10.0F;

/// Seconds for which the greatest energy of what comes near a person is known: a blow's event comes when it
/// is over (limits::contact_sum_s).
inline constexpr float person_blow_s = 0.5F;

/// How near a body is looked at as one that may strike a person, metres: what is 60 m/s fast goes so far in a
/// tick.
inline constexpr float person_blow_near_m = 2.0F;

/// Estimated time of a person's tick on foot, microseconds: of one who stands, and more for each input and
/// for each body near.
inline constexpr float person_cost_us = 6.0F;
inline constexpr float person_input_cost_us = 25.0F;
inline constexpr float person_near_cost_us = 1.0F;

/// What a look from an eye to an edit costs, microseconds.
inline constexpr float sight_cost_us = 60.0F;

}  // namespace scree::limits
