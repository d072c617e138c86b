// The paper's grid-based marching cubes (section 2.2): a geometry shader expands each point of a grid around
// the camera (grid_shape.h) into the triangles of its cell. It does so in every frame, from a copy of the
// field on the GPU (brick_world.h). There is no mesh of the terrain, so an edit is in the picture of the next
// draw(). Blocks of points out of sight, or with nothing but air or rock about, are not drawn. Pieces are
// meshes, made when they come.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client/render/scene/draw_method.h"
#include "client/render/scene/work_pool.h"

namespace scree {

/// The feature that the GL context lacks for this method, as a sentence. Needs the context current.
std::optional<std::string> grid_method_missing();

/// `pool` must outlive the method. Needs the GL context current. Fails when a shader does.
Result<std::unique_ptr<DrawMethod>> make_grid_method(WorkPool& pool, float view_radius_m);

}  // namespace scree
