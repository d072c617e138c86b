// The server's end of a WebSocket: what it takes however it is cut, what it refuses, what it answers.
#include "transport/websocket_engine.h"

#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "tests/support/web_client.h"

namespace scree {
namespace {

using Bytes = std::vector<uint8_t>;
constexpr uint64_t largest_frame = 70'000;

class EngineTest : public ::testing::Test {
 protected:
  /// What comes out, the frames cut into parts of so many bytes.
  Bytes read_all(const Bytes& frames, size_t part_bytes = SIZE_MAX) {
    Bytes payload;
    for (size_t from = 0; from < frames.size();) {
      const auto part = std::span(frames).subspan(from, std::min(part_bytes, frames.size() - from));
      engine.feed(part);
      from += part.size();
      Bytes into(999);
      for (auto got = engine.read(into); got && got->bytes > 0; got = engine.read(into))
        payload.insert(payload.end(), into.begin(), into.begin() + static_cast<ptrdiff_t>(got->bytes));
    }
    return payload;
  }
  Bytes output() {
    Bytes bytes;
    engine.drain_output(bytes);
    return bytes;
  }
  /// Code of the close in the output; 0: there is none.
  uint16_t close_code() {
    const Bytes bytes = output();
    return bytes.size() == 4 && bytes[0] == 0x88 ? static_cast<uint16_t>(bytes[2] << 8U | bytes[3]) : 0;
  }
  void expect_refused(const Bytes& frames, uint16_t code) {
    engine.feed(frames);
    Bytes into(100);
    EXPECT_FALSE(engine.read(into));
    EXPECT_EQ(close_code(), code);
    engine.feed(websocket_frame(Bytes{1, 2, 3}));
    EXPECT_FALSE(engine.read(into)) << "an error is final";
  }

  double now_s = 0.0;
  WebSocketEngine engine{largest_frame, [this] { return now_s; }};
};

Bytes noise(size_t count, uint32_t seed) {
  Random random(seed);
  Bytes bytes(count);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.below(256));
  return bytes;
}

void append(Bytes& to, const Bytes& more) {
  to.insert(to.end(), more.begin(), more.end());
}

TEST_F(EngineTest, gives_out_payloads_as_one_stream_however_they_are_cut) {
  for (const size_t part_bytes : {size_t{1}, size_t{7}, size_t{4096}, SIZE_MAX}) {
    Bytes frames, wanted;
    for (const size_t size : {1, 125, 126, 5000, 65535, 65536, 70'000}) {
      append(wanted, noise(size, static_cast<uint32_t>(size)));
      append(frames, websocket_frame(noise(size, static_cast<uint32_t>(size))));
    }
    EXPECT_EQ(read_all(frames, part_bytes), wanted) << part_bytes;
    EXPECT_TRUE(output().empty());
  }
}

TEST_F(EngineTest, takes_fragments_with_pings_between_them) {
  const Bytes a = noise(300, 1), b = noise(200, 2), c = noise(1, 3), empty;
  Bytes frames = websocket_frame(a, {.fin = false});
  append(frames, websocket_frame(Bytes{'h', 'i'}, {.opcode = 9}));
  append(frames, websocket_frame(b, {.opcode = 0, .fin = false}));
  append(frames, websocket_frame(empty, {.opcode = 0, .fin = false}));
  append(frames, websocket_frame(c, {.opcode = 0}));
  Bytes wanted = a;
  append(wanted, b);
  append(wanted, c);
  EXPECT_EQ(read_all(frames, 3), wanted);
  EXPECT_EQ(output(), (Bytes{0x8a, 2, 'h', 'i'})) << "the pong";
}

TEST_F(EngineTest, sends_frames_without_a_mask_of_one_record_at_most) {
  const Bytes plain = noise(limits::websocket_chunk_bytes, 4);
  ASSERT_TRUE(engine.write(plain));
  const Bytes sent = output();
  ASSERT_EQ(sent.size(), plain.size() + 4);
  EXPECT_EQ(sent[0], 0x82);
  EXPECT_EQ(sent[1], 126);
  EXPECT_LE(sent.size(), size_t{16} << 10);
  EXPECT_TRUE(std::equal(plain.begin(), plain.end(), sent.begin() + 4));
}

TEST_F(EngineTest, answers_a_close_and_then_loses_what_is_written) {
  Bytes frames = websocket_frame(Bytes{7});
  append(frames, websocket_frame(Bytes{0x03, 0xe8}, {.opcode = 8}));
  EXPECT_EQ(read_all(frames), Bytes{7});
  EXPECT_EQ(close_code(), 1000);
  Bytes into(10);
  const auto got = engine.read(into);
  EXPECT_TRUE(got && got->ended);
  EXPECT_TRUE(engine.write(Bytes{1}));
  EXPECT_TRUE(output().empty());
}

TEST_F(EngineTest, closes_in_order) {
  engine.finish();
  EXPECT_EQ(close_code(), 1000);
  EXPECT_EQ(read_all(websocket_frame(Bytes{1, 2})), (Bytes{1, 2})) << "what was on its way";
  read_all(websocket_frame(Bytes{0x03, 0xe8}, {.opcode = 8}));
  Bytes into(10);
  EXPECT_TRUE(engine.read(into)->ended);
}

TEST_F(EngineTest, refuses_frames_without_a_mask) {
  expect_refused(websocket_frame(Bytes{1}, {.masked = false}), 1002);
}
TEST_F(EngineTest, refuses_text) {
  expect_refused(websocket_frame(Bytes{'a'}, {.opcode = 1}), 1003);
}
TEST_F(EngineTest, refuses_reserved_bits) {
  expect_refused(websocket_frame(Bytes{1}, {.reserved = 4}), 1002);
}
TEST_F(EngineTest, refuses_unknown_opcodes) {
  expect_refused(websocket_frame(Bytes{1}, {.opcode = 3}), 1002);
}
TEST_F(EngineTest, refuses_a_continuation_of_nothing) {
  expect_refused(websocket_frame(Bytes{1}, {.opcode = 0}), 1002);
}
TEST_F(EngineTest, refuses_a_message_within_another) {
  Bytes frames = websocket_frame(Bytes{1}, {.fin = false});
  append(frames, websocket_frame(Bytes{1}));
  engine.feed(frames);
  Bytes into(100);
  EXPECT_EQ(engine.read(into)->bytes, 1U) << "what came before is given out";
  EXPECT_FALSE(engine.read(into));
  EXPECT_EQ(close_code(), 1002);
}
TEST_F(EngineTest, refuses_frames_over_the_limit_by_their_head_alone) {
  expect_refused(websocket_frame(Bytes{1}, {.says_bytes = largest_frame + 1}), 1009);
}
TEST_F(EngineTest, refuses_lengths_beyond_all_bounds) {
  expect_refused(websocket_frame(Bytes{1}, {.says_bytes = (uint64_t{1} << 63U) - 1}), 1009);
}

TEST_F(EngineTest, refuses_controls_that_are_long_or_cut) {
  for (const FrameShape& shape :
       {FrameShape{.opcode = 9, .says_bytes = 126}, FrameShape{.opcode = 9, .fin = false}}) {
    WebSocketEngine other(largest_frame);
    other.feed(websocket_frame(Bytes{1}, shape));
    Bytes into(10);
    EXPECT_FALSE(other.read(into));
  }
}

TEST_F(EngineTest, bounds_frames_that_carry_nothing_by_time) {
  const Bytes ping = websocket_frame({}, {.opcode = 9}), empty = websocket_frame({});
  const auto burst = static_cast<size_t>(limits::bare_frames_burst_max);
  Bytes into(10);
  for (size_t i = 0; i < burst; ++i) engine.feed(i % 2 == 0 ? ping : empty);
  EXPECT_TRUE(engine.read(into));
  now_s += 1.0;
  for (size_t i = 0; i < static_cast<size_t>(limits::bare_frames_per_second_max); ++i) engine.feed(ping);
  EXPECT_TRUE(engine.read(into)) << "a second later there may be more";
  output();
  expect_refused(empty, 1008);
}

TEST_F(EngineTest, waits_at_every_byte_of_a_frame) {
  const Bytes whole = websocket_frame(noise(200, 5));
  for (size_t bytes = 0; bytes < whole.size(); ++bytes) {
    WebSocketEngine cut(largest_frame);
    cut.feed(std::span(whole).first(bytes));
    Bytes into(500);
    const auto got = cut.read(into);
    ASSERT_TRUE(got) << bytes;
    EXPECT_EQ(got->bytes, bytes > 8 ? bytes - 8 : 0) << bytes;
    EXPECT_FALSE(got->ended);
  }
}

}  // namespace
}  // namespace scree
