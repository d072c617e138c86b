// What a server keeps of its last ticks, in words, line by line, as the examples of docs/protocol.md state
// it.
#pragma once

#include <fmt/format.h>
#include <string>
#include <vector>

#include "proto/messages.h"

namespace scree {

inline std::vector<std::string> words(const ListFlightRequest& list) {
  return {fmt::format("list ticks: {}, of {} s, {} rows", name_of(list.list), list.since_s, list.most)};
}

inline std::vector<std::string> words(const SlowTickRow& row) {
  const std::string place =
      row.place_m ? fmt::format(" at ({}, {}, {})", row.place_m->x, row.place_m->y, row.place_m->z) : "";
  return {fmt::format("tick {} at {}, {} slow: {} ms late, {} ms, {} ms on a processor, {}", row.tick,
                      row.unix_ms, row.ticks, row.late_ms, row.wall_ms, row.cpu_ms, row.culprit),
          fmt::format("stage '{}' {} ms, price {} ms, party {}, session {} '{}', request '{}'{}", row.stage,
                      row.clock_ms, row.price_ms, row.party, row.session, row.name, row.request, place),
          "words: " + row.words};
}

inline std::string words(const PartyRow& row) {
  return fmt::format(
      "party {}: {} sessions, '{}' from '{}', {} us/s, price {} us/s, {} pieces, {} requests, {} refused, {} "
      "bytes",
      row.party, row.sessions, row.name, row.address, row.clock_us_per_s, row.price_us_per_s, row.pieces,
      row.requests, row.refused, row.sent_bytes);
}

}  // namespace scree
