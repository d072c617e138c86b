// What directors may ask of an administrator's requests.
#include <gtest/gtest.h>

#include "tests/support/access_fixture.h"

namespace scree {
namespace {

using DirectorTest = AccessTest;

TEST_F(DirectorTest, directors_list_bodies_and_joints_and_nothing_else) {
  start();
  const auto director = join(token(Role::director), Role::director);
  ASSERT_TRUE(director->send(AdminMessage{5, "", ListBodiesRequest{}}));
  const auto bodies = director->receive_as<AdminListMessage>();
  ASSERT_TRUE(bodies);
  EXPECT_EQ(bodies->request, 5U);
  ASSERT_TRUE(director->send(AdminMessage{6, "", ListJointsRequest{}}));
  EXPECT_TRUE(director->receive_as<AdminListMessage>());
  ASSERT_TRUE(director->send(AdminMessage{7, "", ListSessionsRequest{}}));
  const auto refused = director->receive_as<ReplyMessage>();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->refusal_name, "role");
  const auto builder = join(token(Role::builder, 8), Role::builder);
  ASSERT_TRUE(builder->send(AdminMessage{5, "", ListBodiesRequest{}}));
  const auto told = builder->receive_as<ReplyMessage>();
  ASSERT_TRUE(told);
  EXPECT_EQ(told->refusal_name, "role");
}

}  // namespace
}  // namespace scree
