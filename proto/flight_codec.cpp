#include "proto/flight_codec.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/limits.h"
#include "shared/base/text.h"

namespace scree {

namespace {

SlowTickRow read(const wire::SlowTick& from, FieldChecker& check) {
  SlowTickRow row;
  row.tick = from.tick();
  row.unix_ms = from.unix_ms();
  row.ticks = from.ticks();
  row.late_ms = check.not_negative(from.late_ms(), "lateness of a tick");
  row.wall_ms = check.not_negative(from.wall_ms(), "time of a tick");
  row.cpu_ms = check.not_negative(from.cpu_ms(), "time of a tick on a processor");
  row.culprit = check.text(from.culprit(), limits::flight_word_bytes_max, "cause of a slow tick");
  row.stage = check.text(from.stage(), limits::flight_word_bytes_max, "stage of a slow tick");
  row.clock_ms = check.not_negative(from.clock_ms(), "time of work");
  row.price_ms = check.not_negative(from.price_ms(), "price of work");
  row.party = from.party();
  row.session = from.session();
  row.name = check.text(from.name(), limits::person_name_bytes_max, "name of a person");
  row.request = check.text(from.request(), limits::flight_word_bytes_max, "kind of a request");
  if (from.has_place()) row.place_m = check.vec3(from.place(), "place of work");
  row.words = check.text(from.words(), limits::admin_reason_bytes_max, "words on a slow tick");
  return row;
}

PartyRow read(const wire::PartyRow& from, FieldChecker& check) {
  PartyRow row;
  row.party = from.party();
  row.sessions = from.sessions();
  row.name = check.text(from.name(), limits::person_name_bytes_max, "name of a party");
  row.address = check.text(from.address(), limits::address_bytes_max, "address of a party");
  row.clock_us_per_s = check.not_negative(from.clock_us_per_s(), "work of a party");
  row.price_us_per_s = check.not_negative(from.price_us_per_s(), "price of a party's work");
  row.pieces = from.pieces();
  row.requests = from.requests();
  row.refused = from.refused();
  row.sent_bytes = from.sent_bytes();
  return row;
}

void write(wire::SlowTick& to, const SlowTickRow& from) {
  to.set_tick(from.tick);
  to.set_unix_ms(from.unix_ms);
  to.set_ticks(from.ticks);
  to.set_late_ms(from.late_ms);
  to.set_wall_ms(from.wall_ms);
  to.set_cpu_ms(from.cpu_ms);
  to.set_culprit(showable(from.culprit, limits::flight_word_bytes_max));
  to.set_stage(showable(from.stage, limits::flight_word_bytes_max));
  to.set_clock_ms(from.clock_ms);
  to.set_price_ms(from.price_ms);
  to.set_party(from.party);
  to.set_session(from.session);
  to.set_name(showable(from.name, limits::person_name_bytes_max));
  to.set_request(showable(from.request, limits::flight_word_bytes_max));
  if (from.place_m) scree::write(*to.mutable_place(), *from.place_m);
  to.set_words(showable(from.words, limits::admin_reason_bytes_max));
}

void write(wire::PartyRow& to, const PartyRow& from) {
  to.set_party(from.party);
  to.set_sessions(from.sessions);
  to.set_name(showable(from.name, limits::person_name_bytes_max));
  to.set_address(showable(from.address, limits::address_bytes_max));
  to.set_clock_us_per_s(from.clock_us_per_s);
  to.set_price_us_per_s(from.price_us_per_s);
  to.set_pieces(from.pieces);
  to.set_requests(from.requests);
  to.set_refused(from.refused);
  to.set_sent_bytes(from.sent_bytes);
}

}  // namespace

void write(wire::ListFlight& to, const ListFlightRequest& from) {
  to.set_list(static_cast<wire::FlightList>(from.list));
  to.set_since_s(from.since_s);
  to.set_most(from.most);
}

void write_flight(wire::AdminList& to, const AdminListMessage& from) {
  const size_t slow = std::min(from.slow_ticks.size(), limits::slow_rows_max);
  for (size_t i = from.slow_ticks.size() - slow; i < from.slow_ticks.size(); ++i)
    write(*to.add_slow_ticks(), from.slow_ticks[i]);
  for (size_t i = 0; i < std::min(from.parties.size(), limits::admin_rows_max); ++i)
    write(*to.add_parties(), from.parties[i]);
}

ListFlightRequest read(const wire::ListFlight& from, FieldChecker& check) {
  return {check.asked_kind<FlightList>(from.list(), "list of ticks"), from.since_s(),
          check.within(from.most(), 0, static_cast<uint32_t>(limits::slow_rows_max), "rows of ticks")};
}

void read_flight(const wire::AdminList& from, AdminListMessage& to, FieldChecker& check) {
  if (static_cast<size_t>(from.slow_ticks_size()) > limits::slow_rows_max ||
      static_cast<size_t>(from.parties_size()) > limits::admin_rows_max)
    return check.refuse(fmt::format("{} ticks and {} parties are over the limit", from.slow_ticks_size(),
                                    from.parties_size()));
  for (const wire::SlowTick& row : from.slow_ticks()) to.slow_ticks.push_back(read(row, check));
  for (const wire::PartyRow& row : from.parties()) to.parties.push_back(read(row, check));
}

}  // namespace scree
