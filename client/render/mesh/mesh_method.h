// Drawing by cached polygons of blocks of terrain, at levels of detail to the horizon, and of pieces, rebuilt
// on worker threads when they change (mesh_scheduler.h). Within OpenGL ES 3.0's subset.
#pragma once

#include <memory>

#include "client/render/scene/draw_method.h"
#include "client/render/scene/work_pool.h"

namespace scree {

/// `pool` must outlive the method. Needs the GL context current. Fails when a shader does.
Result<std::unique_ptr<DrawMethod>> make_mesh_method(WorkPool& pool, float view_radius_m);
/// The same with rounded edges: a bench measures against it what edges cost.
Result<std::unique_ptr<DrawMethod>> make_rounded_mesh_method(WorkPool& pool, float view_radius_m);
/// The same by dual contouring: sharp edges of the terrain stay sharp.
Result<std::unique_ptr<DrawMethod>> make_dual_method(WorkPool& pool, float view_radius_m);
/// The same by marching cubes; its pieces are surface nets, as everywhere.
Result<std::unique_ptr<DrawMethod>> make_cubes_method(WorkPool& pool, float view_radius_m);

}  // namespace scree
