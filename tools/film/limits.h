// Bounds of films. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Frames of a film: an hour of 30 a second. A longer one is refused before anything is drawn.
inline constexpr size_t film_frames_max = 108000;

/// Frames a second of a film: what players show. Others are refused.
inline constexpr double film_fps_min = 1.0;
inline constexpr double film_fps_max = 240.0;

/// Seconds of the recording in one second of the film: at the least, one tick of 1/60 s fills half a minute;
/// at the most, a minute goes by in a second. Others are refused.
inline constexpr double film_speed_min = 0.0005;
inline constexpr double film_speed_max = 60.0;

/// Names of persons that a message lists.
inline constexpr size_t persons_named_max = 20;

/// Distance between a person's eye and what is aimed at, metres. Below: it tells no direction.
inline constexpr float aim_min_m = 0.1F;

/// Up or down, radians: short of straight, where there is no side. Above: this.
inline constexpr float eye_pitch_max = 1.55F;

/// Seconds for which a frame waits for its terrain; a frame takes some seconds where a processor draws, and
/// the first one generates all that is in view. Above: the film ends with an error.
inline constexpr double film_frame_s_max = 600.0;

/// Milliseconds between two looks whether the work on a frame, or the encoder, is ready.
inline constexpr int film_pause_ms = 2;
inline constexpr int encoder_pause_ms = 20;

/// Seconds for which the encoder may finish its file after the last frame. Above: it is ended, with an error.
inline constexpr double encoder_finish_s_max = 600.0;

}  // namespace scree::limits
