// Messages about the last ticks, for tests of the wire.
#pragma once

#include "proto/messages.h"

namespace scree::samples {

inline SlowTickRow slow_tick() {
  return {.tick = 4200,
          .unix_ms = 1'796'000'000'000,
          .ticks = 3,
          .late_ms = 80.5F,
          .wall_ms = 97.0F,
          .cpu_ms = 96.0F,
          .culprit = "work",
          .stage = "requests",
          .clock_ms = 90.0F,
          .price_ms = 12.5F,
          .party = 7,
          .session = 9,
          .name = "Ann",
          .request = "carve",
          .place_m = glm::vec3(1.0F, 2.0F, 3.0F),
          .words = "1 carve of Ann (session 9) at (1, 2, 3) took 90 ms"};
}

inline PartyRow party() {
  return {.party = 7,
          .sessions = 2,
          .name = "Ann",
          .address = "192.0.2.7",
          .clock_us_per_s = 1500.0F,
          .price_us_per_s = 900.0F,
          .pieces = 64,
          .requests = 12,
          .refused = 3,
          .sent_bytes = 5'000'000'000};
}

inline std::vector<ServerMessage> flight_server_messages() {
  return {AdminListMessage{.request = 8, .slow_ticks = {slow_tick(), SlowTickRow{.tick = 1}}},
          AdminListMessage{.request = 9, .parties = {party(), PartyRow{}}}};
}

inline std::vector<ClientMessage> flight_client_messages() {
  return {AdminMessage{22, "", ListFlightRequest{FlightList::worst, 300, 5}},
          AdminMessage{23, "", ListFlightRequest{FlightList::parties, 0, 0}},
          AdminMessage{24, "", ListLinesRequest{LinesOf::figures, 60}}};
}

}  // namespace scree::samples
