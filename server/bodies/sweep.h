// How far a body moves within a step. A body that would strike something in the course of a step is moved to
// where it touches, with its speed, and the rest of the step is lost to it. So the next step's contact takes
// the whole blow at once, whatever the length of steps. What is fast is looked at all along its way, for it
// could pass what its contacts know nothing of. Private to this folder.
#pragma once

#include <vector>

#include "server/bodies/body.h"
#include "server/bodies/body_speeds.h"
#include "server/colliders/terrain_collider.h"

namespace scree {

/// Stops the body where its first point strikes the ground, and takes those contacts out: they are touched in
/// the next step. `found`: as of TerrainProbe::list(), at the step's start.
void stop_at_blows(Body& body, const StepSize& step, std::vector<TerrainContact>& found);

/// Whether the body leaves in a step what its probe looked at.
bool is_fast(const Body& body, const StepSize& step);
/// Stops a fast body where it first strikes the ground, at the speed that it has after the solver. Reads the
/// terrain: one thread.
void sweep(Body& body, const StepSize& step);

}  // namespace scree
