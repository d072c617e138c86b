#include "server/world/request_cost.h"

namespace scree {

namespace {

/// Where it acts; the origin where it is of no place.
glm::vec3 where(const Request& request) {
  if (const std::optional<Shape> shape = shape_of(request)) return centre_of(*shape);
  const glm::vec3* const place_m = place_of(request);
  return place_m == nullptr ? glm::vec3(0.0F) : *place_m;
}

}  // namespace

RequestCost cost_of(const Command& command, float price_us, double clock_ms) {
  return {command.session,
          party_of(command),
          static_cast<uint8_t>(command.body.index()),
          price_us,
          static_cast<float>(1e3 * clock_ms),
          where(command.body)};
}

}  // namespace scree
