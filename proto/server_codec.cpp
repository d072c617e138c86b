// ServerMessage to bytes and back.
#include <fmt/format.h>

#include "proto/admin_codec.h"
#include "proto/body_list_codec.h"
#include "proto/byte_stream.h"
#include "proto/codec.h"
#include "proto/content_codec.h"
#include "proto/frame_codec.h"
#include "proto/game_codec.h"
#include "proto/health_codec.h"
#include "proto/height_wire.h"
#include "proto/join_codec.h"
#include "proto/joint_codec.h"
#include "proto/operation_codec.h"
#include "proto/person_codec.h"
#include "proto/physics_codec.h"
#include "proto/playback_codec.h"
#include "proto/prop_codec.h"
#include "proto/query_codec.h"
#include "proto/region_codec.h"
#include "proto/status_codec.h"
#include "proto/store_codec.h"
#include "proto/talk_codec.h"
#include "proto/wire_values.h"
#include "shared/base/limits.h"
#include "shared/base/text.h"

namespace scree {

namespace {

constexpr size_t bricks_per_chunk = size_t{chunk_bricks} * chunk_bricks * chunk_bricks;

void write(wire::Piece& to, const PieceMessage& from) {
  to.set_id(from.id);
  to.set_volume(to_string(encode_volume(from.volume)));
  to.set_x(from.pose.x);
  to.set_y(from.pose.y);
  to.set_z(from.pose.z);
  to.set_rotation(from.pose.rotation);
}

struct Writing {
  wire::ServerMessage& to;

  void operator()(const WelcomeMessage& from) const { write(*to.mutable_welcome(), from); }
  void operator()(const UnchangedChunksMessage& from) const { write(*to.mutable_kept(), from); }
  void operator()(const AdminListMessage& from) const { write(*to.mutable_admin_list(), from); }
  void operator()(const RefusalMessage& from) const {
    to.mutable_refusal()->set_reason(showable(from.reason, limits::reason_bytes_max));
    to.mutable_refusal()->set_name(showable(from.name, limits::refusal_name_bytes_max));
  }
  void operator()(const FrameMessage& from) const { write(*to.mutable_frame(), from); }
  void operator()(const ChunkMessage& from) const {
    wire::Chunk& chunk = *to.mutable_chunk();
    chunk.set_chunk(pack_chunks({from.chunk}));
    chunk.set_version(from.version);
    chunk.set_bricks(to_string(encode_bricks(from.bricks)));
    chunk.set_hash(from.hash);
    chunk.set_edited(from.edited);
    chunk.set_more(from.more);
  }
  void operator()(const GroundMessage& from) const {
    wire::Ground& ground = *to.mutable_ground();
    ground.set_chunk(pack_chunks({from.chunk}));
    ground.set_beyond(from.beyond);
    ground.set_rock(from.rock);
    ground.set_bricks(to_string(encode_bricks(from.bricks)));
    ground.set_hash(from.hash);
  }
  void operator()(const TileMessage& from) const { write(*to.mutable_tile(), from); }
  void operator()(const ContentMessage& from) const { write(*to.mutable_content(), from); }
  void operator()(const PaletteChangedMessage& from) const {
    to.mutable_palette_changed()->set_palette(wire_digest(from.palette));
  }
  void operator()(const PieceMessage& from) const { write(*to.mutable_piece(), from); }
  void operator()(const StoneMessage& from) const {
    write(*to.mutable_stone(), from);
    to.mutable_stone()->set_lies(from.lies);
  }
  void operator()(const ContactsMessage& from) const { write(*to.mutable_contacts(), from); }
  void operator()(const PropMessage& from) const { write(*to.mutable_prop(), from); }
  void operator()(const JointsMessage& from) const { write(*to.mutable_joints(), from); }
  void operator()(const KeptPiecesMessage& from) const { write(*to.mutable_kept_pieces(), from); }
  void operator()(const AnswerMessage& from) const { write(*to.mutable_answer(), from); }
  void operator()(const RegionsMessage& from) const { write(*to.mutable_regions(), from); }
  void operator()(const PersonPlacesMessage& from) const { write(*to.mutable_person_places(), from); }
  void operator()(const StoresMessage& from) const { write(*to.mutable_stores(), from); }
  void operator()(const SignsMessage& from) const { write(*to.mutable_signs(), from); }
  void operator()(const CuesMessage& from) const { write(*to.mutable_cues(), from); }
  void operator()(const ChannelMessage& from) const { write(*to.mutable_channel(), from); }
  void operator()(const ResetMessage&) const { to.mutable_reset(); }
  void operator()(const ReplyMessage& from) const {
    wire::Reply& reply = *to.mutable_reply();
    reply.set_request(from.request);
    reply.set_refusal(showable(from.refusal, limits::reason_bytes_max));
    reply.set_pieces(from.pieces);
    reply.set_refusal_name(showable(from.refusal_name, limits::refusal_name_bytes_max));
    reply.set_waiting_us(from.latency.waiting_us);
    reply.set_tick_us(from.latency.tick_us);
    reply.set_sending_us(from.latency.sending_us);
    reply.set_tick(from.tick);
    if (from.painted) reply.set_painted(*from.painted);
    if (from.prop) reply.set_prop(*from.prop);
    if (from.joint) reply.set_joint(*from.joint);
    if (from.mass) reply.set_mass(static_cast<uint64_t>(*from.mass));
  }
  void operator()(const CursorsMessage& from) const { write(*to.mutable_cursors(), from); }
  void operator()(const PersonsMessage& from) const { write(*to.mutable_persons(), from); }
  void operator()(const SaidMessage& from) const { write(*to.mutable_said(), from); }
  void operator()(const PlaybackMessage& from) const { write(*to.mutable_playback(), from); }
  void operator()(const MarksMessage& from) const { write(*to.mutable_marks(), from); }
  void operator()(const RecordedCursorsMessage& from) const {
    write(*to.mutable_recorded_cursors(), CursorsMessage{from.cursors});
  }
  void operator()(const HealthMessage& from) const { write(*to.mutable_health(), from); }
  void operator()(const PhysicsMessage& from) const { write(*to.mutable_physics(), from); }
  void operator()(const StatusMessage& from) const { write(*to.mutable_status(), from); }
  void operator()(const UnknownMessage&) const {}
};

ChunkCoord one_chunk(const std::string& packed, FieldChecker& check) {
  const std::vector<ChunkCoord> coords = check.chunks(packed, 1, "chunk");
  if (!coords.empty()) return coords.front();
  check.refuse("a chunk without a coordinate");
  return {};
}

std::vector<BrickPatch> bricks_within(ChunkCoord chunk, const std::string& packed, FieldChecker& check) {
  std::vector<BrickPatch> bricks = check.value_or_refuse(decode_bricks(as_span(packed), bricks_per_chunk));
  for (const BrickPatch& patch : bricks)
    if (chunk_of(patch.coord) != chunk) check.refuse("a brick of another chunk");
  return bricks;
}

ChunkMessage read(const wire::Chunk& from, FieldChecker& check) {
  ChunkMessage chunk;
  chunk.chunk = one_chunk(from.chunk(), check);
  chunk.version = from.version();
  chunk.bricks = bricks_within(chunk.chunk, from.bricks(), check);
  chunk.hash = from.hash();
  chunk.edited = from.edited();
  chunk.more = from.more();
  if (chunk.more && !chunk.is_part()) check.refuse("a chunk of which more comes, but is no part");
  if (chunk.more && chunk.hash != 0) check.refuse("a part of a chunk with a hash, before the last one");
  if (chunk.is_part())
    for (const BrickPatch& patch : chunk.bricks)
      if (((chunk.edited >> index_in_chunk(patch.coord)) & 1U) == 0)
        check.refuse("a brick of a part that is not among the chunk's edited ones");
  return chunk;
}

GroundMessage read(const wire::Ground& from, FieldChecker& check) {
  GroundMessage ground;
  ground.chunk = one_chunk(from.chunk(), check);
  ground.beyond = from.beyond();
  ground.rock = from.rock();
  ground.bricks = bricks_within(ground.chunk, from.bricks(), check);
  ground.hash = from.hash();
  for (const BrickPatch& patch : ground.bricks) {
    if (!patch.materials.is_ground()) check.refuse("a painted brick of ground");
    if (((ground.rock >> index_in_chunk(patch.coord)) & 1U) != 0)
      check.refuse("a brick of ground that is listed, and wholly rock as well");
  }
  if (ground.beyond && (ground.rock != 0 || !ground.bricks.empty() || ground.hash != 0))
    check.refuse("ground beyond the interest that has bricks");
  return ground;
}

PieceMessage read(const wire::Piece& from, FieldChecker& check) {
  PieceMessage piece;
  piece.id = from.id();
  piece.volume = check.value_or_refuse(decode_volume(as_span(from.volume())));
  for (const int32_t position : {from.x(), from.y(), from.z()})
    if (position < -limits::pose_coordinate_max || position > limits::pose_coordinate_max)
      check.refuse("position of a piece is 2^30 steps or more from the origin");
  piece.pose = {from.x(), from.y(), from.z(), from.rotation()};
  return piece;
}

StoneMessage read_stone(const wire::Piece& from, FieldChecker& check) {
  if (from.lies() == 0) check.refuse("a stone of which nothing is rock");
  return {read(from, check), from.lies()};
}

RefusalMessage read(const wire::Refusal& from, FieldChecker& check) {
  return {check.text(from.reason(), limits::reason_bytes_max, "reason"),
          check.text(from.name(), limits::refusal_name_bytes_max, "name of a reason")};
}

MassUnits read_mass(uint64_t mass, FieldChecker& check) {
  const auto beyond = static_cast<uint64_t>(limits::ledger_mass_max) + 1;
  return ledger_mass(static_cast<int64_t>(std::min(mass, beyond)), check);
}

ReplyMessage read(const wire::Reply& from, FieldChecker& check) {
  return {from.request(),
          check.text(from.refusal(), limits::reason_bytes_max, "reason"),
          from.pieces(),
          check.text(from.refusal_name(), limits::refusal_name_bytes_max, "name of a reason"),
          {read_latency(from.waiting_us(), check), read_latency(from.tick_us(), check),
           read_latency(from.sending_us(), check)},
          from.tick(),
          from.has_painted() ? std::optional(from.painted()) : std::nullopt,
          from.has_prop() ? std::optional(from.prop()) : std::nullopt,
          from.has_joint() ? std::optional(from.joint()) : std::nullopt,
          from.has_mass() ? std::optional(read_mass(from.mass(), check)) : std::nullopt};
}

/// Props, joints, regions, and what is told and asked of bodies.
template <typename Checked>
Result<ServerMessage> read_about_bodies(const wire::ServerMessage& from, FieldChecker& check,
                                        const Checked& checked) {
  switch (from.kind_case()) {
    case wire::ServerMessage::kContacts:
      return checked(read(from.contacts(), check));
    case wire::ServerMessage::kProp:
      return checked(read(from.prop(), check));
    case wire::ServerMessage::kJoints:
      return checked(read(from.joints(), check));
    case wire::ServerMessage::kKeptPieces:
      return checked(read(from.kept_pieces(), check));
    case wire::ServerMessage::kAnswer:
      return checked(read(from.answer(), check));
    case wire::ServerMessage::kRegions:
      return checked(read(from.regions(), check));
    case wire::ServerMessage::kStone:
      return checked(read_stone(from.stone(), check));
    case wire::ServerMessage::kPersonPlaces:
      return checked(read(from.person_places(), check));
    case wire::ServerMessage::kStores:
      return checked(read(from.stores(), check));
    case wire::ServerMessage::kSigns:
      return checked(read(from.signs(), check));
    case wire::ServerMessage::kCues:
      return checked(read(from.cues(), check));
    case wire::ServerMessage::kChannel:
      return checked(read(from.channel(), check));
    default:
      return UnknownMessage{};
  }
}

Result<ServerMessage> read(const wire::ServerMessage& from) {
  FieldChecker check("server message");
  const auto checked = [&](auto value) -> Result<ServerMessage> {
    if (check.failed()) return tl::unexpected(check.error());
    return value;
  };
  switch (from.kind_case()) {
    case wire::ServerMessage::kWelcome:
      return checked(read_welcome(from.welcome(), check));
    case wire::ServerMessage::kRefusal:
      return checked(read(from.refusal(), check));
    case wire::ServerMessage::kFrame:
      return checked(read(from.frame(), check));
    case wire::ServerMessage::kChunk:
      return checked(read(from.chunk(), check));
    case wire::ServerMessage::kKept:
      return checked(read_unchanged_chunks(from.kept(), check));
    case wire::ServerMessage::kGround:
      return checked(read(from.ground(), check));
    case wire::ServerMessage::kTile:
      return checked(read_tile(from.tile(), check));
    case wire::ServerMessage::kContent:
      return checked(read(from.content(), check));
    case wire::ServerMessage::kPaletteChanged:
      return checked(PaletteChangedMessage{read_digest(from.palette_changed().palette(), "palette", check)});
    case wire::ServerMessage::kPiece:
      return checked(read(from.piece(), check));
    case wire::ServerMessage::kContacts:
    case wire::ServerMessage::kProp:
    case wire::ServerMessage::kJoints:
    case wire::ServerMessage::kKeptPieces:
    case wire::ServerMessage::kPersonPlaces:
    case wire::ServerMessage::kAnswer:
    case wire::ServerMessage::kStores:
    case wire::ServerMessage::kSigns:
    case wire::ServerMessage::kCues:
    case wire::ServerMessage::kChannel:
    case wire::ServerMessage::kRegions:
    case wire::ServerMessage::kStone:
      return read_about_bodies(from, check, checked);
    case wire::ServerMessage::kReset:
      return ResetMessage{};
    case wire::ServerMessage::kReply:
      return checked(read(from.reply(), check));
    case wire::ServerMessage::kCursors:
      return checked(read(from.cursors(), check));
    case wire::ServerMessage::kPersons:
      return checked(read(from.persons(), check));
    case wire::ServerMessage::kSaid:
      return checked(read(from.said(), check));
    case wire::ServerMessage::kPlayback:
      return checked(read(from.playback(), check));
    case wire::ServerMessage::kMarks:
      return checked(read(from.marks(), check));
    case wire::ServerMessage::kRecordedCursors:
      return checked(RecordedCursorsMessage{read(from.recorded_cursors(), check).cursors});
    case wire::ServerMessage::kPhysics:
      return checked(read(from.physics(), check));
    case wire::ServerMessage::kStatus:
      return checked(read(from.status(), check));
    case wire::ServerMessage::kHealth:
      return checked(read(from.health(), check));
    case wire::ServerMessage::kAdminList:
      return checked(read_admin_list(from.admin_list(), check));
    case wire::ServerMessage::KIND_NOT_SET:
      break;
  }
  return UnknownMessage{};
}

}  // namespace

std::vector<uint8_t> encode(const ServerMessage& message) {
  wire::ServerMessage to;
  std::visit(Writing{to}, message);
  return frame_of(to);
}

Result<ServerMessage> decode_server(std::span<const uint8_t> body) {
  if (body.size() > limits::message_bytes_max) return fail("server message: over limits.message_bytes_max");
  wire::ServerMessage from;
  if (!from.ParseFromArray(body.data(), static_cast<int>(body.size())))
    return fail("server message: not a protobuf of this protocol");
  return read(from);
}

}  // namespace scree
