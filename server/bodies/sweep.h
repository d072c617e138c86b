// How far a body moves within a step. A body that would strike something in the course of a step is moved to
// where it touches, with its speed, and the rest of the step is lost to it. So the next step's contact takes
// the whole blow at once, whatever the length of steps. What is fast is looked at all along its way, for it
// could pass what its contacts know nothing of. Private to this folder.
#pragma once

#include <span>
#include <vector>

#include "server/bodies/body.h"
#include "server/bodies/body_speeds.h"
#include "server/bodies/seen_chunks.h"
#include "server/colliders/terrain_collider.h"

namespace scree {

/// Stops the body where its first point strikes the ground, and takes those contacts out: they are touched in
/// the next step. `found`: as of TerrainProbe::list(), at the step's start.
void stop_at_blows(Body& body, const StepSize& step, std::vector<TerrainContact>& found);

/// Whether the body leaves in a step what its probe looked at.
bool is_fast(const Body& body, const StepSize& step);
/// Stops fast bodies where they first strike the ground, at the speeds that they have after the solver. Where
/// they are more than a step can look at (limits::swept_points_max, new_chunks_a_step), they go a part of
/// their way. Reads the terrain: one thread. In the order in which they stand.
void sweep(std::span<Body* const> fast, const StepSize& step, SeenChunks& seen);

}  // namespace scree
