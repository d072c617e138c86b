// Bounds of a client's copy of the world: a hostile server cannot make it hold more.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Chunks held: 1 GiB of codes when every brick is edited. A server with more edits within the radius of
/// interest is left, with the advice to ask for a smaller radius.
inline constexpr size_t mirror_chunks_max = 32768;

/// Pieces alive, many times a server's. Above: the connection is closed.
inline constexpr size_t mirror_pieces_max = 65536;

/// Props at once, more than a server may have. Above: the connection ends.
inline constexpr size_t mirror_props_max = 16384;

/// Joints at once, likewise.
inline constexpr size_t mirror_joints_max = 16384;

/// Work of one frame's operations by the model (shared/operation/price.h), microseconds: far more than a
/// server may do in its longest tick. Above: the connection is closed before it is done.
inline constexpr float mirror_frame_work_max_us = 2.0e6F;

/// Ticks after which the repair of a chunk is requested again: two seconds at 60 Hz. Until then, further
/// mismatches of the chunk are expected.
inline constexpr uint64_t repair_patience_ticks = 120;

/// Requests of one's own that are shown before the server answers; the work of carrying them out again, by
/// the model (shared/operation/price.h), microseconds, which a frame may have to do: ten strikes of usual
/// size, or two of the largest. Above: a request is shown when the server has carried it out.
inline constexpr size_t predictions_max = 8;
inline constexpr float predictions_work_max_us = 5.0e4F;

/// Seconds for which the server's answer is awaited: longer than any request waits on a server that keeps up.
/// Above: what was shown is taken back.
inline constexpr double prediction_seconds_max = 2.0;

}  // namespace scree::limits
