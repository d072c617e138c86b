// A client at a door, of a simulating server or of an edge, who carves once.
#pragma once

#include <gtest/gtest.h>
#include <string>
#include <variant>

#include "tests/bus/told_fixture.h"
#include "tests/support/raw_client.h"

namespace scree {

/// The n-th carve of a storm, as a client asks for it.
inline CarveMessage told_carve_message(uint32_t n) {
  CarveMessage message;
  static_cast<CarveRequest&>(message) = std::get<CarveRequest>(told_carve(n).body);
  message.request = n;
  return message;
}

/// Joins there and carves; `said` is for who reads a failure. The reply accepts.
inline void expect_carve_accepted(uint16_t port, const std::string& said) {
  RawClient client(port);
  ASSERT_TRUE(client.send(HelloMessage{protocol_version, "test", {0.0F, 2.0F, 0.0F}, 64.0F})) << said;
  ASSERT_TRUE(client.receive_as<WelcomeMessage>(patience)) << said;
  ASSERT_TRUE(client.send(told_carve_message(1))) << said;
  const auto reply = client.receive_as<ReplyMessage>(patience);
  ASSERT_TRUE(reply) << said;
  EXPECT_EQ(reply->refusal, "") << said;
}

}  // namespace scree
