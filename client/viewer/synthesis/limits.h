// Bounds of the synthesiser. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Sounds at once: more than anybody can tell apart. Beyond, a new one takes the place of the quietest.
inline constexpr size_t voices_max = 32;

/// Events that wait for the next samples: those of one frame (piece_events_per_step_max). Above: left out;
/// the heaviest come first.
inline constexpr size_t sound_events_max = 96;

/// Sounds that one call of render() begins, at most: neighbours are one sound. Above: the quietest are left
/// out.
inline constexpr size_t sounds_begun_max = 8;

/// Samples of a voice between two looks whether a part of it is over.
inline constexpr size_t voice_look_frames = 128;

/// Bytes of samples in a file of sound: an hour and a half, more than a film has. What comes later is left
/// out.
inline constexpr size_t sound_file_bytes_max = size_t{1} << 30;

}  // namespace scree::limits
