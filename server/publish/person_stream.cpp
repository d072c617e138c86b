#include "server/publish/person_stream.h"

#include "proto/limits.h"

namespace scree {

void PersonStream::serve(const ServedTick& tick, bool with_poses, Outlet& outlet, ServedPart& part) {
  const PublishedState& state = tick.changes.state;
  const bool is_new = state.persons_version() != version_;
  if (!with_poses && !is_new) return;
  const PersonPlace* const place = state.person_of(outlet.session());
  PersonPlacesMessage message;
  message.tick = tick.tick();
  if (place != nullptr && own_ != OwnPerson{place->taken, place->walker})
    message.own = OwnPerson{place->taken, place->walker};
  if (is_new) {
    message.persons.emplace();
    for (const PersonPlace& person : state.persons())
      if (message.persons->size() < limits::person_bodies_max)
        message.persons->push_back({person.session, person.body});
  }
  if (!message.persons && !message.own) return;
  version_ = state.persons_version();
  own_ = place != nullptr ? std::optional(OwnPerson{place->taken, place->walker}) : std::nullopt;
  outlet.send(share(message), part);
}

}  // namespace scree
