// Drawing without polygons: rays that sphere trace a copy of the field on the GPU (brick_world.h). What a
// frame costs depends on what is in sight, never on how many edits made it. Within OpenGL ES 3.0's subset.
//
// An edit is in the picture of the next draw(): bricks are read when update() hears of them.
#pragma once

#include <memory>

#include "client/render/scene/draw_method.h"
#include "client/render/scene/work_pool.h"

namespace scree {

/// `pool` must outlive the method. Needs the GL context current. Fails when a shader does.
Result<std::unique_ptr<DrawMethod>> make_raymarch_method(WorkPool& pool, float view_radius_m);

}  // namespace scree
