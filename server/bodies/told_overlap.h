// The depth of an overlap that the solver is told of: it undoes a share of it in each step.
#pragma once

#include "server/bodies/limits.h"

namespace scree {

/// The greatest depth, metres, that is undone at no more than that speed in steps of this length.
constexpr float told_overlap_m(float undo_m_s, float step_s) {
  return undo_m_s * step_s / limits::undone_a_step;
}

}  // namespace scree
