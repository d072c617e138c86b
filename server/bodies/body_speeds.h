// Bounds of how fast a body may be, and its damping. Private to this folder.
#pragma once

#include "server/bodies/body.h"

namespace scree {

struct StepSize {
  float voxel_size_m = 0.0F;
  float step_s = 0.0F;
};

/// Speeds that were cut to their limit differ from it by rounding, at most by this factor.
inline constexpr float speed_rounding = 1.001F;

/// How fast a body's origin may be.
float speed_max_m_s(const StepSize& step);
/// Cuts the speeds so that no point of the body travels farther than limits::travel_max_voxels in a step.
void limit_speeds(Body& body, const StepSize& step);
/// Applies damping and the limits to a body that is awake, after the step. The step must not have moved it
/// out of overlaps by more than limits::undo_buried_m_s; else it is put back.
void settle(Body& body, const StepSize& step);
/// Whether the invariants of a body hold after a step; for CHECK_DEBUG.
bool is_sound_body(PieceId id, const Body& body, const StepSize& step);

}  // namespace scree
