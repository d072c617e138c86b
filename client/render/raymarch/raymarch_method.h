// Drawing without polygons: rays that sphere trace a copy of the field on the GPU (brick_world.h). The cost
// of a frame depends on the visible surface, never on the number of edits. Within OpenGL ES 3.0's subset.
//
// The next draw() shows an edit: update() reads the changed bricks.
#pragma once

#include <memory>

#include "client/render/scene/draw_method.h"
#include "client/render/scene/work_pool.h"

namespace scree {

/// `pool` must outlive the method. Needs the GL context current. Fails when a shader does.
Result<std::unique_ptr<DrawMethod>> make_raymarch_method(WorkPool& pool, float view_radius_m);
/// The same with rounded edges: a bench measures against it what edges cost.
Result<std::unique_ptr<DrawMethod>> make_rounded_raymarch_method(WorkPool& pool, float view_radius_m);

}  // namespace scree
