#include "server/world/shared_brick.h"

namespace scree {

std::shared_ptr<const Brick> shared_copy(const Brick& brick) {
  static const auto air = std::make_shared<const Brick>(air_brick());
  static const auto solid = std::make_shared<const Brick>(solid_brick());
  const Brick* const uniform = uniform_equivalent(brick);
  if (uniform == nullptr) return std::make_shared<const Brick>(brick);
  return uniform == &air_brick() ? air : solid;
}

}  // namespace scree
