// Chooses the next place to carve, dig or place: points on the surface of the bot's current copy of the
// terrain. The same seed and the same terrain give the same places.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "proto/messages.h"
#include "shared/base/random.h"
#include "shared/field/field.h"

namespace scree {

/// Shapes that a place and a radius make.
constexpr bool is_centred(ShapeKind kind) {
  return is_known(kind) && !traits_of(kind).has_b;
}
inline constexpr auto bot_shapes = kinds_that<ShapeKind, is_centred>;

struct CarverConfig {
  glm::vec3 centre_m{0.0F};             ///< y is found from the ground
  float area_m = 20.0F;                 ///< half a side of the square; 0: the centre itself, from above
  ShapeKind shape = ShapeKind::crater;  ///< one of bot_shapes
  float radius_m = 2.0F;
  uint32_t seeds = 64;
  /// Nothing: radial and uniform in turn. A pattern that needs points gets those of a wall's stones, every
  /// second course half a stone aside; no more than limits::authored_seeds_max.
  std::optional<SeedPattern> pattern = usual_pattern;
  float blast_speed_m_s = 6.0F;
};

class Carver {
 public:
  Carver(const CarverConfig& config, uint64_t random_seed) : config_(config), random_(random_seed) {}

  struct Target {
    glm::vec3 point_m{0.0F};
    glm::vec3 direction{0.0F};  ///< of the look that found it
  };
  Target aim(Field& field) { return aim_near(field, config_.centre_m, config_.area_m); }
  /// In another square, by its middle and half its side.
  Target aim_near(Field& field, glm::vec3 centre_m, float half_m);

  CarveMessage carve(const Target& target, uint32_t request);
  /// What a carve or a dig there takes out.
  Shape shape_at(const Target& target) const;

 private:
  CarverConfig config_;
  Random random_;
};

}  // namespace scree
