// The looks of a mesh's vertices, as client/shaders/surface.vert reads them: what each lies on, and how far
// rock has gone from there, or has come.
#pragma once

#include <functional>
#include <vector>

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
/// How far rock has come, by what was packed, in steps.
inline int unpacked_come(Code packed) {
  return static_cast<uint8_t>(packed) >> 4;
}

/// Whether a cut laid the surface bare where the vertex lies, at p in the window's voxels.
using IsCut = std::function<bool(const SurfaceVertex&, glm::vec3 p)>;

/// Sets SurfaceVertex::look. It depends on the vertex's place and the window, but not on its normal, which
/// meshes that share a vertex may round each its own way.
void set_looks(SurfaceMesh& mesh, const Window& now, const LookWindow& looks, const IsCut& is_cut);

/// Divides triangles between vertices of different looks half-way, so that every triangle has one. Edges of
/// two triangles stay edges of two. Between two vertices in `coarse`, which may be empty, half-way is a place
/// that the mesh of the next coarser level can have, too.
void part_looks(SurfaceMesh& mesh, const std::vector<bool>& coarse = {});

}  // namespace scree
