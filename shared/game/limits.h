// Bounds of what a host's rules show, tell and keep. Above: refused.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Signs of a world, of all audiences together: a screen shows a dozen.
inline constexpr size_t signs_max = 512;
/// Length of a sign's name and of its text, bytes.
inline constexpr size_t sign_name_bytes_max = 32;
inline constexpr size_t sign_text_bytes_max = 128;

/// Length of a line that rules say, bytes: as persons' lines (line_bytes_max).
inline constexpr size_t notice_line_bytes_max = 200;

/// Length of the channel and of the bytes of a message between rules and a program.
inline constexpr size_t channel_bytes_max = 32;
inline constexpr size_t channel_data_bytes_max = 4096;

/// Size of what a cue stands for, metres across, and its energy, joules.
inline constexpr float cue_size_max_m = 16.0F;
inline constexpr float cue_energy_max_j = 1e9F;

/// Notices of one tick: those beyond are refused. A client gets them within that tick's messages.
inline constexpr size_t notices_a_tick_max = 256;

/// What rules keep with a world: how many values, the length of a key and of a value, and that of all values
/// and keys together, bytes. Every moment of the world holds them.
inline constexpr size_t kept_values_max = 1024;
inline constexpr size_t kept_key_bytes_max = 96;
inline constexpr size_t kept_value_bytes_max = 16384;
inline constexpr size_t kept_bytes_max = 262144;

/// Sessions of which a world keeps a team or a speed.
inline constexpr size_t players_max = 4096;

}  // namespace scree::limits
