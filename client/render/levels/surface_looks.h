// The looks of a mesh's vertices, as client/shaders/surface.vert reads them: what each lies on, and how far
// rock has gone from there, or has come.
#pragma once

#include "client/render/levels/look_window.h"
#include "shared/surface/surface_mesh.h"

namespace scree {

/// A code of the field as generated, on either side: from here on, nothing of the weathered ground is left.
inline constexpr int worn_all = 58;

/// SurfaceVertex::before for a shader, from such a code: below 0 rock has gone, above it rock has come. Each
/// has four bits, up to worn_all, and is interpolated by itself: where a heap lies on a cut, neither ends.
Code packed_worn(int worn);
/// What was packed, signed, in codes.
int unpacked_worn(Code packed);

/// Sets SurfaceVertex::look. `before` must still be the code of the field as generated.
void set_looks(SurfaceMesh& mesh, const Window& now, const LookWindow& looks);

/// Divides triangles between vertices of different looks half-way, so that every triangle has one. Edges of
/// two triangles stay edges of two.
void part_looks(SurfaceMesh& mesh);

}  // namespace scree
