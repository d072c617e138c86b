// The wire's encoding: what goes in comes out, what is not a message is refused by name, and what is sent a
// thousand times a minute stays small.
#include "proto/codec.h"

#include <gtest/gtest.h>
#include <limits>

#include "proto/operation_codec.h"
#include "shared/base/limits.h"
#include "shared/recombine/stamp.h"
#include "tests/support/holds.h"
#include "tests/support/wire_refusals.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

CarveMessage carve_message(const Shape& shape, SeedPattern pattern = SeedPattern::radial,
                           uint32_t seeds = 8) {
  CarveMessage carve;
  carve.shape = shape;
  carve.pattern = pattern;
  carve.seeds = seeds;
  return carve;
}

TEST(Codec, every_server_message_round_trips) {
  for (const ServerMessage& message : samples::server_messages()) {
    const std::vector<uint8_t> bytes = encode(message);
    const Result<ServerMessage> decoded = decode_server(samples::body_of(bytes));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(decoded->index(), message.index());
    EXPECT_EQ(encode(*decoded), bytes) << "message " << message.index();
  }
}

TEST(Codec, every_client_message_round_trips) {
  for (const ClientMessage& message : samples::client_messages()) {
    const std::vector<uint8_t> bytes = encode(message);
    const Result<ClientMessage> decoded = decode_client(samples::body_of(bytes));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(decoded->index(), message.index());
    EXPECT_EQ(encode(*decoded), bytes) << "message " << message.index();
  }
}

TEST(Codec, an_operation_of_no_kind_is_refused) {
  const std::vector<uint8_t> head{7, 7};
  const Result<Operation> got = decode_operation(head);
  ASSERT_FALSE(got);
  EXPECT_TRUE(holds(got.error().message, "kind of an operation with a material")) << got.error().message;
}

TEST(Codec, a_frame_keeps_its_operations_patches_and_lists) {
  const FrameMessage sent = samples::frame();
  const std::vector<uint8_t> bytes = encode(ServerMessage{sent});
  const Result<ServerMessage> decoded = decode_server(samples::body_of(bytes));
  ASSERT_TRUE(decoded) << decoded.error().message;
  const auto& got = std::get<FrameMessage>(*decoded);
  EXPECT_EQ(got.tick, sent.tick);
  EXPECT_EQ(got.operations, sent.operations);
  EXPECT_EQ(got.dropped_chunks, sent.dropped_chunks);
  EXPECT_EQ(got.removed_pieces, sent.removed_pieces);
  EXPECT_EQ(got.transforms, sent.transforms);
  EXPECT_EQ(got.motions, sent.motions);
  EXPECT_TRUE(got.has_check);
  EXPECT_EQ(got.check, sent.check);
  ASSERT_EQ(got.patches.size(), sent.patches.size());
  for (size_t i = 0; i < got.patches.size(); ++i) {
    EXPECT_EQ(got.patches[i].coord, sent.patches[i].coord);
    EXPECT_EQ(got.patches[i].brick, sent.patches[i].brick);
  }
}

TEST(Codec, a_volume_round_trips) {
  const Volume sent = samples::volume();
  const Result<Volume> got = decode_volume(encode_volume(sent));
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_EQ(got->window.box.lo, sent.window.box.lo);
  EXPECT_EQ(got->window.box.hi, sent.window.box.hi);
  EXPECT_EQ(got->window.codes, sent.window.codes);
  EXPECT_EQ(got->mass, sent.mass);
  EXPECT_EQ(got->centre_voxels, sent.centre_voxels);
}

TEST(Codec, stamps_round_trip_at_the_ends_of_their_range) {
  for (const int32_t x : {0, 1, -1, 65535, -65536, limits::pose_coordinate_max, -limits::pose_coordinate_max})
    for (const int32_t y : {0, -limits::pose_coordinate_max, 1023})
      for (const StampMethod method : all_kinds<StampMethod>)
        for (const int32_t shift : {-stamp_shift_max, 0, stamp_shift_max}) {
          const Operation sent = StampOperation{0xFFFFFFFFU, {x, y, -x, 0xFFFFFFFFU}, shift, method};
          const Result<Operation> got = decode_operation(encode_operation(sent));
          ASSERT_TRUE(got) << got.error().message;
          EXPECT_EQ(*got, sent);
        }
}

TEST(Codec, stamps_of_several_pieces_round_trip_and_more_than_may_merge_together_are_refused_by_name) {
  StampOperation sent{5, {1, -2, 3, 4}, -77};
  while (sent.others.size() + 1 < limits::stamp_group_max) {
    sent.others.push_back(
        {0xFFFFFFFFU - static_cast<PieceId>(sent.others.size()), {-70000, 8, 9, 0x89ABCDEFU}});
    const Result<Operation> got = decode_operation(encode_operation(sent));
    ASSERT_TRUE(got) << got.error().message;
    EXPECT_EQ(*got, Operation(sent));
  }
  sent.others.assign(2, {7, {}});
  const size_t two = encode_operation(sent).size();
  sent.others.resize(1);
  std::vector<uint8_t> bytes = encode_operation(sent);
  uint8_t& count = bytes[2 * bytes.size() - two - 1];  // right before the other
  ASSERT_EQ(count, 1U);
  for (const size_t refused : {size_t{0}, limits::stamp_group_max}) {
    count = static_cast<uint8_t>(refused);
    const Result<Operation> got = decode_operation(bytes);
    ASSERT_FALSE(got);
    EXPECT_TRUE(holds(got.error().message, "together")) << got.error().message;
  }
}

TEST(Codec, a_carve_alone_in_its_frame_takes_at_most_200_bytes) {
  FrameMessage frame;
  frame.tick = 1U << 20U;
  frame.operations = {samples::carve_operation()};
  frame.has_check = true;
  EXPECT_LE(encode(ServerMessage{frame}).size(), 200U);
  frame.operations = {CarveOperation{capsule({60.0F, 1.0F, 2.0F}, {61.0F, 2.0F, 3.0F}, 2.0F),
                                     SeedPattern::uniform,
                                     limits::seeds_max,
                                     0xFFFFFFFFU,
                                     {60.0F, 3.0F, 2.0F},
                                     1U << 30U}};
  EXPECT_LE(encode(ServerMessage{frame}).size(), 200U);
}

TEST(Codec, a_stamp_alone_in_its_frame_takes_at_most_33_bytes) {
  FrameMessage frame;
  frame.tick = (1U << 27U) - 1;  // 25 days at 60 Hz
  frame.operations = {
      StampOperation{(1U << 18U) - 1, {65535, -65536, -65000, 0xFFFFFFFFU}, -stamp_shift_max}};
  frame.has_check = true;
  frame.check = 0xFFFFFFFFU;
  EXPECT_LE(encode(ServerMessage{frame}).size(), 33U);
}

TEST(Codec, numbers_that_are_not_finite_are_refused_by_name) {
  EXPECT_TRUE(holds(client_refusal(carve_message(sphere({nan, 0.0F, 0.0F}, 2.0F))), "shape.a"));
  EXPECT_TRUE(holds(client_refusal(carve_message(sphere(glm::vec3(0.0F), infinity))), "radius_m"));
  EXPECT_TRUE(holds(client_refusal(FillMessage{{box({0, 0, 0}, {1, nan, 1})}, 1}), "shape.b"));
  EXPECT_TRUE(holds(client_refusal(InterestMessage{{0, -infinity, 0}, 1.0F}), "eye"));
  EXPECT_TRUE(holds(client_refusal(InterestMessage{{0, 0, 0}, nan}), "radius_m"));
  EXPECT_TRUE(holds(client_refusal(InterestMessage{{0, 0, 0}, -1.0F}), "radius_m is negative"));
  FrameMessage frame;
  frame.operations = {FillOperation{sphere({0, nan, 0}, 1.0F)}};
  EXPECT_TRUE(holds(server_refusal(frame), "shape is not a finite number"));
  StatusMessage status;
  status.tick_worst_ms = infinity;
  EXPECT_TRUE(holds(server_refusal(status), "tick_worst_ms"));
  status.tick_worst_ms = 1.0F;
  status.stages = {{"carve", 1.0F}, {"bodies", nan}};
  EXPECT_TRUE(holds(server_refusal(status), "ms of a stage"));
  status.stages[1].ms = -1.0F;
  EXPECT_TRUE(holds(server_refusal(status), "ms of a stage is negative"));
}

TEST(Codec, a_carve_over_the_limits_is_decoded_for_the_world_to_answer) {
  EXPECT_EQ(client_refusal(carve_message(sphere(glm::vec3(1e9F), -3.0F), SeedPattern::radial, 1U << 30U)),
            "");
}

TEST(Codec, unknown_enum_values_are_refused_by_name) {
  // A request of a later version is answered by its reply, and the connection goes on.
  const auto unknown_value = [](const ClientMessage& message) {
    const std::vector<uint8_t> bytes = encode(message);
    const Result<ClientMessage> decoded = decode_client(samples::body_of(bytes));
    return decoded ? std::get<UnknownMessage>(*decoded).value : "";
  };
  EXPECT_EQ(unknown_value(FillMessage{{{static_cast<ShapeKind>(99), {}, {}, 1.0F}}, 1}), "kind of shape 99");
  EXPECT_EQ(unknown_value(carve_message({}, static_cast<SeedPattern>(99))), "pattern 99");
  WelcomeMessage welcome;
  welcome.terrain.kind = static_cast<TerrainKind>(77);
  EXPECT_TRUE(holds(server_refusal(welcome), "kind of terrain 77"));
}

TEST(Codec, values_beyond_their_range_are_refused_by_name) {
  WelcomeMessage welcome;
  welcome.tick_rate_hz = 0;
  EXPECT_TRUE(holds(server_refusal(welcome), "tick_rate_hz"));
  welcome.tick_rate_hz = 60;
  welcome.terrain.voxel_size_m = 0.0F;
  EXPECT_TRUE(holds(server_refusal(welcome), "voxel_size_m"));
  PieceMessage piece{1, samples::volume(), {}};
  piece.pose.y = std::numeric_limits<int32_t>::min();
  EXPECT_TRUE(holds(server_refusal(piece), "position"));
  EXPECT_TRUE(holds(server_refusal(StoneMessage{piece, 1}), "position"));
  EXPECT_TRUE(holds(server_refusal(StoneMessage{{1, samples::volume(), {}}, 0}), "nothing is rock"));
  FrameMessage frame;
  for (const StampOperation& stamp : {StampOperation{1, {}, -stamp_shift_max - 1},
                                      StampOperation{1, {}, -stamp_shift_max - 1, StampMethod::sphere},
                                      StampOperation{1, {}, 0, static_cast<StampMethod>(6)}}) {
    frame.operations = {stamp};
    EXPECT_TRUE(holds(server_refusal(frame), "shift of a stamp"));
  }
  frame.operations = {
      CarveOperation{sphere({0, 0, 0}, 1.0F), SeedPattern::uniform, limits::seeds_max + 1, 0, {}, 0}};
  EXPECT_TRUE(holds(server_refusal(frame), "number of seeds"));
  frame.operations = {CarveOperation{sphere({0, 0, 0}, 1.0F), SeedPattern::uniform, 9, 0, {}, 0xFFFFFFFFU}};
  EXPECT_TRUE(holds(server_refusal(frame), "piece ids"));
}

TEST(Codec, stages_of_a_request_are_bounded) {
  for (const LatencyStageRow& stage : latency_stages) {
    ReplyMessage reply{1, "", 2};
    StatusMessage status;
    reply.latency.*stage.us = status.latency.median.*stage.us = limits::latency_max_us;
    status.latency.worst.*stage.us = limits::latency_max_us;
    EXPECT_EQ(server_refusal(reply), "");
    EXPECT_EQ(server_refusal(status), "");
    reply.latency.*stage.us = status.latency.worst.*stage.us = limits::latency_max_us + 1;
    EXPECT_TRUE(holds(server_refusal(reply), "microseconds of a stage"));
    EXPECT_TRUE(holds(server_refusal(status), "microseconds of a stage"));
  }
}

TEST(Codec, cutters_and_authored_seeds_beyond_the_known_are_refused_by_name) {
  const auto refusal = [](const Operation& operation) {
    FrameMessage frame;
    frame.operations = {operation};
    return server_refusal(frame);
  };
  CarveOperation carve = samples::authored_carve_operation();
  EXPECT_EQ(refusal(carve), "");
  carve.cutter = static_cast<Cutter>(3);
  EXPECT_TRUE(holds(refusal(carve), "cutter"));
  carve = samples::authored_carve_operation();
  carve.authored_m.assign(limits::authored_seeds_max + 1, glm::vec3(0.0F));
  carve.seeds = limits::authored_seeds_max + 1;
  EXPECT_TRUE(holds(refusal(carve), "authored_seeds_max"));
  carve = samples::authored_carve_operation();
  carve.authored_m.back().z = nan;
  EXPECT_TRUE(holds(refusal(carve), "authored seed"));
  carve.authored_m.pop_back();
  EXPECT_NE(refusal(carve), "") << "a point is missing";
  CarveMessage message = carve_message(sphere(glm::vec3(0.0F), 1.0F), SeedPattern::authored);
  message.authored_m.assign(limits::seeds_max, glm::vec3(1.0F));
  EXPECT_EQ(client_refusal(message), "") << "for the world to answer";
  message.authored_m.emplace_back(1.0F);
  EXPECT_TRUE(holds(client_refusal(message), "more than 4096 points"));
  message.authored_m.assign(2, glm::vec3(infinity));
  EXPECT_TRUE(holds(client_refusal(message), "authored"));
}

TEST(Codec, counts_over_their_limit_are_refused_by_name) {
  FrameMessage frame;
  frame.operations.assign(limits::operations_per_frame_max + 1, DiscardOperation{1});
  EXPECT_TRUE(holds(server_refusal(frame), "operation: more than 4096"));
  RepairMessage repair;
  repair.chunks.resize(limits::repair_chunks_max + 1);
  repair.hashes.resize(repair.chunks.size());
  EXPECT_TRUE(holds(client_refusal(repair), "more than 1024 chunks"));
  repair.chunks.resize(3);
  repair.hashes.resize(2);
  EXPECT_TRUE(holds(client_refusal(repair), "2 hashes for 3 chunks"));
  const SettingValues many(limits::settings_max + 1);
  EXPECT_TRUE(holds(client_refusal(AdminMessage{1, "", SettingsRequest{many}}),
                    "129 settings are over the limit of 128"));
  StatusMessage status;
  status.settings = many;
  EXPECT_TRUE(holds(server_refusal(status), "129 settings"));
  status.settings.clear();
  status.work.budget_us = limits::tick_budget_max_us + 1;
  EXPECT_TRUE(holds(server_refusal(status), "budget_us is 1000001"));
  status.work = {};
  status.work.ticks_cut_short = 1001;
  EXPECT_TRUE(holds(server_refusal(status), "ticks_cut_short is 1001"));
  status.work = {};
  status.work.ticks_merging_sooner = 1001;
  EXPECT_TRUE(holds(server_refusal(status), "ticks_merging_sooner is 1001"));
  status.work = {};
  status.refusals.resize(limits::refusal_counts_max + 1);
  EXPECT_TRUE(holds(server_refusal(status), "more than 128 reasons"));
}

TEST(Codec, bricks_twice_astray_or_too_many_are_refused) {
  FrameMessage frame;
  frame.patches = {{{1, 1, 1}, air_brick()}, {{1, 1, 1}, air_brick()}};
  EXPECT_TRUE(holds(server_refusal(frame), "a brick comes twice"));
  ChunkMessage chunk;
  chunk.bricks = {{{4, 0, 0}, air_brick()}};
  EXPECT_TRUE(holds(server_refusal(chunk), "a brick of another chunk"));
  std::vector<BrickPatch> many(9);
  for (int i = 0; i < 9; ++i) many[static_cast<size_t>(i)] = {{i, 0, 0}, solid_brick()};
  EXPECT_TRUE(decode_bricks(encode_bricks(many), 9));
  EXPECT_FALSE(decode_bricks(encode_bricks(many), 8));
}

TEST(Codec, a_part_of_a_chunk_says_which_bricks_are_edited_and_has_its_hash_last) {
  ChunkMessage part;
  part.bricks = {{{0, 0, 0}, air_brick()}};
  part.more = true;
  EXPECT_TRUE(holds(server_refusal(part), "of which more comes, but is no part"));
  part.edited = 0b10;
  EXPECT_TRUE(holds(server_refusal(part), "not among the chunk's edited ones"));
  part.edited = 0b11;
  part.hash = 1;
  EXPECT_TRUE(holds(server_refusal(part), "before the last one"));
  part.more = false;
  const std::vector<uint8_t> bytes = encode(ServerMessage(part));
  const auto decoded = decode_server(std::span(bytes).subspan(length_prefix_bytes));
  EXPECT_EQ(std::get<ChunkMessage>(decoded.value()).edited, part.edited);
}

TEST(Codec, a_count_that_the_bytes_cannot_hold_is_refused_before_it_is_allocated) {
  const Result<std::vector<BrickPatch>> got =
      decode_bricks(std::vector<uint8_t>{0xFF, 0xFF, 0xFF, 0xFF, 0x0F, 0, 0, 0}, size_t{1} << 40U);
  ASSERT_FALSE(got);
  EXPECT_TRUE(holds(got.error().message, "ends within coordinates"));
}

TEST(Codec, a_window_wider_than_the_limit_is_refused) {
  Volume wide;
  wide.window = Window(VoxelBox{{0, 0, 0}, {limits::window_side_max + 1, 1, 1}});
  const Result<Volume> got = decode_volume(encode_volume(wide));
  ASSERT_FALSE(got);
  EXPECT_TRUE(holds(got.error().message, "side is 129, over the limit of 128"));
}

TEST(Codec, a_code_beyond_the_band_is_refused) {
  Volume volume = samples::volume();
  volume.window.codes[5] = -128;
  EXPECT_FALSE(decode_volume(encode_volume(volume)));
}

TEST(Codec, packed_fields_refuse_every_truncation_and_any_byte_left_over) {
  const std::vector<BrickPatch> bricks = {{{-5, 0, 7}, samples::noisy_brick(1)}};
  const auto refuses_all_but_whole = [](std::vector<uint8_t> bytes, auto&& decodes) {
    for (size_t length = 1; length < bytes.size(); ++length)
      EXPECT_FALSE(decodes(std::span(bytes).first(length))) << "cut to " << length;
    EXPECT_TRUE(decodes(std::span(bytes)));
    bytes.push_back(0);
    EXPECT_FALSE(decodes(std::span(bytes)));
  };
  refuses_all_but_whole(encode_bricks(bricks), [](auto b) { return decode_bricks(b).has_value(); });
  refuses_all_but_whole(encode_volume(samples::volume()),
                        [](auto b) { return decode_volume(b).has_value(); });
  for (const Operation& operation : samples::frame().operations)
    refuses_all_but_whole(encode_operation(operation),
                          [](auto b) { return decode_operation(b).has_value(); });
}

TEST(Codec, another_protocol_is_decoded_so_that_it_can_be_answered) {
  const std::vector<uint8_t> bytes =
      encode(ClientMessage{HelloMessage{protocol_version + 1, "future", {nan, 0, 0}, -1.0F}});
  const Result<ClientMessage> got = decode_client(samples::body_of(bytes));
  ASSERT_TRUE(got);
  EXPECT_EQ(std::get<HelloMessage>(*got).protocol, protocol_version + 1);
}

TEST(Codec, text_is_cut_to_its_limit_and_cleaned_when_written) {
  const std::vector<uint8_t> bytes =
      encode(ServerMessage{RefusalMessage{"a\nb" + std::string(limits::reason_bytes_max, 'x')}});
  const Result<ServerMessage> got = decode_server(samples::body_of(bytes));
  ASSERT_TRUE(got) << got.error().message;
  const std::string& reason = std::get<RefusalMessage>(*got).reason;
  EXPECT_EQ(reason.size(), limits::reason_bytes_max);
  EXPECT_EQ(reason.substr(0, 3), "a b");
}

TEST(Codec, text_with_control_characters_or_over_its_limit_is_refused_when_read) {
  // Hello{protocol, client}: field 1 of the envelope, whose field 1 is a varint and field 2 bytes.
  std::vector<uint8_t> body = {0x0A, 7, 0x08, protocol_version, 0x12, 3, 'a', 0x1B, 'b'};
  EXPECT_TRUE(holds(decode_client(body).error().message, "client holds control characters"));
  body[7] = '-';
  EXPECT_TRUE(decode_client(body));
  body = {0x0A, 69, 0x08, protocol_version, 0x12, 65};
  body.insert(body.end(), 65, 'a');
  EXPECT_TRUE(holds(decode_client(body).error().message, "client has 65 bytes, over the limit of 64"));
}

TEST(Codec, an_admins_text_over_its_limit_is_refused_by_name) {
  // Admin is field 7 of the envelope; its field 2 is the token, its field 3 a Setting of a name and a value.
  const auto with_lengths = [](std::vector<uint8_t> head, size_t bytes) {
    head.insert(head.end(), bytes, 'a');
    return head;
  };
  EXPECT_TRUE(decode_client(with_lengths({0x3A, 131, 1, 0x12, 128, 1}, 128)));
  EXPECT_TRUE(holds(decode_client(with_lengths({0x3A, 132, 1, 0x12, 129, 1}, 129)).error().message,
                    "token has 129 bytes, over the limit of 128"));
  EXPECT_TRUE(decode_client(with_lengths({0x3A, 68, 0x1A, 66, 0x0A, 64}, 64)));
  EXPECT_TRUE(holds(decode_client(with_lengths({0x3A, 69, 0x1A, 67, 0x0A, 65}, 65)).error().message,
                    "name of a setting has 65 bytes"));
  EXPECT_TRUE(holds(decode_client(with_lengths({0x3A, 69, 0x1A, 67, 0x12, 65}, 65)).error().message,
                    "value of a setting has 65 bytes"));
}

}  // namespace
}  // namespace scree
