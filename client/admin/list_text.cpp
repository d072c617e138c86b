#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const SessionRow& row) {
  char id[17];
  std::snprintf(id, sizeof id, "%016llx", static_cast<unsigned long long>(row.token_id));
  return {{"session", row.session},    {"name", row.name},
          {"program", row.program},    {"address", row.address},
          {"role", name_of(row.role)}, {"token", row.token_id == 0 ? "" : id},
          {"joined_s", row.joined_s},  {"sent_bytes", row.sent_bytes},
          {"tls", row.encrypted}};
}

Json json_of(const BanRow& row) {
  return {{"address", row.address}, {"left_s", row.left_s}, {"reason", row.reason}};
}

/// Names come from the wire: bytes that are no UTF-8 are replaced, so that nothing is thrown.
std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// In the unit of a person, rounded up: "42 s", "59 min", "1 h 5 min", "12 d 4 h".
std::string length_in_words(uint64_t seconds) {
  constexpr uint64_t minute_s = 60, hour_s = 60 * minute_s, day_s = 24 * hour_s;
  const auto two = [](uint64_t count, uint64_t per, const char* large, const char* small) {
    const std::string rest = count % per == 0 ? "" : " " + std::to_string(count % per) + small;
    return std::to_string(count / per) + large + rest;
  };
  if (seconds < minute_s) return std::to_string(seconds) + " s";
  const uint64_t minutes = (seconds + minute_s - 1) / minute_s, hours = (seconds + hour_s - 1) / hour_s;
  if (minutes < hour_s / minute_s) return std::to_string(minutes) + " min";
  return minutes * minute_s < day_s ? two(minutes, hour_s / minute_s, " h", " min")
                                    : two(hours, day_s / hour_s, " d", " h");
}

template <typename Row>
std::string json_list(const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const Row& row : rows) list.push_back(json_of(row));
  return text_of(list, 2) + "\n";
}

}  // namespace

std::string sessions_json(const std::vector<SessionRow>& sessions) {
  return json_list(sessions);
}

std::string bans_json(const std::vector<BanRow>& bans) {
  return json_list(bans);
}

std::string sessions_lines(const std::vector<SessionRow>& sessions) {
  std::string lines =
      "session  role     address                   seconds        bytes  tls  name, program\n";
  for (const SessionRow& row : sessions) {
    char line[256];
    std::snprintf(line, sizeof line, "%7llu  %-7s  %-24s %8u %12llu  %-3s  %s, %s\n",
                  static_cast<unsigned long long>(row.session), std::string(name_of(row.role)).c_str(),
                  row.address.c_str(), row.joined_s, static_cast<unsigned long long>(row.sent_bytes),
                  row.encrypted ? "yes" : "no", row.name.c_str(), row.program.c_str());
    lines += line;
  }
  return lines;
}

std::string bans_lines(const std::vector<BanRow>& bans) {
  std::string lines;
  for (const BanRow& row : bans)
    lines += row.address +
             (row.left_s == 0 ? ", until it is lifted" : ", for " + length_in_words(row.left_s)) +
             (row.reason.empty() ? "" : ": " + row.reason) + "\n";
  return lines;
}

}  // namespace scree
