#include "server/formats/event_codec.h"

#include <algorithm>
#include <fmt/format.h>
#include <recording.pb.h>

#include "proto/limits.h"
#include "server/formats/cursor_samples.h"
#include "server/formats/recording_values.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

namespace {

using RecordedEvents = google::protobuf::RepeatedPtrField<recorded::Event>;

void write(RecordedEvents& to, std::span<const Event> events, Tick last) {
  for (const Event& event : events.first(std::min(events.size(), limits::events_per_row_max))) {
    recorded::Event& made = *to.Add();
    made.set_kind(static_cast<uint32_t>(event.kind));
    made.set_ticks_ago(static_cast<uint32_t>(last - event.tick));
    if (event.place_m) scree::write(*made.mutable_place_m(), *event.place_m);
    made.set_volume_m3(event.volume_m3);
    made.set_pieces(event.pieces);
    made.set_session(event.session);
    made.set_ms(event.ms);
    made.set_text(showable(event.text, limits::event_text_bytes_max));
    made.set_token_id(event.token_id);
    made.set_body(event.body);
    made.set_other(event.other);
    made.set_tag(event.tag);
    if (event.normal != glm::vec3(0.0F)) scree::write(*made.mutable_normal(), event.normal);
    made.set_impulse_n_s(event.impulse_n_s);
    made.set_energy_j(event.energy_j);
    made.set_left_out(event.left_out);
  }
}

/// Reads the members that contacts, props and joints have.
void read_bodies(const recorded::Event& from, Event& to, FieldChecker& check) {
  to.body = from.body();
  to.other = from.other();
  to.tag = from.tag();
  if (from.has_normal()) to.normal = check.vec3(from.normal(), "normal of an event");
  to.impulse_n_s = check.not_negative(from.impulse_n_s(), "impulse of an event");
  to.energy_j = check.not_negative(from.energy_j(), "energy of an event");
  to.left_out = from.left_out();
}

std::vector<Event> read(const RecordedEvents& from, Tick last, bool of_machine, FieldChecker& check) {
  std::vector<Event> events;
  if (static_cast<size_t>(from.size()) > limits::events_per_row_max)
    check.refuse(fmt::format("{} events (limits.events_per_row_max)", from.size()));
  for (const recorded::Event& event : from) {
    if (check.failed()) break;
    Event made;
    made.kind = check.kind<EventKind>(event.kind(), "kind of event");
    if (!check.failed() && traits_of(made.kind).of_machine != of_machine)
      check.refuse("an event of the machine among those of the world, or the other way round");
    made.tick = last - check.within(event.ticks_ago(), 0,
                                    static_cast<uint32_t>(std::min<Tick>(last, limits::ticks_per_row_max)),
                                    "age of an event");
    if (event.has_place_m()) made.place_m = check.vec3(event.place_m(), "place of an event");
    made.volume_m3 = check.not_negative(event.volume_m3(), "volume of an event");
    made.pieces = event.pieces();
    made.session = event.session();
    made.ms = check.not_negative(event.ms(), "duration of an event");
    made.text = check.text(event.text(), limits::event_text_bytes_max, "text of an event");
    made.token_id = event.token_id();
    read_bodies(event, made, check);
    events.push_back(std::move(made));
  }
  return events;
}

}  // namespace

std::vector<uint8_t> encode(std::span<const Event> events) {
  recorded::Events to;
  const Tick tick = events.empty() ? 0 : events.front().tick;
  write(*to.mutable_events(), events, tick);
  return bytes_of(to);
}

Result<std::vector<Event>> decode_recorded_events(std::span<const uint8_t> bytes, Tick tick) {
  const auto from = TRY(parsed<recorded::Events>(bytes, "events of the recording"));
  FieldChecker check("events of the recording");
  return checked(read(from.events(), tick, false, check), check);
}

std::vector<uint8_t> encode(const RecordedMachine& machine) {
  recorded::Machine to;
  for (const uint32_t us : machine.tick_us) to.add_tick_us(us);
  write(*to.mutable_events(), machine.events, machine.tick);
  to.set_tick(machine.tick);
  CHECK(machine.tick_us.size() <= machine.tick);
  to.set_unix_ms(machine.unix_ms);
  for (const Participant& person :
       std::span(machine.persons).first(std::min(machine.persons.size(), limits::persons_per_row_max))) {
    recorded::Person& made = *to.add_persons();
    made.set_session(person.session);
    made.set_name(showable(person.name, limits::person_name_bytes_max));
    made.set_token_id(person.token_id);
  }
  to.set_cursors(to_string(pack(machine.cursors, machine.tick + 1 - machine.tick_us.size())));
  return bytes_of(to);
}

Result<RecordedMachine> decode_recorded_machine(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<recorded::Machine>(bytes, "durations of the recording"));
  FieldChecker check("durations of the recording");
  RecordedMachine machine;
  machine.tick = from.tick();
  if (from.tick_us().empty() || from.tick_us_size() > static_cast<int>(limits::ticks_per_row_max) ||
      static_cast<Tick>(from.tick_us_size()) > machine.tick)
    check.refuse(fmt::format("{} durations up to tick {} (limits.ticks_per_row_max)", from.tick_us_size(),
                             machine.tick));
  machine.tick_us.assign(from.tick_us().begin(), from.tick_us().end());
  machine.events = read(from.events(), machine.tick, true, check);
  machine.unix_ms = from.unix_ms();
  if (static_cast<size_t>(from.persons_size()) > limits::persons_per_row_max)
    check.refuse(fmt::format("{} persons (limits.persons_per_row_max)", from.persons_size()));
  for (const recorded::Person& person : from.persons()) {
    if (check.failed()) break;
    machine.persons.push_back({person.session(),
                               check.text(person.name(), limits::person_name_bytes_max, "name of a person"),
                               person.token_id()});
  }
  if (!check.failed())
    machine.cursors =
        unpack_cursors(from.cursors(), machine.tick + 1 - machine.tick_us.size(), machine.tick, check);
  return checked(std::move(machine), check);
}

}  // namespace scree
