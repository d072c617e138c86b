// What holds terrain besides the ground (ground.h), for the searches that ask what falls or breaks.
#pragma once

#include "shared/field/brick_bits.h"

namespace scree {

class Holding {
 public:
  virtual ~Holding() = default;
  /// Whether one of these solid voxels of a brick is held, and with it what it hangs together with. A search
  /// asks it of parts in its own order.
  virtual bool holds(BrickCoord brick, const BrickBits& bits) const = 0;
};

}  // namespace scree
