// How surface.vert reads SurfaceVertex. Needs the GL context current.
#pragma once

namespace scree {

/// Describes the vertices of the bound array object and buffer.
void describe_surface_vertices();

}  // namespace scree
