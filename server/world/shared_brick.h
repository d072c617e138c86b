// Bricks as the world's deltas share them: immutable, from any thread.
#pragma once

#include <memory>

#include "shared/field/brick.h"

namespace scree {

/// A copy; all uniform bricks of one kind are the same object.
std::shared_ptr<const Brick> shared_copy(const Brick& brick);

}  // namespace scree
