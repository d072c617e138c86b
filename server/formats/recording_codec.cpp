#include "server/formats/recording_codec.h"

#include <algorithm>
#include <fmt/format.h>
#include <recording.pb.h>

#include "proto/codec.h"
#include "proto/limits.h"
#include "proto/operation_codec.h"
#include "proto/rules_codec.h"
#include "proto/store_codec.h"
#include "proto/transforms.h"
#include "proto/wire_values.h"
#include "server/formats/joint_lists.h"
#include "server/formats/packed_lists.h"
#include "server/formats/recording_values.h"
#include "server/formats/region_list.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/text.h"

namespace scree {

namespace {

std::string without_length(const std::vector<uint8_t>& message) {
  CHECK(message.size() >= length_prefix_bytes);
  return {message.begin() + length_prefix_bytes, message.end()};
}

PieceMessage read_piece(std::span<const uint8_t> bytes, FieldChecker& check) {
  ServerMessage message = check.value_or_refuse(decode_server(bytes));
  if (auto* piece = std::get_if<PieceMessage>(&message)) return std::move(*piece);
  check.refuse("a message is not a piece, as it should be");
  return {};
}

PropMessage read_prop_here(std::span<const uint8_t> bytes, FieldChecker& check) {
  ServerMessage message = check.value_or_refuse(decode_server(bytes));
  if (auto* prop = std::get_if<PropMessage>(&message)) return std::move(*prop);
  check.refuse("a message is not a prop, as it should be");
  return {};
}

using PackedList = google::protobuf::RepeatedPtrField<std::string>;

void write_pieces(PackedList& to, const std::vector<PieceMessage>& from) {
  for (const PieceMessage& piece : from) *to.Add() = without_length(encode(ServerMessage(piece)));
}

std::vector<PieceMessage> read_pieces(const PackedList& from, FieldChecker& check) {
  std::vector<PieceMessage> pieces;
  size_t voxels = 0;
  for (const std::string& packed : from) {
    if (check.failed()) break;
    pieces.push_back(read_piece(as_span(packed), check));
    voxels += pieces.back().volume.window.codes.size();
    if (voxels > limits::piece_voxels_max)
      check.refuse(
          fmt::format("pieces of more than {} voxels (limits.piece_voxels_max)", limits::piece_voxels_max));
  }
  return pieces;
}

void write_props(PackedList& to, const std::vector<PropMessage>& from) {
  for (const PropMessage& prop : from) *to.Add() = without_length(encode(ServerMessage(prop)));
}

std::vector<PropMessage> read_props(const PackedList& from, FieldChecker& check) {
  std::vector<PropMessage> props;
  for (const std::string& packed : from) {
    if (check.failed()) break;
    props.push_back(read_prop_here(as_span(packed), check));
    if (props.size() > 1 && props[props.size() - 2].id >= props.back().id)
      check.refuse("props are not in the order of their ids");
  }
  return props;
}

Command read_command(uint64_t session, const std::string& bytes, FieldChecker& check) {
  const ClientMessage message = check.value_or_refuse(decode_client(as_span(bytes)));
  return std::visit(
      Overloaded{
          [&]<typename Asks>(const RequestMessage<Asks>& asked) {
            return Command{session, asked.request, static_cast<const Asks&>(asked)};
          },
          [&](const AdminMessage& admin) {
            const auto* settings = std::get_if<SettingsRequest>(&admin.act);
            if (settings == nullptr) check.refuse("an administrator's request is not a request to the world");
            return Command{session, admin.request, settings == nullptr ? SettingsRequest() : *settings};
          },
          [&](const GoodbyeMessage&) {
            return Command{session, 0, LeaveRequest{}};
          },
          [&](const auto&) {
            check.refuse("a message is not a request, as it should be");
            return Command{};
          }},
      message);
}

void read_eyes(const recorded::Commands& from, std::vector<Command>& commands, FieldChecker& check) {
  if (from.eyes_size() != 3 * from.seen_size())
    check.refuse("eyes and requests that are seen differ in number");
  for (int i = 0; i < from.seen_size() && !check.failed(); ++i) {
    const uint32_t at = from.seen(i);
    if (at >= commands.size() || (i > 0 && from.seen(i - 1) >= at)) {
      check.refuse("an eye is of no request");
      return;
    }
    const auto number = [&](int axis) { return check.finite(from.eyes(3 * i + axis), "an eye"); };
    commands[at].eye_m = {number(0), number(1), number(2)};
  }
}

/// As the client sent it, without the token.
ClientMessage message_of(const Command& command) {
  return std::visit(Overloaded{[&]<typename Asks>(const Asks& asks) {
                                 return ClientMessage(RequestMessage<Asks>{asks, command.request});
                               },
                               [&](const SettingsRequest& settings) {
                                 return ClientMessage(AdminMessage{command.request, {}, settings});
                               },
                               [](const LeaveRequest&) { return ClientMessage(GoodbyeMessage{}); }},
                    command.body);
}

}  // namespace

std::vector<uint8_t> encode(const RecordedHeader& header) {
  recorded::Header to;
  write(to, header);
  return bytes_of(to);
}

Result<RecordedHeader> decode_recorded_header(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<recorded::Header>(bytes, "header of the recording"));
  FieldChecker check("header of the recording");
  RecordedHeader header = read(from, check);
  return checked(std::move(header), check);
}

std::vector<uint8_t> encode(const RecordedFrame& frame) {
  recorded::Frame to;
  to.set_tick(frame.tick);
  to.set_operations(to_string(encode_operations(frame.operations)));
  to.set_moved(to_string(pack_transforms(frame.moved)));
  write(*to.mutable_ledger(), frame.ledger);
  to.set_field_hash(frame.field_hash);
  to.set_state_hash(frame.state_hash);
  write(*to.mutable_settings(), frame.settings);
  write_pieces(*to.mutable_pieces(), frame.pieces);
  write_props(*to.mutable_props(), frame.props);
  to.set_props_gone(pack_ids(frame.props_gone));
  write_joints(*to.mutable_joints(), frame.joints);
  if (frame.regions != nullptr) to.set_regions(pack_regions(*frame.regions));
  write(*to.mutable_stores(), frame.stores);
  if (frame.signs != nullptr) to.set_signs(pack_signs(*frame.signs));
  for (const Notice& notice : frame.notices) write(*to.add_notices(), notice);
  return bytes_of(to);
}

Result<RecordedFrame> decode_recorded_frame(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<recorded::Frame>(bytes, "frame of the recording"));
  FieldChecker check("frame of the recording");
  RecordedFrame frame;
  frame.tick = from.tick();
  frame.operations = check.value_or_refuse(decode_operations(as_span(from.operations())));
  frame.moved = check.value_or_refuse(unpack_transforms(as_span(from.moved())));
  frame.ledger = read(from.ledger(), check);
  frame.field_hash = from.field_hash();
  frame.state_hash = from.state_hash();
  frame.settings = check.settings(from.settings());
  frame.pieces = read_pieces(from.pieces(), check);
  frame.props = read_props(from.props(), check);
  frame.props_gone = check.value_or_refuse(unpack_piece_ids(from.props_gone(), "props that are gone"));
  frame.joints = read_joints(from.joints(), check);
  if (from.has_regions())
    frame.regions = std::make_shared<const std::vector<Region>>(unpack_regions(from.regions(), check));
  frame.stores = read_stores(from.stores(), 2 * limits::stores_max, check);
  if (from.has_signs())
    frame.signs = std::make_shared<const std::vector<Sign>>(unpack_signs(from.signs(), check));
  if (static_cast<size_t>(from.notices_size()) > limits::notices_a_tick_max)
    check.refuse("more notices in a tick than there can be (limits.notices_a_tick_max)");
  for (const wire::Notice& notice : from.notices())
    if (!check.failed()) frame.notices.push_back(read(notice, check));
  return checked(std::move(frame), check);
}

std::vector<uint8_t> encode(const RecordedKeyframe& keyframe) {
  recorded::Keyframe to;
  to.set_tick(keyframe.tick);
  const std::span<const BrickPatch> bricks(keyframe.bricks);
  for (size_t at = 0; at < bricks.size(); at += limits::bricks_per_message_max) {
    const size_t count = std::min(limits::bricks_per_message_max, bricks.size() - at);
    to.add_bricks(to_string(encode_bricks(bricks.subspan(at, count))));
  }
  write_pieces(*to.mutable_pieces(), keyframe.pieces);
  to.set_poses(to_string(pack_transforms(keyframe.poses)));
  write(*to.mutable_ledger(), keyframe.ledger);
  to.set_field_hash(keyframe.field_hash);
  to.set_state_hash(keyframe.state_hash);
  write(*to.mutable_settings(), keyframe.settings);
  write(*to.mutable_materials(), keyframe.materials);
  write_props(*to.mutable_props(), keyframe.props);
  write_joints(*to.mutable_joints(), JointsMessage{keyframe.joints, {}});
  if (!keyframe.regions.empty()) to.set_regions(pack_regions(keyframe.regions));
  write(*to.mutable_stores(), keyframe.stores);
  if (!keyframe.signs.empty()) to.set_signs(pack_signs(keyframe.signs));
  return bytes_of(to);
}

Result<RecordedKeyframe> decode_recorded_keyframe(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<recorded::Keyframe>(bytes, "keyframe of the recording"));
  FieldChecker check("keyframe of the recording");
  RecordedKeyframe keyframe;
  keyframe.tick = from.tick();
  for (const std::string& packed : from.bricks()) {
    const std::vector<BrickPatch> bricks = check.value_or_refuse(decode_bricks(as_span(packed)));
    if (check.failed()) break;
    keyframe.bricks.insert(keyframe.bricks.end(), bricks.begin(), bricks.end());
  }
  keyframe.pieces = read_pieces(from.pieces(), check);
  keyframe.ledger = read(from.ledger(), check);
  keyframe.field_hash = from.field_hash();
  keyframe.state_hash = from.state_hash();
  keyframe.settings = check.settings(from.settings());
  keyframe.poses = check.value_or_refuse(unpack_transforms(as_span(from.poses())));
  keyframe.materials = read(from.materials(), check);
  keyframe.props = read_props(from.props(), check);
  keyframe.joints = read_joints(from.joints(), check).here;
  if (from.has_regions()) keyframe.regions = unpack_regions(from.regions(), check);
  keyframe.stores = read_stores(from.stores(), limits::stores_max, check);
  if (from.has_signs()) keyframe.signs = unpack_signs(from.signs(), check);
  return checked(std::move(keyframe), check);
}

std::vector<uint8_t> encode_recorded_piece(const PieceMessage& piece) {
  const std::string bytes = without_length(encode(ServerMessage(piece)));
  return {bytes.begin(), bytes.end()};
}

Result<PieceMessage> decode_recorded_piece(std::span<const uint8_t> bytes) {
  FieldChecker check("piece of the recording");
  PieceMessage piece = read_piece(bytes, check);
  return checked(std::move(piece), check);
}

std::vector<uint8_t> encode_recorded_prop(const PropMessage& prop) {
  const std::string bytes = without_length(encode(ServerMessage(prop)));
  return {bytes.begin(), bytes.end()};
}

Result<PropMessage> decode_recorded_prop(std::span<const uint8_t> bytes) {
  FieldChecker check("prop of the recording");
  PropMessage prop = read_prop_here(bytes, check);
  return checked(std::move(prop), check);
}

std::vector<uint8_t> encode(std::span<const Command> commands) {
  recorded::Commands to;
  const bool parties = std::ranges::any_of(commands, [](const auto& command) { return command.party != 0; });
  const auto has_role = [](const Command& command) { return command.asker.role != Role{}; };
  const auto has_name = [](const Command& command) { return !command.asker.name.empty(); };
  const auto has_team = [](const Command& command) { return !command.asker.team.empty(); };
  const bool teams = std::ranges::any_of(commands, has_team);
  const bool roles = std::ranges::any_of(commands, has_role), names = std::ranges::any_of(commands, has_name);
  for (const Command& command : commands) {
    to.add_sessions(command.session);
    if (parties) to.add_parties(command.party);
    if (roles) to.add_roles(static_cast<uint32_t>(command.asker.role));
    if (names) to.add_names(showable(command.asker.name, limits::person_name_bytes_max));
    if (teams) to.add_teams(showable(command.asker.team, limits::person_name_bytes_max));
    if (command.eye_m) {
      to.add_seen(static_cast<uint32_t>(to.requests_size()));
      for (const float number : {command.eye_m->x, command.eye_m->y, command.eye_m->z}) to.add_eyes(number);
    }
    to.add_requests(without_length(encode(message_of(command))));
  }
  return bytes_of(to);
}

Result<std::vector<Command>> decode_recorded_commands(std::span<const uint8_t> bytes) {
  const auto from = TRY(parsed<recorded::Commands>(bytes, "commands of the recording"));
  FieldChecker check("commands of the recording");
  if (from.sessions_size() != from.requests_size()) check.refuse("sessions and requests differ in number");
  if (from.parties_size() != 0 && from.parties_size() != from.requests_size())
    check.refuse("parties and requests differ in number");
  for (const int askers : {from.roles_size(), from.names_size(), from.teams_size()})
    if (askers != 0 && askers != from.requests_size()) check.refuse("requests and askers differ in number");
  std::vector<Command> commands;
  for (int i = 0; i < from.requests_size() && !check.failed(); ++i) {
    commands.push_back(read_command(from.sessions(i), from.requests(i), check));
    if (from.parties_size() != 0) commands.back().party = from.parties(i);
    if (from.roles_size() != 0)
      commands.back().asker.role = check.kind<Role>(from.roles(i), "role of who asked");
    if (from.names_size() != 0)
      commands.back().asker.name =
          check.text(from.names(i), limits::person_name_bytes_max, "name of who asked");
  }
  for (int i = 0; i < from.teams_size() && !check.failed(); ++i)
    commands[static_cast<size_t>(i)].asker.team =
        check.text(from.teams(i), limits::person_name_bytes_max, "team of who asked");
  read_eyes(from, commands, check);
  return checked(std::move(commands), check);
}

}  // namespace scree
