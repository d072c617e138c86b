// Splitting of the byte stream: any cut of the stream gives the same messages, and an oversized length is
// refused at once.
#include "proto/frame_reader.h"

#include <gtest/gtest.h>

#include "tests/support/wire_samples.h"

namespace scree {
namespace {

std::vector<std::vector<uint8_t>> drain(FrameReader& reader) {
  std::vector<std::vector<uint8_t>> bodies;
  while (true) {
    const auto next = reader.next();
    EXPECT_TRUE(next);
    if (!next || !*next) return bodies;
    bodies.emplace_back((*next)->begin(), (*next)->end());
  }
}

TEST(FrameReader, any_cut_of_the_stream_gives_the_same_messages) {
  std::vector<uint8_t> stream;
  std::vector<std::vector<uint8_t>> sent;
  for (const ClientMessage& message : samples::client_messages()) {
    const std::vector<uint8_t> bytes = encode(message);
    sent.emplace_back(bytes.begin() + length_prefix_bytes, bytes.end());
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
  for (size_t step = 1; step <= stream.size(); ++step) {
    FrameReader reader;
    std::vector<std::vector<uint8_t>> got;
    for (size_t at = 0; at < stream.size(); at += step) {
      reader.push(std::span(stream).subspan(at, std::min(step, stream.size() - at)));
      for (std::vector<uint8_t>& body : drain(reader)) got.push_back(std::move(body));
    }
    ASSERT_EQ(got, sent) << "in steps of " << step;
    EXPECT_EQ(reader.buffered_bytes(), 0U);
  }
}

TEST(FrameReader, an_oversized_length_is_refused_as_soon_as_it_is_there) {
  FrameReader reader(100);
  reader.push(std::vector<uint8_t>{101, 0, 0});
  ASSERT_TRUE(reader.next());
  reader.push(std::vector<uint8_t>{0});
  const auto refused = reader.next();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("101 bytes"), std::string::npos);
  EXPECT_NE(refused.error().message.find("over the limit of 100"), std::string::npos);
  EXPECT_FALSE(reader.next()) << "the refusal stays";
}

TEST(FrameReader, a_proxys_header_is_called_so) {
  for (const std::string_view header :
       {"PROXY TCP4 192.0.2.7 192.0.2.1 50000 4177\r\n", "\r\n\r\n\0\r\nQUIT\n"}) {
    FrameReader reader;
    reader.push(std::vector<uint8_t>(header.begin(), header.begin() + 4));
    const auto refused = reader.next();
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("--proxy"), std::string::npos) << refused.error().message;
  }
}

TEST(FrameReader, a_message_of_exactly_the_limit_passes) {
  FrameReader reader(100);
  std::vector<uint8_t> bytes(104, 7);
  bytes[0] = 100;
  bytes[1] = bytes[2] = bytes[3] = 0;
  reader.push(bytes);
  const auto body = reader.next();
  ASSERT_TRUE(body && *body);
  EXPECT_EQ((*body)->size(), 100U);
}

TEST(FrameReader, a_length_of_all_ones_is_refused) {
  FrameReader reader;
  reader.push(std::vector<uint8_t>(4, 0xFF));
  EXPECT_FALSE(reader.next());
}

}  // namespace
}  // namespace scree
