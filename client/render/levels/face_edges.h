// How edges of flat faces are drawn.
#pragma once

#include "shared/field/terrain.h"

namespace scree {

/// Sharp (creases.h, face_plane.h), or rounded as the values between codes are. Coarse samples of edits know
/// no faces, so there edges are rounded.
enum class FaceEdges { rounded, sharp };

/// Whether the ground as generated has no edges: it is made of smooth functions, and where two of these meet,
/// as a cliff and the ground before it, what looks like an edge has no flat faces. Ground from files may be
/// of buildings.
inline bool has_smooth_ground(const TerrainSource& source) {
  return source.heights == nullptr;
}

}  // namespace scree
