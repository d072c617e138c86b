#include "proto/person_codec.h"

#include <fmt/format.h>

#include "proto/limits.h"
#include "shared/person/walker.h"

namespace scree {

namespace {

void write_own(wire::OwnPerson& to, const OwnPerson& from) {
  to.set_taken(from.taken);
  scree::write(*to.mutable_feet(), from.walker.feet_m);
  scree::write(*to.mutable_speed_m_s(), from.walker.speed_m_s);
  to.set_time_left_s(from.walker.time_left_s);
  to.set_stands(from.walker.stands);
  to.set_still_ticks(static_cast<uint32_t>(from.walker.still_ticks));
  if (from.walker.pace != 1.0F) to.set_pace(from.walker.pace);
}

OwnPerson read_own(const wire::OwnPerson& from, FieldChecker& check) {
  OwnPerson own;
  own.taken = from.taken();
  own.walker.feet_m = check.vec3(from.feet(), "feet of a person");
  own.walker.speed_m_s = check.vec3(from.speed_m_s(), "speed of a person");
  own.walker.time_left_s = check.finite(from.time_left_s(), "time_left_s");
  own.walker.stands = from.stands();
  own.walker.still_ticks =
      static_cast<int32_t>(check.within(from.still_ticks(), 0, INT32_MAX, "still_ticks"));
  if (from.has_pace()) own.walker.pace = check.finite(from.pace(), "pace of a person");
  if (!is_walker_state(own.walker)) check.refuse("a person on foot is as none can be");
  return own;
}

}  // namespace

void write(wire::Stand& to, const StandMessage& from) {
  to.set_request(from.request);
  if (from.place_m) write(*to.mutable_place(), *from.place_m);
  to.set_away(from.away);
}

void write(wire::Walk& to, const WalkMessage& from) {
  to.set_number(from.request);
  to.set_x(from.input.go.x);
  to.set_z(from.input.go.z);
  to.set_fast(from.input.fast);
  to.set_jump(from.input.jump);
  write(*to.mutable_look(), from.look);
}

void write(wire::PersonPlaces& to, const PersonPlacesMessage& from) {
  to.set_tick(from.tick);
  to.set_listed(from.persons.has_value());
  if (from.persons)
    for (const PersonBody& person : *from.persons) {
      wire::PersonBody& added = *to.add_persons();
      added.set_session(person.session);
      added.set_body(person.body);
    }
  if (from.own) write_own(*to.mutable_own(), *from.own);
}

StandMessage read(const wire::Stand& from, FieldChecker& check) {
  StandMessage stand;
  stand.request = from.request();
  if (from.has_place()) stand.place_m = check.vec3(from.place(), "place of a person");
  stand.away = from.away();
  return stand;
}

WalkMessage read(const wire::Walk& from, FieldChecker& check) {
  WalkMessage walk;
  walk.request = from.number();
  walk.input.go = {check.finite(from.x(), "x of an input"), 0.0F, check.finite(from.z(), "z of an input")};
  walk.input.fast = from.fast();
  walk.input.jump = from.jump();
  walk.look = check.vec3(from.look(), "look of an input");
  return walk;
}

PersonPlacesMessage read(const wire::PersonPlaces& from, FieldChecker& check) {
  PersonPlacesMessage places;
  places.tick = from.tick();
  if (static_cast<size_t>(from.persons_size()) > limits::person_bodies_max)
    check.refuse(
        fmt::format("{} persons are over the limit of {}", from.persons_size(), limits::person_bodies_max));
  if (from.listed()) {
    places.persons.emplace();
    for (int i = 0; i < from.persons_size() && !check.failed(); ++i) {
      const PersonBody person{from.persons(i).session(), from.persons(i).body()};
      if (!places.persons->empty() && places.persons->back().session >= person.session)
        check.refuse("persons are not in the order of their sessions");
      places.persons->push_back(person);
    }
  }
  if (from.has_own()) places.own = read_own(from.own(), check);
  return places;
}

}  // namespace scree
