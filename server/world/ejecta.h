// How the rock that a blast breaks flies off: as the ejecta of a crater, so that it lands beyond the rim and
// the hole stays one. Deterministic; metres, seconds.
//
// In the flow of a crater rock leaves along paths that bend outward (Z-model: D. E. Maxwell, in Impact and
// Explosion Cratering, 1977), all at like angles. Here a piece sets out away from a place below the charge:
// so no paths cross, what was near the rim leaves at 55°, and what lay straight below falls back. Its speed
// falls with its distance x from the charge as (x/R)^(−1/μ) · (1 − x/n₂R)^½ (K. R. Housen and K. A.
// Holsapple, Ejecta from impact craters, Icarus 211, 2011), and grows with the root of the crater's radius
// R: the rock is broken already, and its weight alone holds it.
#pragma once

#include <glm/vec3.hpp>

namespace scree {

/// A charge that breaks a ball of rock about itself.
struct Burst {
  glm::vec3 centre_m{0.0F};
  float radius_m = 1.0F;  ///< positive
  float speed_m_s = 0.0F;
};

struct EjectedMotion {
  glm::vec3 direction{0.0F};
  float speed_m_s = 0.0F;
};

/// The speed by which the law of Burst's ejecta is scaled: what it gives where the law's factors are 1.
float ejecta_speed_m_s(float radius_m);

/// How a piece flies off whose centre was there. `open_side` (at most a unit vector) is where the crater
/// opens; where it does not, all flies away from the charge.
EjectedMotion ejected(const Burst& burst, glm::vec3 open_side, glm::vec3 place_m);

}  // namespace scree
