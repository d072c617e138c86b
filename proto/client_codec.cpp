// ClientMessage to bytes and back.
#include <fmt/format.h>

#include "proto/admin_codec.h"
#include "proto/codec.h"
#include "proto/content_codec.h"
#include "proto/game_codec.h"
#include "proto/height_wire.h"
#include "proto/join_codec.h"
#include "proto/joint_codec.h"
#include "proto/person_codec.h"
#include "proto/prop_codec.h"
#include "proto/query_codec.h"
#include "proto/region_codec.h"
#include "proto/rules_codec.h"
#include "proto/store_codec.h"
#include "proto/talk_codec.h"
#include "proto/wire_values.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

struct Writing {
  wire::ClientMessage& to;

  void operator()(const HelloMessage& from) const { write(*to.mutable_hello(), from); }
  void operator()(const OfferMessage& from) const { write(*to.mutable_offer(), from); }
  void operator()(const InterestMessage& from) const {
    wire::Interest& interest = *to.mutable_interest();
    write(*interest.mutable_eye(), from.eye_m);
    interest.set_radius_m(from.interest_radius_m);
  }
  void operator()(const CarveMessage& from) const {
    wire::Carve& carve = *to.mutable_carve();
    carve.set_request(from.request);
    write(*carve.mutable_shape(), from.shape);
    carve.set_pattern(static_cast<wire::SeedPattern>(from.pattern));
    carve.set_seeds(from.seeds);
    carve.set_random_seed(from.random_seed);
    write(*carve.mutable_impact(), from.impact_m);
    carve.set_blast_speed_m_s(from.blast_speed_m_s);
    carve.set_authored(pack_points(from.authored_m));
    carve.set_piece(from.piece);
  }
  void operator()(const FillMessage& from) const {
    wire::Fill& fill = *to.mutable_fill();
    fill.set_request(from.request);
    write(*fill.mutable_shape(), from.shape);
    if (from.material) fill.set_material(static_cast<uint32_t>(*from.material));
  }
  void operator()(const PaintMessage& from) const {
    wire::Paint& paint = *to.mutable_paint();
    paint.set_request(from.request);
    write(*paint.mutable_shape(), from.shape);
    paint.set_material(static_cast<uint32_t>(from.material));
  }
  void operator()(const AddPropMessage& from) const { write(*to.mutable_add_prop(), from); }
  void operator()(const RemovePropMessage& from) const { write(*to.mutable_remove_prop(), from); }
  void operator()(const MovePropMessage& from) const { write(*to.mutable_move_prop(), from); }
  void operator()(const PushMessage& from) const { write(*to.mutable_push(), from); }
  void operator()(const BreakMessage& from) const { write(*to.mutable_break_(), from); }
  void operator()(const BlastMessage& from) const { write(*to.mutable_blast(), from); }
  void operator()(const AddJointMessage& from) const { write(*to.mutable_add_joint(), from); }
  void operator()(const RemoveJointMessage& from) const { write(*to.mutable_remove_joint(), from); }
  void operator()(const SetMotorMessage& from) const { write(*to.mutable_set_motor(), from); }
  void operator()(const CutOutMessage& from) const { write(*to.mutable_cut_out(), from); }
  void operator()(const ReleaseMessage& from) const { write(*to.mutable_release(), from); }
  void operator()(const AddPieceMessage& from) const { write(*to.mutable_add_piece(), from); }
  void operator()(const StandMessage& from) const { write(*to.mutable_stand(), from); }
  void operator()(const WalkMessage& from) const { write(*to.mutable_walk(), from); }
  void operator()(const DigMessage& from) const { write(*to.mutable_dig(), from); }
  void operator()(const PlaceMessage& from) const { write(*to.mutable_place(), from); }
  void operator()(const TransferMessage& from) const { write(*to.mutable_transfer(), from); }
  void operator()(const QueryMessage& from) const { write(*to.mutable_query(), from); }
  void operator()(const SetRegionMessage& from) const { write(*to.mutable_set_region(), from); }
  void operator()(const RemoveRegionMessage& from) const { write(*to.mutable_remove_region(), from); }
  void operator()(const RulesMessage& from) const { to.set_rules(pack_rules(from)); }
  void operator()(const RestoreMessage& from) const { to.set_restore(pack_restore(from)); }
  void operator()(const ChannelMessage& from) const { write(*to.mutable_channel(), from); }
  void operator()(const RepairMessage& from) const {
    wire::Repair& repair = *to.mutable_repair();
    repair.set_tick(from.tick);
    repair.set_chunks(pack_chunks(from.chunks));
    repair.mutable_hashes()->Add(from.hashes.begin(), from.hashes.end());
  }
  void operator()(const CursorMessage& from) const {
    write(*to.mutable_cursor()->mutable_eye(), from.eye_m);
    write(*to.mutable_cursor()->mutable_aim(), from.aim_m);
  }
  void operator()(const PhysicsSubscriptionMessage& from) const {
    to.mutable_watch()->set_physics(from.physics);
    to.mutable_watch()->set_contacts_j(from.contacts_j);
  }
  void operator()(const AskGroundMessage& from) const {
    to.mutable_ground()->set_chunks(pack_chunks(from.chunks));
  }
  void operator()(const GoodbyeMessage&) const { to.mutable_goodbye(); }
  void operator()(const AskHealthMessage&) const { to.mutable_ask_health(); }
  void operator()(const AskTilesMessage& from) const { write(*to.mutable_tiles(), from); }
  void operator()(const AskContentMessage& from) const { write(*to.mutable_content(), from); }
  void operator()(const SayMessage& from) const { write(*to.mutable_say(), from); }
  void operator()(const AckMessage& from) const { to.mutable_ack()->set_tick(from.tick); }
  void operator()(const AdminMessage& from) const { write(*to.mutable_admin(), from); }
  void operator()(const UnknownMessage&) const {}
};

InterestMessage read(const wire::Interest& from, FieldChecker& check) {
  return {check.vec3(from.eye(), "eye"), check.not_negative(from.radius_m(), "radius_m")};
}

CarveMessage read(const wire::Carve& from, FieldChecker& check) {
  CarveMessage carve;
  carve.request = from.request();
  carve.shape = check.shape(from.shape());
  carve.pattern = check.asked_kind<SeedPattern>(from.pattern(), "pattern");
  carve.seeds = from.seeds();
  carve.random_seed = from.random_seed();
  carve.impact_m = check.vec3(from.impact(), "impact");
  carve.blast_speed_m_s = check.finite(from.blast_speed_m_s(), "blast_speed_m_s");
  carve.authored_m = check.points(from.authored(), limits::seeds_max, "authored");
  carve.piece = from.piece();
  return carve;
}

FillMessage read(const wire::Fill& from, FieldChecker& check) {
  FillMessage fill{{check.shape(from.shape())}, from.request()};
  if (from.has_material()) fill.material = check.asked_material(from.material());
  return fill;
}

PaintMessage read(const wire::Paint& from, FieldChecker& check) {
  return {{check.shape(from.shape()), check.asked_material(from.material())}, from.request()};
}

RepairMessage read(const wire::Repair& from, FieldChecker& check) {
  RepairMessage repair;
  repair.tick = from.tick();
  repair.chunks = check.chunks(from.chunks(), limits::repair_chunks_max, "chunks of a repair");
  repair.hashes.assign(from.hashes().begin(), from.hashes().end());
  if (repair.hashes.size() != repair.chunks.size())
    check.refuse(fmt::format("{} hashes for {} chunks", repair.hashes.size(), repair.chunks.size()));
  return repair;
}

/// The requests about props, pieces, joints, regions, persons on foot and stores, and questions.
template <typename Checked>
Result<ClientMessage> read_about_bodies(const wire::ClientMessage& from, FieldChecker& check,
                                        const Checked& checked) {
  switch (from.kind_case()) {
    case wire::ClientMessage::kAddProp:
      return checked(read(from.add_prop(), check));
    case wire::ClientMessage::kRemoveProp:
      return checked(read(from.remove_prop(), check));
    case wire::ClientMessage::kMoveProp:
      return checked(read(from.move_prop(), check));
    case wire::ClientMessage::kPush:
      return checked(read(from.push(), check));
    case wire::ClientMessage::kBreak:
      return checked(read(from.break_(), check));
    case wire::ClientMessage::kBlast:
      return checked(read(from.blast(), check));
    case wire::ClientMessage::kAddJoint:
      return checked(read(from.add_joint(), check));
    case wire::ClientMessage::kRemoveJoint:
      return checked(read(from.remove_joint(), check));
    case wire::ClientMessage::kSetMotor:
      return checked(read(from.set_motor(), check));
    case wire::ClientMessage::kCutOut:
      return checked(read(from.cut_out(), check));
    case wire::ClientMessage::kRelease:
      return checked(read(from.release(), check));
    case wire::ClientMessage::kAddPiece:
      return checked(read(from.add_piece(), check));
    case wire::ClientMessage::kQuery:
      return checked(read(from.query(), check));
    case wire::ClientMessage::kSetRegion:
      return checked(read(from.set_region(), check));
    case wire::ClientMessage::kRemoveRegion:
      return checked(read(from.remove_region(), check));
    case wire::ClientMessage::kStand:
      return checked(read(from.stand(), check));
    case wire::ClientMessage::kWalk:
      return checked(read(from.walk(), check));
    case wire::ClientMessage::kDig:
      return checked(read(from.dig(), check));
    case wire::ClientMessage::kPlace:
      return checked(read(from.place(), check));
    case wire::ClientMessage::kTransfer:
      return checked(read(from.transfer(), check));
    case wire::ClientMessage::kRules:
      return checked(unpack_rules(from.rules(), check));
    case wire::ClientMessage::kRestore:
      return checked(unpack_restore(from.restore(), check));
    case wire::ClientMessage::kChannel:
      return checked(read(from.channel(), check));
    default:
      return UnknownMessage{};
  }
}

}  // namespace

std::vector<uint8_t> encode(const ClientMessage& message) {
  wire::ClientMessage to;
  std::visit(Writing{to}, message);
  return frame_of(to);
}

Result<ClientMessage> decode_client(std::span<const uint8_t> body) {
  if (body.size() > limits::message_bytes_max) return fail("client message: over limits.message_bytes_max");
  wire::ClientMessage from;
  if (!from.ParseFromArray(body.data(), static_cast<int>(body.size())))
    return fail("client message: not a protobuf of this protocol");
  FieldChecker check("client message");
  const auto checked = [&](auto value) -> Result<ClientMessage> {
    if (check.failed()) return tl::unexpected(check.error());
    if constexpr (requires { value.request; })
      if (!check.unknown().empty()) return UnknownMessage{value.request, check.unknown()};
    return value;
  };
  switch (from.kind_case()) {
    case wire::ClientMessage::kHello:
      return checked(read_hello(from.hello(), check));
    case wire::ClientMessage::kInterest:
      return checked(read(from.interest(), check));
    case wire::ClientMessage::kCarve:
      return checked(read(from.carve(), check));
    case wire::ClientMessage::kFill:
      return checked(read(from.fill(), check));
    case wire::ClientMessage::kPaint:
      return checked(read(from.paint(), check));
    case wire::ClientMessage::kRepair:
      return checked(read(from.repair(), check));
    case wire::ClientMessage::kCursor:
      return checked(
          CursorMessage{check.vec3(from.cursor().eye(), "eye"), check.vec3(from.cursor().aim(), "aim")});
    case wire::ClientMessage::kWatch:
      return checked(PhysicsSubscriptionMessage{from.watch().physics(),
                                                check.not_negative(from.watch().contacts_j(), "contacts_j")});
    case wire::ClientMessage::kGround:
      return checked(AskGroundMessage{
          check.chunks(from.ground().chunks(), limits::ground_chunks_max, "chunks of a ground request")});
    case wire::ClientMessage::kOffer:
      return checked(read_offer(from.offer(), check));
    case wire::ClientMessage::kGoodbye:
      return GoodbyeMessage{};
    case wire::ClientMessage::kAskHealth:
      return AskHealthMessage{};
    case wire::ClientMessage::kTiles:
      return checked(read_tile_request(from.tiles(), check));
    case wire::ClientMessage::kContent:
      return checked(read(from.content(), check));
    case wire::ClientMessage::kSay:
      return checked(read(from.say(), check));
    case wire::ClientMessage::kAck:
      return AckMessage{from.ack().tick()};
    case wire::ClientMessage::kAdmin:
      return checked(read_admin(from.admin(), check));
    default:
      return read_about_bodies(from, check, checked);
  }
}

}  // namespace scree
