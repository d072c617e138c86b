#include "shared/person/person_body.h"

#include "shared/person/walker.h"

namespace scree {

Prop body_of_person(uint64_t session, float mass_kg) {
  Prop prop;
  constexpr float half_m = 0.5F * Walker::height_m - Walker::radius_m;
  prop.parts = {{.kind = PropPartKind::capsule, .half_m = glm::vec3(Walker::radius_m, half_m, 0.0F)}};
  prop.motion = PropMotion::kinematic;
  prop.mass_kg = mass_kg;
  prop.tag = session;
  return prop;
}

std::optional<uint64_t> person_of_body(const Prop& prop) {
  if (prop.motion != PropMotion::kinematic || prop.tag == 0) return std::nullopt;
  if (prop.parts != body_of_person(prop.tag, prop.mass_kg).parts) return std::nullopt;
  return prop.tag;
}

}  // namespace scree
