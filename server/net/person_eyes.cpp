#include "server/net/person_eyes.h"

#include <glm/geometric.hpp>

#include "server/net/limits.h"
#include "shared/person/walker.h"

namespace scree {

namespace {

bool edits_somewhere(const Request& request) {
  return shape_of(request).has_value() || place_of(request) != nullptr;
}

}  // namespace

glm::vec3 believed_eye_m(const PublishedState& world, uint64_t session, glm::vec3 told_m) {
  const PersonPlace* const person = world.person_of(session);
  if (person == nullptr) return told_m;
  const glm::vec3 eye_m = Walker(person->walker).eye_m();
  return glm::distance(eye_m, told_m) <= limits::eye_off_person_m ? told_m : eye_m;
}

tl::expected<void, Refused> look_from_person(const PublishedState& world, const ServiceLimits& service,
                                             uint64_t session, const Request& request, SessionEntry& entry) {
  if (const PersonPlace* const person = world.person_of(session)) {
    entry.eye_m = Walker(person->walker).eye_m();
    return {};
  }
  if (service.persons != Persons::walk || !edits_somewhere(request) ||
      may_act_as(entry.grant.role, Role::director))
    return {};
  return refuse(Refusal::not_on_foot,
                "who is not on foot edits nothing here, because persons walk (persons): stand first");
}

}  // namespace scree
