#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const SlowTickRow& row) {
  Json place = nullptr;
  if (row.place_m) place = {row.place_m->x, row.place_m->y, row.place_m->z};
  return {{"time", iso_time(row.unix_ms)}, {"tick", row.tick},         {"ticks", row.ticks},
          {"culprit", row.culprit},        {"words", row.words},       {"late_ms", row.late_ms},
          {"wall_ms", row.wall_ms},        {"cpu_ms", row.cpu_ms},     {"stage", row.stage},
          {"clock_ms", row.clock_ms},      {"price_ms", row.price_ms}, {"party", row.party},
          {"session", row.session},        {"name", row.name},         {"request", row.request},
          {"place", std::move(place)}};
}

Json json_of(const PartyRow& row) {
  return {{"party", row.party},
          {"sessions", row.sessions},
          {"name", row.name},
          {"address", row.address},
          {"clock_us_per_s", row.clock_us_per_s},
          {"price_us_per_s", row.price_us_per_s},
          {"pieces", row.pieces},
          {"requests", row.requests},
          {"refused", row.refused},
          {"sent_bytes", row.sent_bytes}};
}

template <typename Row>
std::string json_rows(const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const Row& row : rows) list.push_back(json_of(row));
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string slow_ticks_json(const AdminListMessage& list) {
  return json_rows(list.slow_ticks);
}

std::string slow_ticks_lines(const AdminListMessage& list) {
  std::string lines;
  for (const SlowTickRow& row : list.slow_ticks) {
    const std::string more = row.ticks > 1 ? fmt::format(" and {} more", row.ticks - 1) : "";
    lines += fmt::format("{}  tick {}{}, {:.0f} ms late: {}\n", iso_time(row.unix_ms), row.tick, more,
                         row.late_ms, row.words);
  }
  return lines.empty() ? "no tick was slow\n" : lines;
}

std::string parties_json(const AdminListMessage& list) {
  return json_rows(list.parties);
}

std::string parties_lines(const AdminListMessage& list) {
  std::string lines =
      "  party  sessions  work ms/s  price ms/s  pieces   requests  refused       sent  name, address\n";
  for (const PartyRow& row : list.parties) {
    const bool is_server = row.party == 0;
    lines += fmt::format("{:>7}  {:>8}  {:>9.2f}  {:>10.2f}  {:>6}  {:>9}  {:>7}  {:>6.1f} MB  {}\n",
                         row.party, row.sessions, row.clock_us_per_s / 1e3F, row.price_us_per_s / 1e3F,
                         row.pieces, row.requests, row.refused, static_cast<double>(row.sent_bytes) / 1e6,
                         is_server ? "the server itself" : fmt::format("{}, {}", row.name, row.address));
  }
  return lines;
}

}  // namespace scree
