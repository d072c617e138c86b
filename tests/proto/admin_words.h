// Administrators' acts in words, as message_words.h.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <vector>

#include "proto/admin_message.h"
#include "shared/base/overloaded.h"
#include "tests/proto/flight_words.h"
#include "tests/proto/history_words.h"

namespace scree {

inline std::string box_words(const std::optional<PlacesWithin>& box) {
  return box ? place_words(box->lo_m) + " to " + place_words(box->hi_m) : "everywhere";
}
inline std::vector<std::string> admin_words(const AdminRequest& act) {
  using Lines = std::vector<std::string>;
  return std::visit(
      Overloaded{[](const SettingsRequest& request) {
                   Lines lines;
                   for (const SettingValue& setting : request.settings)
                     lines.push_back(fmt::format("setting: {} = {}", setting.name, setting.value));
                   return lines;
                 },
                 [](const ListSessionsRequest&) { return Lines{"list sessions"}; },
                 [](const KickRequest& kick) {
                   return Lines{fmt::format("kick: session {}, reason '{}'", kick.session, kick.reason)};
                 },
                 [](const BanRequest& ban) {
                   return Lines{fmt::format("ban: session {}, address '{}', {} minutes, reason '{}'",
                                            ban.session, ban.address, ban.minutes, ban.reason)};
                 },
                 [](const ListBansRequest&) { return Lines{"list bans"}; },
                 [](const ListBodiesRequest& list) {
                   return Lines{
                       fmt::format("list bodies: {}, ids {}", box_words(list.within),
                                   list.ids.empty() ? "all" : fmt::format("{}", fmt::join(list.ids, " ")))};
                 },
                 [](const ListJointsRequest& list) {
                   return Lines{fmt::format("list joints: {}", box_words(list.within))};
                 },
                 [](const ListStoresRequest&) { return Lines{"list stores"}; },
                 [](const HistoryRequest& history) { return history_words(history); },
                 [](const UndoRequest& undo) { return undo_words(undo); },
                 [](const ListFlightRequest& list) { return words(list); },
                 [](const ListLinesRequest& list) {
                   return std::vector{fmt::format("list lines: {}, {}", name_of(list.of), list.most)};
                 },
                 [](const ListRegionMassesRequest& list) { return Lines{"list masses of " + list.region}; },
                 [](const ControlRulesRequest& c) {
                   return Lines{fmt::format("rules: {} '{}', '{}'", name_of(c.control), c.rules, c.line)};
                 },
                 [](const ControlReplayRequest& control) {
                   return Lines{fmt::format("control replay: {}, speed {}, {} {}", name_of(control.play),
                                            control.speed, name_of(control.move), control.value)};
                 },
                 [](const LiftBanRequest& lift) {
                   return Lines{fmt::format("lift ban: address '{}'", lift.address)};
                 }},
      act);
}

}  // namespace scree
