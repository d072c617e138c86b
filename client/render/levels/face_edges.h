// How edges of flat faces are drawn.
#pragma once

namespace scree {

/// Sharp (creases.h, face_plane.h), or rounded as the values between codes are. Coarse samples of edits know
/// no faces, so there edges are rounded.
enum class FaceEdges { rounded, sharp };

}  // namespace scree
