// Refuses shapes and motions that no Bodies has: they come from files. Private to this folder.
#pragma once

#include "server/bodies/bodies.h"

namespace scree {

/// An error about that body.
Result<void> refuse_body(PieceId id, const char* what);
Result<void> check_shape(PieceId id, const BodyShape& shape);
Result<void> check_motion(const BodyMotion& motion);

}  // namespace scree
