// Codecs skip unknown kinds and fields of a later release. They refuse unknown values only where these decide
// a change that the peer must apply.
#include <gtest/gtest.h>

#include "proto/codec.h"
#include "tests/support/growing_relay.h"
#include "tests/support/holds.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

TEST(Growth, every_message_decodes_as_before_with_unknown_fields_in_it_and_around_it) {
  for (const ServerMessage& message : samples::server_messages()) {
    if (std::holds_alternative<UnknownMessage>(message)) continue;
    const std::vector<uint8_t> bytes = encode(message);
    const auto got = decode_server(samples::body_of(grown(samples::body_of(bytes))));
    ASSERT_TRUE(got) << got.error().message;
    EXPECT_EQ(encode(*got), bytes) << "message " << message.index();
  }
  for (const ClientMessage& message : samples::client_messages()) {
    if (std::holds_alternative<UnknownMessage>(message)) continue;
    const std::vector<uint8_t> bytes = encode(message);
    const auto got = decode_client(samples::body_of(grown(samples::body_of(bytes))));
    ASSERT_TRUE(got) << got.error().message;
    EXPECT_EQ(encode(*got), bytes) << "message " << message.index();
  }
}

TEST(Growth, an_empty_message_and_one_of_an_unknown_kind_are_unknown_and_no_error) {
  for (const std::vector<uint8_t>& body : {std::vector<uint8_t>(), std::vector<uint8_t>{0x7A, 0x00}}) {
    const auto of_client = decode_client(body);
    ASSERT_TRUE(of_client && std::holds_alternative<UnknownMessage>(*of_client));
    EXPECT_FALSE(std::get<UnknownMessage>(*of_client).request) << "it asks for nothing";
    const auto of_server = decode_server(body);
    ASSERT_TRUE(of_server && std::holds_alternative<UnknownMessage>(*of_server));
  }
}

TEST(Growth, an_unknown_kind_with_content_is_unknown_and_malformed_bytes_are_an_error) {
  const auto body = std::span(unknown_message).subspan(length_prefix_bytes);
  EXPECT_TRUE(std::holds_alternative<UnknownMessage>(*decode_client(body)));
  EXPECT_TRUE(std::holds_alternative<UnknownMessage>(*decode_server(body)));
  for (size_t length = 1; length < body.size(); ++length) {
    EXPECT_FALSE(decode_client(body.first(length))) << "cut to " << length;
    EXPECT_FALSE(decode_server(body.first(length))) << "cut to " << length;
  }
}

TEST(Growth, a_request_with_an_unknown_kind_keeps_its_number_and_names_the_kind) {
  const auto beyond = static_cast<Material>(materials_max);
  const PaintMessage paint{{sphere({1.0F, 2.0F, 3.0F}, 1.0F), beyond}, 8};
  const auto got = decode_client(samples::body_of(encode(ClientMessage(paint))));
  ASSERT_TRUE(got) << got.error().message;
  const auto& unknown = std::get<UnknownMessage>(*got);
  EXPECT_EQ(unknown.request, 8U);
  EXPECT_EQ(unknown.value, "material 255");
  CarveMessage broken;
  broken.impact_m.x = HUGE_VALF;
  EXPECT_FALSE(decode_client(samples::body_of(encode(ClientMessage(broken))))) << "that is a fault";
}

TEST(Growth, an_unknown_role_is_a_viewers_and_an_unknown_terrain_is_refused) {
  // Persons is field 30 of the envelope; a person, field 1, has the session in field 1 and the role in 3.
  const std::vector<uint8_t> person = {0xF2, 0x01, 0x06, 0x0A, 0x04, 0x08, 0x04, 0x18, 0x63};
  const auto persons = decode_server(person);
  ASSERT_TRUE(persons) << persons.error().message;
  EXPECT_EQ(std::get<PersonsMessage>(*persons).persons.at(0).role, Role::viewer);
  WelcomeMessage welcome;
  welcome.terrain = {static_cast<TerrainKind>(99), 1, 0.25F};
  const auto refused = decode_server(samples::body_of(encode(ServerMessage(welcome))));
  ASSERT_FALSE(refused);
  EXPECT_TRUE(holds(refused.error().message, "kind of terrain 99")) << refused.error().message;
}

TEST(Growth, marks_of_an_unknown_kind_of_event_are_left_out) {
  // Marks is field 45 of the envelope. Its field 4: kind 0 in column 3 twice, kind 77 in column 1 once.
  const std::vector<uint8_t> bytes = {0xEA, 0x02, 0x0C, 0x10, 0x01, 0x22, 0x08, 0x00,
                                      0x01, 0x03, 0x02, 0x4D, 0x01, 0x01, 0x01};
  const auto got = decode_server(bytes);
  ASSERT_TRUE(got) << got.error().message;
  const auto& marks = std::get<MarksMessage>(*got).marks;
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].kind, EventKind::carve);
  EXPECT_EQ(marks[0].count, 2U);
}

TEST(Growth, a_client_that_does_not_say_its_operations_knows_those_of_the_first_release) {
  HelloMessage hello;
  hello.operations = 0;
  const auto got = decode_client(samples::body_of(encode(ClientMessage(hello))));
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_EQ(std::get<HelloMessage>(*got).operations, operation_kinds_first);
}

TEST(Growth, peers_share_a_protocol_when_one_speaks_the_others) {
  EXPECT_TRUE(shares_protocol(protocol_version, 0));
  EXPECT_TRUE(shares_protocol(protocol_version + 1, protocol_version));
  EXPECT_TRUE(shares_protocol(protocol_version, 1));
  EXPECT_FALSE(shares_protocol(protocol_version + 1, 0));
  EXPECT_FALSE(shares_protocol(protocol_version - 1, 1));
  EXPECT_FALSE(shares_protocol(protocol_version + 2, protocol_version + 1));
  EXPECT_FALSE(shares_protocol(protocol_version - 1, protocol_version + 1)) << "no range";
}

}  // namespace
}  // namespace scree
