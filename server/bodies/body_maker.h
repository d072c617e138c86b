// Makes rigid bodies of pieces' shapes. Private to this folder.
#pragma once

#include <memory>
#include <vector>

#include "server/bodies/body.h"
#include "server/bodies/body_speeds.h"

namespace scree {

/// A body of that shape, which lies nowhere, is in no world yet, and has no probe. `points_m`: Body::points_m
/// of a body of that shape, which are most of the work; empty: they are found.
Body make_body(PieceId id, std::shared_ptr<const BodyShape> given, std::vector<glm::vec3> points_m,
               const StepSize& step);

}  // namespace scree
