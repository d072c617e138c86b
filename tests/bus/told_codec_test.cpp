// What comes from a bus may be anything: each decoder meets every truncation, bytes behind the end, changed
// bytes, and numbers beyond their limits.
#include <gtest/gtest.h>

#include "server/formats/bus_codec.h"
#include "server/told/told_parts.h"
#include "server/told/told_rows.h"
#include "shared/base/random.h"

namespace scree {
namespace {

template <typename Decode>
void expect_bounded(const std::vector<uint8_t>& whole, const Decode& decode) {
  ASSERT_TRUE(decode(whole));
  for (size_t size = 0; size < whole.size(); ++size)
    static_cast<void>(
        decode(std::vector<uint8_t>(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size))));
  Random random(7);
  for (int i = 0; i < 3000; ++i) {
    std::vector<uint8_t> changed = whole;
    for (int j = 0; j < 1 + i % 3; ++j)
      changed[random.next() % changed.size()] = static_cast<uint8_t>(random.next());
    if (i % 5 == 0) changed.push_back(static_cast<uint8_t>(random.next()));
    static_cast<void>(decode(changed));
  }
}

std::vector<uint8_t> empty_state(Tick tick) {
  RecordedKeyframe keyframe;
  keyframe.tick = tick;
  return encode(keyframe);
}

TEST(ToldCodec, no_bytes_are_too_strange_for_a_decoder) {
  expect_bounded(encode(ToldPart{3, 9, 1, 4, {1, 2, 3}}),
                 [](const auto& b) { return decode_told_part(b).has_value(); });
  expect_bounded(encode(ToldWhole{3, 9, 1}), [](const auto& b) { return decode_told_whole(b).has_value(); });
  expect_bounded(encode(PipeMessage{3, 9, 1, {4, 5}, true}),
                 [](const auto& b) { return decode_pipe_message(b).has_value(); });
  RecordedFrame frame;
  frame.tick = 12;
  CarveOperation carve;
  carve.shape = sphere({0.0F, 0.0F, 0.0F}, 1.0F);
  frame.operations.emplace_back(carve);
  expect_bounded(encode_told(frame), [](const auto& b) { return decode_told(b).has_value(); });
  ToldKeyframe keyframe{1, {1, 2}, empty_state(3), {{5, 6, {7}}}, {}};
  expect_bounded(encode(keyframe), [](const auto& b) {
    const auto told = decode_told_keyframe(b);
    if (told) static_cast<void>(parts_of(*told, 3, {}, {}));
    if (told) static_cast<void>(header_of(*told));
    return told.has_value();
  });
}

TEST(ToldCodec, a_part_that_is_none_of_its_value_is_refused) {
  EXPECT_FALSE(decode_told_part(encode(ToldPart{0, 1, 0, 1, {}})));
  EXPECT_FALSE(decode_told_part(encode(ToldPart{1, 1, 4, 4, {}})));
  EXPECT_FALSE(decode_told_part(encode(ToldPart{1, 1, 0, 0, {}})));
  EXPECT_FALSE(decode_told_part(encode(ToldPart{1, 1, 0, limits::told_parts_max + 1, {}})));
  EXPECT_FALSE(
      decode_told_part(encode(ToldPart{1, 1, 0, 1, std::vector<uint8_t>(limits::told_part_bytes_max + 1)})));
  EXPECT_FALSE(decode_told_whole(encode(ToldWhole{1, 1, 0})));
  EXPECT_FALSE(decode_pipe_message(encode(PipeMessage{0, 1, 0, {}, false})));
  EXPECT_FALSE(decode_pipe_message(
      encode(PipeMessage{1, 1, 0, std::vector<uint8_t>(limits::pipe_bytes_max + 1), false})));
}

TEST(ToldCodec, parts_in_order_are_the_value_and_others_are_dropped) {
  std::vector<uint8_t> bytes(10'000);
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<uint8_t>(i * 7);
  const uint32_t count = told_parts_of(bytes.size(), 3000);
  ASSERT_EQ(count, 4U);
  ToldAssembly assembly(20'000);
  const auto part = [&](uint32_t number) { return told_part(5, 8, bytes, 3000, number); };
  EXPECT_FALSE(assembly.add(part(1)));  // the first is missing
  for (const uint32_t number : {0U, 1U, 3U, 2U, 3U}) EXPECT_FALSE(assembly.add(part(number)));
  for (uint32_t number = 0; number + 1 < count; ++number) EXPECT_FALSE(assembly.add(part(number)));
  const auto whole = assembly.add(part(count - 1));
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->bytes, bytes);
  EXPECT_EQ(whole->tick, 8U);
  ToldAssembly small(5'000);
  for (uint32_t number = 0; number < count; ++number) EXPECT_FALSE(small.add(part(number)));
  ToldAssembly nothing(0);
  EXPECT_TRUE(nothing.add(ToldPart{1, 1, 0, 1, {}}));
}

TEST(ToldCodec, a_keyframe_with_rows_of_other_places_is_refused) {
  const auto parts = [](const ToldKeyframe& keyframe) { return parts_of(keyframe, 3, {}, {}); };
  const std::vector<uint8_t> state = empty_state(3);
  EXPECT_TRUE(parts({1, {}, state, {}, {}}));
  EXPECT_FALSE(parts({1, {}, empty_state(4), {}, {}}));
  EXPECT_FALSE(parts({1, {}, state, {}, {{1, 2, 3}}}));               // a piece that nobody names
  EXPECT_FALSE(parts({1, {}, state, {{9, 0, {}}, {8, 0, {}}}, {}}));  // in no order
  EXPECT_FALSE(parts({1, {}, state, {{~uint64_t{0}, 0, {}}}, {}}));   // of no place
}

}  // namespace
}  // namespace scree
