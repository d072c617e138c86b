// Bounds of how fast a body may be, and what the air takes. Private to this folder.
#pragma once

#include "server/bodies/body.h"
#include "server/bodies/limits.h"

namespace scree {

struct StepSize {
  float voxel_size_m = 0.0F;
  float step_s = 0.0F;
};

/// Speeds that were cut to their limit differ from it by rounding, at most by this factor.
inline constexpr float speed_rounding = 1.001F;

/// Cuts the speeds to limits::speed_max_m_s and to the body's greatest spin.
void limit_speeds(Body& body);
/// The greatest speed that a body may have.
inline float speed_max_m_s(const Body& body) {
  return body.nature().is_piece() ? limits::speed_max_m_s : limits::prop_speed_max_m_s;
}

/// Applies the air's drag, a share a second, and the limits to a body that is awake, after the step. The step
/// must not have moved it out of overlaps by more than limits::undo_buried_m_s; else it is put back.
void settle(Body& body, const StepSize& step, float air_drag);
/// Whether the invariants of a body hold after a step; for CHECK_DEBUG.
bool is_sound_body(PieceId id, const Body& body);

}  // namespace scree
