#include "proto/admin_codec.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "proto/body_list_codec.h"
#include "proto/flight_codec.h"
#include "proto/game_codec.h"
#include "proto/limits.h"
#include "proto/playback_codec.h"
#include "proto/store_codec.h"
#include "shared/base/text.h"
#include "shared/region/limits.h"

namespace scree {

namespace {

void write_history(wire::ListHistory& to, const HistoryRequest& from) {
  if (from.at_m) write(*to.mutable_at(), *from.at_m);
  to.set_radius_m(from.radius_m);
  to.set_by(showable(from.by, limits::author_bytes_max));
  to.set_since_s(from.since_s);
  to.set_as_json(from.as_json);
}

void write_undo(wire::Undo& to, const UndoRequest& from) {
  to.set_mode(static_cast<wire::UndoMode>(from.mode));
  to.set_by(showable(from.by, limits::author_bytes_max));
  to.set_since_s(from.since_s);
  to.set_to_tick(from.to_tick);
  to.set_show_session(from.show_session);
  if (from.lo_m) write(*to.mutable_lo(), *from.lo_m);
  if (from.hi_m) write(*to.mutable_hi(), *from.hi_m);
  to.set_as_json(from.as_json);
}

struct WritingAct {
  wire::Admin& to;

  void operator()(const SettingsRequest& from) const { write(*to.mutable_settings(), from.settings); }
  void operator()(const ListSessionsRequest&) const { to.mutable_list_sessions(); }
  void operator()(const KickRequest& from) const {
    to.mutable_kick()->set_session(from.session);
    to.mutable_kick()->set_reason(showable(from.reason, limits::admin_reason_bytes_max));
  }
  void operator()(const BanRequest& from) const {
    wire::Ban& ban = *to.mutable_ban();
    ban.set_session(from.session);
    ban.set_address(showable(from.address, limits::address_bytes_max));
    ban.set_minutes(from.minutes);
    ban.set_reason(showable(from.reason, limits::admin_reason_bytes_max));
  }
  void operator()(const ListBansRequest&) const { to.mutable_list_bans(); }
  void operator()(const LiftBanRequest& from) const {
    to.mutable_lift_ban()->set_address(showable(from.address, limits::address_bytes_max));
  }
  void operator()(const ControlReplayRequest& from) const { write(*to.mutable_control_replay(), from); }
  void operator()(const ListBodiesRequest& from) const { write(*to.mutable_list_bodies(), from); }
  void operator()(const ListJointsRequest& from) const { write(*to.mutable_list_joints(), from); }
  void operator()(const ListStoresRequest&) const { to.mutable_list_stores(); }
  void operator()(const ControlRulesRequest& from) const { write(*to.mutable_control_rules(), from); }
  void operator()(const HistoryRequest& from) const { write_history(*to.mutable_list_history(), from); }
  void operator()(const UndoRequest& from) const { write_undo(*to.mutable_undo(), from); }
  void operator()(const ListFlightRequest& from) const { write(*to.mutable_list_flight(), from); }
  void operator()(const ListLinesRequest& from) const {
    to.mutable_list_lines()->set_of(static_cast<wire::LinesOf>(from.of));
    to.mutable_list_lines()->set_most(from.most);
  }
  void operator()(const ListRegionMassesRequest& from) const {
    to.mutable_list_region_masses()->set_region(showable(from.region, limits::region_name_bytes_max));
  }
};

static_assert(wire::UndoMode_ARRAYSIZE == kind_count<UndoMode>);
static_assert(wire::LinesOf_ARRAYSIZE == kind_count<LinesOf>);

HistoryRequest read(const wire::ListHistory& from, FieldChecker& check) {
  HistoryRequest history;
  if (from.has_at()) history.at_m = check.vec3(from.at(), "place of edits");
  history.radius_m = check.not_negative(from.radius_m(), "radius of edits");
  history.by = check.text(from.by(), limits::author_bytes_max, "author of edits");
  history.since_s = from.since_s();
  history.as_json = from.as_json();
  return history;
}

UndoRequest read(const wire::Undo& from, FieldChecker& check) {
  UndoRequest undo;
  undo.mode = check.asked_kind<UndoMode>(from.mode(), "mode of an undo");
  undo.by = check.text(from.by(), limits::author_bytes_max, "author of edits");
  undo.since_s = from.since_s();
  undo.to_tick = from.to_tick();
  undo.show_session = from.show_session();
  if (from.has_lo() != from.has_hi()) check.refuse("a box of an undo has one corner");
  if (from.has_lo()) undo.lo_m = check.vec3(from.lo(), "corner of an undo");
  if (from.has_hi()) undo.hi_m = check.vec3(from.hi(), "corner of an undo");
  undo.as_json = from.as_json();
  return undo;
}

static_assert(wire::ReplayPlay_ARRAYSIZE == kind_count<ReplayPlay>);
static_assert(wire::ReplayMove_ARRAYSIZE == kind_count<ReplayMove>);

float read_replay_speed(float speed, FieldChecker& check) {
  const float times = std::abs(check.finite(speed, "speed of a replay"));
  if (times != 0.0F && (times < replay_speed_least || times > replay_speed_most))
    check.refuse(fmt::format("the speed of a replay is {}, not 0.1 to 16 times real time", speed));
  return speed;
}

ControlReplayRequest read(const wire::ControlReplay& from, FieldChecker& check) {
  return {check.asked_kind<ReplayPlay>(from.play(), "play of a replay"),
          read_replay_speed(from.speed(), check),
          check.asked_kind<ReplayMove>(from.move(), "move of a replay"), from.value()};
}

AdminRequest read_act(const wire::Admin& from, FieldChecker& check) {
  const auto reason = [&](const std::string& text) {
    return check.text(text, limits::admin_reason_bytes_max, "reason");
  };
  const auto address = [&](const std::string& text) {
    return check.text(text, limits::address_bytes_max, "address");
  };
  switch (from.act_case()) {
    case wire::Admin::kListSessions:
      return ListSessionsRequest{};
    case wire::Admin::kKick:
      return KickRequest{from.kick().session(), reason(from.kick().reason())};
    case wire::Admin::kBan:
      return BanRequest{from.ban().session(), address(from.ban().address()),
                        check.within(from.ban().minutes(), 0, limits::ban_minutes_max, "minutes"),
                        reason(from.ban().reason())};
    case wire::Admin::kListBans:
      return ListBansRequest{};
    case wire::Admin::kLiftBan:
      return LiftBanRequest{address(from.lift_ban().address())};
    case wire::Admin::kControlReplay:
      return read(from.control_replay(), check);
    case wire::Admin::kListBodies:
      return read(from.list_bodies(), check);
    case wire::Admin::kListJoints:
      return read(from.list_joints(), check);
    case wire::Admin::kListStores:
      return ListStoresRequest{};
    case wire::Admin::kControlRules:
      return read(from.control_rules(), check);
    case wire::Admin::kListHistory:
      return read(from.list_history(), check);
    case wire::Admin::kUndo:
      return read(from.undo(), check);
    case wire::Admin::kListRegionMasses:
      return ListRegionMassesRequest{
          check.text(from.list_region_masses().region(), limits::region_name_bytes_max, "name of a region")};
    case wire::Admin::kListFlight:
      return read(from.list_flight(), check);
    case wire::Admin::kListLines:
      return ListLinesRequest{check.asked_kind<LinesOf>(from.list_lines().of(), "kind of lines"),
                              from.list_lines().most()};
    case wire::Admin::ACT_NOT_SET:
      break;
  }
  return SettingsRequest{check.settings(from.settings())};
}

SessionRow read(const wire::SessionRow& from, FieldChecker& check) {
  SessionRow row;
  row.session = from.session();
  row.name = check.text(from.name(), limits::person_name_bytes_max, "name of a session");
  row.program = check.text(from.program(), limits::client_name_bytes_max, "program of a session");
  row.address = check.text(from.address(), limits::address_bytes_max, "address of a session");
  row.role = check.kind_or(from.role(), Role::viewer);
  row.token_id = from.token_id();
  row.joined_s = from.joined_s();
  row.sent_bytes = from.sent_bytes();
  row.encrypted = from.encrypted();
  return row;
}

}  // namespace

void write(wire::Admin& to, const AdminMessage& from) {
  to.set_request(from.request);
  to.set_token(showable(from.token, limits::token_bytes_max));
  std::visit(WritingAct{to}, from.act);
}

AdminMessage read_admin(const wire::Admin& from, FieldChecker& check) {
  AdminMessage admin;
  admin.request = from.request();
  admin.token = check.text(from.token(), limits::token_bytes_max, "token");
  admin.act = read_act(from, check);
  return admin;
}

void write(wire::AdminList& to, const AdminListMessage& from) {
  to.set_request(from.request);
  for (size_t i = 0; i < std::min(from.sessions.size(), limits::admin_rows_max); ++i) {
    const SessionRow& row = from.sessions[i];
    wire::SessionRow& added = *to.add_sessions();
    added.set_session(row.session);
    added.set_name(showable(row.name, limits::person_name_bytes_max));
    added.set_program(showable(row.program, limits::client_name_bytes_max));
    added.set_address(showable(row.address, limits::address_bytes_max));
    added.set_role(static_cast<wire::Role>(row.role));
    added.set_token_id(row.token_id);
    added.set_joined_s(row.joined_s);
    added.set_sent_bytes(row.sent_bytes);
    added.set_encrypted(row.encrypted);
  }
  for (size_t i = 0; i < std::min(from.bans.size(), limits::admin_rows_max); ++i) {
    wire::BanRow& added = *to.add_bans();
    added.set_address(showable(from.bans[i].address, limits::address_bytes_max));
    added.set_left_s(from.bans[i].left_s);
    added.set_reason(showable(from.bans[i].reason, limits::admin_reason_bytes_max));
  }
  write_bodies(to, from);
  const size_t stores = std::min(from.stores.size(), limits::stores_a_message);
  for (size_t i = 0; i < stores; ++i) write(*to.add_stores(), from.stores[i]);
  const size_t masses = std::min(from.region_masses.size(), limits::admin_rows_max);
  for (size_t i = 0; i < masses; ++i) write(*to.add_region_masses(), from.region_masses[i]);
  to.set_left_out(to.left_out() +
                  static_cast<uint32_t>(from.stores.size() - stores + from.region_masses.size() - masses));
  to.set_text(from.text.substr(0, limits::admin_text_bytes_max));
  write_flight(to, from);
}

AdminListMessage read_admin_list(const wire::AdminList& from, FieldChecker& check) {
  AdminListMessage list;
  list.request = from.request();
  const auto rows = static_cast<size_t>(std::max({from.sessions_size(), from.bans_size(), from.bodies_size(),
                                                  from.joints_size(), from.region_masses_size()}));
  if (rows > limits::admin_rows_max) {
    check.refuse(fmt::format("{} rows are over the limit of {}", rows, limits::admin_rows_max));
    return list;
  }
  for (const wire::SessionRow& row : from.sessions()) list.sessions.push_back(read(row, check));
  for (const wire::BanRow& row : from.bans())
    list.bans.push_back({check.text(row.address(), limits::address_bytes_max, "address of a ban"),
                         row.left_s(),
                         check.text(row.reason(), limits::admin_reason_bytes_max, "reason of a ban")});
  read_bodies(from, list, check);
  list.stores = read_stores(from.stores(), limits::stores_a_message, check);
  for (const wire::RegionMass& mass : from.region_masses()) list.region_masses.push_back(read(mass, check));
  list.text = check.bytes(from.text(), limits::admin_text_bytes_max, "text of a list");
  read_flight(from, list, check);
  return list;
}

}  // namespace scree
