// Persons and what they say: within bounds, and texts that may be shown.
#include <gtest/gtest.h>

#include "proto/codec.h"
#include "proto/limits.h"
#include "tests/support/holds.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

template <typename Message>
Message sent_again(const Message& sent) {
  const Result<ServerMessage> got = decode_server(samples::body_of(encode(ServerMessage(sent))));
  EXPECT_TRUE(got) << got.error().message;
  return got ? std::get<Message>(*got) : Message{};
}

/// A field of bytes with a number of up to 31.
std::string field(int number, const std::string& content) {
  std::string bytes;
  const auto varint = [&](size_t value) {
    for (; value > 0x7FU; value >>= 7U) bytes.push_back(static_cast<char>((value & 0x7FU) | 0x80U));
    bytes.push_back(static_cast<char>(value));
  };
  varint(static_cast<size_t>(number) << 3U | 2U);
  varint(content.size());
  return bytes + content;
}

/// What a receiver says of bytes that no sender of ours writes.
std::string server_refusal_of(const std::string& bytes) {
  const Result<ServerMessage> got =
      decode_server({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
  return got ? "" : got.error().message;
}

TEST(TalkCodec, persons_arrive_as_sent_and_the_rest_is_counted) {
  PersonsMessage sent{{{4, "Ann", Role::builder}, {9, "", Role::viewer}}, 3, true};
  EXPECT_EQ(sent_again(sent), sent);
  sent.persons.clear();
  for (uint64_t session = 1; session <= limits::persons_max + 5; ++session)
    sent.persons.push_back({session, std::string(100, 'x'), Role::carver});
  const PersonsMessage got = sent_again(sent);
  EXPECT_EQ(got.persons.size(), limits::persons_max);
  EXPECT_EQ(got.persons[0].name.size(), limits::person_name_bytes_max);
  EXPECT_EQ(got.more, 8U);
}

TEST(TalkCodec, lines_are_cleaned_by_the_sender) {
  EXPECT_EQ(sent_again(SaidMessage{1, "A\nnn", "mind\x1b[2J the edge\u202E"}).text, "mind [2J the edge ");
  EXPECT_EQ(sent_again(SaidMessage{1, "", std::string(500, 'x')}).text.size(), limits::line_bytes_max);
}

TEST(TalkCodec, what_breaks_a_rule_is_refused_by_the_receiver) {
  const auto said = [](const std::string& text) { return server_refusal_of(field(31, field(3, text))); };
  EXPECT_EQ(said("a b"), "");
  EXPECT_TRUE(holds(said(""), "without text"));
  EXPECT_TRUE(holds(said("a\nb"), "text of a line"));
  EXPECT_TRUE(holds(said(std::string(limits::line_bytes_max + 1, 'x')), "text of a line"));
  const auto persons = [](const std::vector<int>& sessions, int role) {
    std::string list;
    for (const int session : sessions)
      list += field(1, {0x08, static_cast<char>(session), 0x18, static_cast<char>(role)});
    return server_refusal_of(field(30, list));
  };
  EXPECT_EQ(persons({1, 2, 3}, 0), "");
  EXPECT_TRUE(holds(persons({1, 3, 3}, 0), "do not ascend"));
  EXPECT_EQ(persons({1}, 77), "");  // a role of a later version shows as a viewer's
  std::vector<int> many;
  for (int session = 1; session <= static_cast<int>(limits::persons_max) + 1; ++session)
    many.push_back(session);
  EXPECT_TRUE(holds(persons(many, 0), "more than 64 persons"));
  const std::string say = field(30, field(1, "a\tb"));
  EXPECT_FALSE(decode_client({reinterpret_cast<const uint8_t*>(say.data()), say.size()}));
}

}  // namespace
}  // namespace scree
