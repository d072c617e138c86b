// One message of every kind with every field set, for the tests of the wire.
#pragma once

#include <vector>

#include "proto/codec.h"
#include "proto/limits.h"
#include "proto/motion_codec.h"
#include "proto/transforms.h"
#include "shared/base/random.h"
#include "tests/support/flight_samples.h"
#include "tests/support/materials.h"
#include "tests/support/query_samples.h"
#include "tests/support/rules_samples.h"
#include "tests/support/store_samples.h"

namespace scree::samples {

inline Brick noisy_brick(uint32_t random_seed) {
  Random random(random_seed);
  Brick brick;
  for (Code& code : brick.codes) code = static_cast<Code>(static_cast<int>(random.below(255)) - 127);
  return brick;
}

inline Volume volume() {
  Volume volume;
  volume.window = Window(VoxelBox{{-3, 10, 7}, {5, 15, 13}});
  for (size_t i = 0; i < volume.window.codes.size(); ++i)
    volume.window.codes[i] = static_cast<Code>(static_cast<int>(i % 255) - 127);
  volume.mass = 12345;
  volume.centre_voxels = {1.5F, 12.0F, 9.25F};
  volume.materials.all = material::soil;
  return volume;
}

inline CarveOperation carve_operation() {
  return {sphere({1.0F, 2.0F, 3.0F}, 2.0F), SeedPattern::radial, 64, 0xDEADBEEFU, {1.0F, 4.0F, 3.0F}, 77777};
}

inline CarveOperation authored_carve_operation() {
  return {.shape = sphere({1.0F, 2.0F, 3.0F}, 2.0F),
          .pattern = SeedPattern::authored,
          .seeds = 3,
          .random_seed = 7,
          .impact_m = {1.0F, 4.0F, 3.0F},
          .first_piece = 77777,
          .cutter = Cutter::conform,
          .authored_m = {{1.0F, 2.0F, 3.0F}, {-1.5F, 2.5F, 3.0F}, {0.0F, -900.0F, 4000.0F}}};
}

inline StampOperation stamp_operation() {
  return {77790, {-65000, 21234, 65535, 0x87654321U}, -12};
}

/// Two whole motions, one of them at rest, and a step of a third.
inline std::vector<uint8_t> motions() {
  Motion tumbling = resting_at({5000, -900000, 12, 0xF2345678U});
  tumbling.mode = MotionMode::fall;
  tumbling.velocity = {100, -2000, 7};
  tumbling.spin = {-9000, 12, 300000};
  const WholeMotion wholes[] = {{3, resting_at({10, -20, 30, 7})}, {900, tumbling}};
  const std::optional<Correction> correction = Correction{MotionMode::slide, {3, 0, -40}, {0, 1, -1}};
  const MotionStep steps[] = {{77, &tumbling, motion_check(77, tumbling), &correction}};
  return encode_motions(wholes, steps);
}

inline FrameMessage frame() {
  FrameMessage frame;
  frame.tick = 123456;
  frame.operations = {
      carve_operation(),
      authored_carve_operation(),
      FillOperation{box({-1.0F, 0.5F, 9.0F}, {1.0F, 2.0F, 0.5F})},
      FillOperation{capsule({0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}, 0.5F)},
      stamp_operation(),
      StampOperation{77789, {1, 2, 3, 4}, -8000, StampMethod::slices},
      StampOperation{77788, {-1, 2, 3, 4}, 8000, StampMethod::sphere},
      StampOperation{
          77787, {5, 6, 7, 8}, 300, StampMethod::stamp, {{9, {5, 5, 5, 5}}, {70000, {-9, 8, 7, 6}}}},
      DiscardOperation{77791},
      ShatterOperation{77792, SeedPattern::uniform, 5, 0x1234U, {-3.5F, 0.25F, 8.0F}, 80000, Cutter::slice},
      ShatterOperation{77793,
                       SeedPattern::radial,
                       4,
                       9,
                       {1.0F, 2.0F, 3.0F},
                       80100,
                       Cutter::field,
                       PieceCut{sphere({1.0F, -2.0F, 3.0F}, 1.5F), {100, -200, 300, 0x80200802U}}},
      IslandOperation{{{-40, 7, 300}, {-3, 40, 412}}, {-40, 9, 311}, 80005},
      PaintOperation{box({4.0F, -1.0F, 2.0F}, {3.0F, 1.0F, 2.0F}), material::ice},
      SlideOperation{{{-12, 8, 400}, {12, 40, 436}}, material::soil, 46, 3},
      DigOperation{sphere({1.0F, -2.0F, 3.0F}, 1.5F)},
      DigOperation{box({4.0F, -1.0F, 2.0F}, {3.0F, 1.0F, 2.0F}), 77794},
      PlaceOperation{capsule({0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}, 0.5F), material::ice},
      RestoreOperation{std::make_shared<const std::vector<BrickPatch>>(std::vector<BrickPatch>{
                           {{4, 0, 7}, noisy_brick(3)}, {{5, 0, 7}, noisy_brick(4), all_of(material::soil)}}),
                       {77795, 77796}},
      RestoreOperation{nullptr, {77797}}};
  frame.patches = {{{-5, 0, 7}, noisy_brick(1)}, {{-4, 0, 7}, noisy_brick(2), all_of(material::soil)}};
  frame.dropped_chunks = {{1, -2, 3}, {-100, 0, 100}};
  frame.removed_pieces = {9, 4000000000U, 12};
  frame.transforms = pack_transforms(
      std::vector<PieceState>{{3, {10, -20, 30, 7}}, {900, {5000, -900000, 12, 0xFFFFFFFFU}}});
  frame.motions = motions();
  frame.has_check = true;
  frame.check = 0x12345678U;
  return frame;
}

inline PhysicsMessage physics() {
  PhysicsMessage physics;
  physics.tick = 66;
  physics.bodies = {{3, true, false, {{0.5F, -0.25F, 1.0F}, {-0.5F, 0.0F, 0.125F}}}, {300, false, true, {}}};
  physics.contacts = {{{10.5F, -2.0F, 0.25F}, {0.0F, 1.0F, 0.0F}, 12.5F}};
  physics.searched = {{-4, 8, 0}, {5, 5, 5}};
  return physics;
}

inline StatusMessage status() {
  StatusMessage status;
  status.tick = 5;
  status.clients = 3;
  status.props = 9;
  status.ledger_terrain = -99999999999LL;
  status.ledger_pieces = 99999999998LL;
  status.ledger_dust = 1;
  status.tick_median_ms = 1.5F;
  status.tick_worst_ms = 8.25F;
  status.stages = {{"carve", 0.0F}, {"bodies", 2.5F}, {"publish", 1e-3F}};
  status.paging = {4000, 127000, 250, 3, uint64_t{1} << 40U};
  status.field_hash = 1ULL << 63U;
  status.repairs = 2;
  status.chunks_waiting = 77;
  status.work = {12500, 40000, 3, 17, 5, 1, 60, 59, 7, 2, 1};
  status.refusals = {{"pieces_max", 3}, {"message_malformed", 1ULL << 40U}};
  status.latency = {{8000, 2100, 300}, {16000, 9000, limits::latency_max_us}};
  status.settings = {{"impacts", "true"}, {"collider", "field"}, {"material.rock.strength", "12.5"}};
  status.materials =
      MaterialLedger({{-5, 3, 2, 0, 0}, {}, {1LL << 40, 0, 7, (1LL << 40) + 9, -2}, {0, 0, 0, 0, 0, 99}});
  status.ledger_stored = 99;
  return status;
}

inline Prop prop() {
  Prop prop;
  prop.parts = {{.kind = PropPartKind::box, .place_m = {0.5F, 0.0F, -0.25F}, .half_m = {0.5F, 0.25F, 1.0F}},
                {.kind = PropPartKind::cylinder,
                 .turn = {0.70710678F, 0.0F, 0.70710678F, 0.0F},
                 .half_m = {0.3F, 0.1F, 0.5F}},
                {.kind = PropPartKind::hull,
                 .corners_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5F, 0.5F, 0.5F}}}};
  prop.parts.back().half_m = {0.5F, 0.5F, 0.5F};
  prop.motion = PropMotion::kinematic;
  prop.mass_kg = 120.5F;
  prop.friction = 0.25F;
  prop.restitution = 0.75F;
  prop.drag = 0.125F;
  prop.spin_drag = 0.5F;
  prop.gravity = -0.5F;
  prop.groups = 1U << 31U;
  prop.meets = 0x80000005U;
  prop.material = material::soil;
  prop.model = Digest{1, 2, 3};
  prop.tag = 0xFEDCBA9876543210ULL;
  prop.data = {0, 255, 7};
  return prop;
}

inline Region region() {
  Region region;
  region.id = 36;
  region.name = "tower";
  region.form = RegionForm::cylinder;
  region.centre_m = {-4.0F, 12.5F, 3.0F};
  region.half_m = {6.0F, 20.0F, 6.0F};
  region.forbids = forbids::edits | forbids::falls;
  region.editors = RegionEditors::persons;
  region.persons = {"Ann", "Bo"};
  region.teams = {"red"};
  region.tells = region.counts = true;
  region.until = 1ULL << 40U;
  return region;
}

inline Joint joint() {
  Joint joint;
  joint.kind = JointKind::hinge;
  joint.a = {32, {1.0F, -2.0F, 3.5F}, {0.5F, 0.5F, -0.5F, 0.5F}};
  joint.b = {0, {40.0F, -1.0F, 0.0F}};
  joint.limits = JointLimits{-1.0F, 2.0F};
  joint.motor = {0.5F, 1000.0F};
  joint.break_force_n = 1e5F;
  joint.break_torque_nm = 2e5F;
  joint.touches = true;
  return joint;
}

inline AdminListMessage body_list() {
  return {4,
          {},
          {},
          {{31, false, PropMotion::dynamic, true, {1, -2, 3, 4}, {0.5F, -9.0F, 0.0F}, 1234.5F},
           {32, true, PropMotion::kinematic, false, {}, {}, 200.0F, 1ULL << 63U}},
          {{33, joint()}},
          7};
}

inline WelcomeMessage replay_welcome() {
  WelcomeMessage welcome;
  welcome.session = 0x1234567890ABCDEFULL;
  welcome.tick = 42;
  welcome.terrain = {TerrainKind::noise, 99, 0.25F};
  welcome.interest_radius_m = 64.0F;
  welcome.replay = true;
  welcome.role = Role::carver;
  welcome.world = 0xFEDCBA9876543210ULL;
  welcome.ticket = std::string("\0\xFF ticket", 9);
  welcome.resumed = true;
  return welcome;
}

inline std::vector<ServerMessage> server_messages_but_stores() {
  const WelcomeMessage welcome = replay_welcome();
  ChunkMessage chunk;
  chunk.chunk = {-1, 2, 0};
  chunk.version = 17;
  chunk.bricks = {{{-4, 8, 0}, noisy_brick(3), all_of(material::rock)}, {{-1, 11, 3}, noisy_brick(4)}};
  chunk.hash = 0xFEDCBA9876543210ULL;
  WelcomeMessage on_heights = welcome;
  on_heights.palette = Digest{7, 6, 5};
  on_heights.spawn = Spawn{{-3.5F, 40.25F, 17.0F}, -120.5F, 12.0F};
  on_heights.heights = HeightGround{{87, 61, 10.0F, -512, 25600, {5.0F, 90.0F}},
                                    {1, 2, 255},
                                    BrickGround{{0.25F, {-5, -2, -7}, {6, 3, 1}}, {9, 8, 255}}};
  return {
      welcome,
      on_heights,
      RefusalMessage{"protocol 9 is not 1", "protocol_version"},
      frame(),
      FrameMessage{},
      chunk,
      PieceMessage{31, volume(), {1, -2, 3, 4}},
      PropMessage{32, prop(), {1, -2, 3, 4}},
      ContactsMessage{
          66, {{32, 0, {1, 2, 3}, {0, 1, 0}, 12.5F, 99.5F}, {5, 32, {4, 5, 6}, {1, 0, 0}, 0.0F, 1.0F}}},
      JointsMessage{{{33, joint()}}, {{2, JointEnd::let_go}, {3, JointEnd::broken}}},
      answer(),
      AnswerMessage{10, 0, {}, "more than 1000 questions a second", "queries_per_second"},
      ResetMessage{},
      RegionsMessage{{region()}},
      ReplyMessage{7, "radius 12 m is over 8 m", 0, "carve_invalid", {8300, limits::latency_max_us, 400}},
      ReplyMessage{8, "", 0, "", {}, 40, 3},
      ReplyMessage{9, "", 0, "", {}, 41, std::nullopt, 32},
      status(),
      CursorsMessage{{{4, "Ann", {1.0F, 2.0F, 3.0F}, {-4.0F, 0.5F, 9.0F}}, {9, "", {}, {}}}},
      PersonsMessage{{{4, "Ann", Role::builder}, {9, "", Role::viewer}}, 2, true},
      SaidMessage{4, "Ann", "mind the edge"},
      HealthMessage{true, false, true, 77, {{"saving", "the world cannot be saved"}, {"full", ""}}},
      PlaybackMessage{77, 0, 1ULL << 40U, -0.5F, true, 3, true, "ask for a token"},
      MarksMessage{9,
                   1ULL << 33U,
                   3,
                   1ULL << 40U,
                   {{EventKind::carve, 3, 1},
                    {EventKind::carve, 1023, limits::mark_count_max},
                    {EventKind::slow, 500, 300}}},
      RecordedCursorsMessage{{{4, "Ann", {1.0F, 2.0F, 3.0F}, {-4.0F, 0.5F, 9.0F}}}},
      physics(),
      GroundMessage{{-1, 2, 0}, false, 1ULL << 62U, {{{-4, 8, 0}, noisy_brick(5)}}, 0x123456789ABCDEF0ULL},
      GroundMessage{.chunk = {7, -8, 9}, .beyond = true},
      TileMessage{{1, 2, 3}, {9, 8, 7}},
      ContentMessage{{3, 1, 4}, 100, 40, {1, 5, 9, 2, 6}},
      ContentMessage{{3, 1, 4}},
      PaletteChangedMessage{{2, 7, 1, 8}},
      UnchangedChunksMessage{{{1, 2, 3}, {-4, 5, -6}}, {1, 0xFFFFFFFFFFFFFFFFULL}},
      AdminListMessage{
          3,
          {{7, "Ann", "scree-viewer", "127.0.0.1", Role::builder, 1ULL << 63U, 60, 1ULL << 40U, true}},
          {{"10.0.0.1", 90, "too loud"}}},
      body_list(),
      KeptPiecesMessage{{31, 34}, {2}},
      StoneMessage{{36, volume(), {-1, 2, -3, 4}}, 0x00800001U},
      PersonPlacesMessage{600, std::vector<PersonBody>{{3, 31}, {1ULL << 40U, 34}},
                          OwnPerson{70, {{1.0F, 2.0F, -3.0F}, {0.5F, -9.0F, 0.0F}, 0.0078125F, true, 2}}},
      UnknownMessage{}};
}

inline AddPieceMessage add_piece() {
  AddPieceMessage add;
  add.request = 34;
  add.volume = std::make_shared<const Volume>(volume());
  add.place_m = {1.0F, 2.0F, -3.0F};
  add.turn = {0.6F, 0.0F, 0.8F, 0.0F};
  add.velocity_m_s = {0.0F, -5.0F, 0.5F};
  add.spin_rad_s = {0.0F, 1.0F, 0.0F};
  add.kept = false;
  return add;
}

inline std::vector<ClientMessage> client_messages_but_stores() {
  CarveMessage carve;
  carve.request = 5;
  carve.shape = capsule({1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}, 1.5F);
  carve.pattern = SeedPattern::uniform;
  carve.random_seed = 0xFFFFFFFFU;
  carve.impact_m = {1.0F, -2.0F, 0.5F};
  CarveMessage authored = carve;
  authored.pattern = SeedPattern::authored;
  authored.seeds = 2;
  authored.authored_m = {{1.0F, 2.0F, 3.0F}, {-4.0F, 0.25F, 4095.0F}};
  AddPropMessage add_prop{
      {prop(), {1.0F, 2.0F, 3.0F}, {0.6F, 0.0F, 0.8F, 0.0F}, {4.0F, 5.0F, 6.0F}, {7, 8, 9}}, 21};
  MovePropMessage move_prop{{32, glm::vec3(1.0F), std::nullopt, glm::vec3(0.0F), std::nullopt}, 23};
  return {HelloMessage{protocol_version,
                       "scree-bot",
                       {1.0F, 2.0F, -3.0F},
                       96.0F,
                       "Ann",
                       "scree1.token",
                       true,
                       std::string("\xFF\0\x80", 3),
                       1ULL << 63U,
                       true},
          InterestMessage{{-9.0F, 8.0F, 7.0F}, 12.5F},
          carve,
          authored,
          FillMessage{{sphere({0.0F, 1.0F, 0.0F}, 2.0F)}, 6},
          PaintMessage{{box({0.0F, 1.0F, 0.0F}, {2.0F, 4.0F, 8.0F}), material::ice}, 8},
          RepairMessage{77, {{1, 2, 3}, {-4, 5, -6}}, {11, 0xFFFFFFFFFFFFFFFFULL}},
          AckMessage{1ULL << 40U},
          AdminMessage{8, "a-token-of-some-length", SettingsRequest{{{"dents", "false"}, {"impacts", ""}}}},
          AdminMessage{9, "", ListSessionsRequest{}},
          AdminMessage{10, "", KickRequest{77, "too loud"}},
          AdminMessage{11, "", BanRequest{0, "2001:db8::1", 90, "no reason"}},
          AdminMessage{12, "", ListBansRequest{}},
          AdminMessage{15, "", ListBodiesRequest{{{{-1.0F, -2.0F, -3.0F}, {4.0F, 5.0F, 6.0F}}}, {31, 32}}},
          AdminMessage{16, "", ListBodiesRequest{}},
          AdminMessage{17, "", ListJointsRequest{{{{-1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}}}}},
          AdminMessage{13, "", LiftBanRequest{"2001:db8::/64"}},
          AdminMessage{14, "", ControlReplayRequest{ReplayPlay::pause, -16.0F, ReplayMove::by_ticks, -7}},
          CursorMessage{{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, -6.0F}},
          PhysicsSubscriptionMessage{true, 12.5F},
          SayMessage{"mind the edge"},
          AskGroundMessage{{{1, 2, 3}, {-4, 5, -6}, {1, 2, 3}}},
          AskTilesMessage{{{3, 0, 0}, {2, 1, 0}}, {{0, 7, 9}, {4, -3, 2, -1, TileKind::bricks}}},
          AskContentMessage{{{3, 1, 4}, {2, 7, 1, 8}}},
          OfferMessage{0xABCDEF0123456789ULL, {{-4, 5, -6}, {1, 2, 3}, {1, 2, 4}}, {0xFFFF, 0x0100, 0}},
          add_prop,
          RemovePropMessage{{32}, 22},
          move_prop,
          PushMessage{{32, {1.0F, -2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}}, 24},
          BreakMessage{{31, {4.0F, 5.0F, 6.0F}, 6, 0xFFFFFFFFU}, 25},
          BlastMessage{{{4.0F, 5.0F, 6.0F}, 4.2e6F, 7}, 26},
          AddJointMessage{{joint()}, 28},
          RemoveJointMessage{{33}, 29},
          SetMotorMessage{{33, {-1.0F, 50.0F}}, 30},
          CarveMessage{{.shape = sphere({0.0F, 1.0F, 2.0F}, 1.0F), .piece = 77}, 33},
          CutOutMessage{{box({4.0F, 5.0F, 6.0F}, {1.0F, 2.0F, 1.0F})}, 31},
          ReleaseMessage{{34}, 32},
          StandMessage{{glm::vec3(4.0F, 5.0F, -6.0F)}, 36},
          WalkMessage{{{{0.5F, 0.0F, -0.25F}, true, true}, {0.0F, 0.6F, -0.8F}}, 71},
          add_piece(),
          query(),
          SetRegionMessage{{region(), 2.5F}, 35},
          RemoveRegionMessage{{"tower"}, 36},
          GoodbyeMessage{},
          AskHealthMessage{},
          UnknownMessage{}};
}

/// The last one is unknown.
inline std::vector<ServerMessage> server_messages() {
  std::vector<ServerMessage> messages = server_messages_but_stores();
  for (const auto& more : {store_server_messages(), rules_server_messages(), flight_server_messages()})
    messages.insert(messages.end() - 1, more.begin(), more.end());
  return messages;
}
inline std::vector<ClientMessage> client_messages() {
  std::vector<ClientMessage> messages = client_messages_but_stores();
  for (const auto& more : {store_client_messages(), rules_client_messages(), flight_client_messages()})
    messages.insert(messages.end() - 1, more.begin(), more.end());
  return messages;
}

/// The message without its length prefix.
inline std::span<const uint8_t> body_of(const std::vector<uint8_t>& framed) {
  return std::span<const uint8_t>(framed).subspan(length_prefix_bytes);
}

}  // namespace scree::samples
