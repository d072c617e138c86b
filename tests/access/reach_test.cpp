// How far from its eye a session may edit: each role, each way to tell an eye, and a limit that changes.
#include <gtest/gtest.h>

#include "tests/support/access_fixture.h"
#include "tests/support/holds.h"

namespace scree {
namespace {

class ReachTest : public AccessTest {
 protected:
  /// The reply's name; empty when the world got the request instead.
  std::string asked(RawClient& client, const ClientMessage& request) {
    commands.drain();
    EXPECT_TRUE(client.send(request));
    // An answer follows all requests before it.
    EXPECT_TRUE(client.send(AdminMessage{marker, the_admin_token, ListBansRequest{}}));
    std::string name;
    while (const auto message = client.receive()) {
      if (const auto* reply = std::get_if<ReplyMessage>(&*message); reply && reply->request != marker) {
        name = reply->refusal_name;
        words = reply->refusal;
      }
      if (std::holds_alternative<AdminListMessage>(*message)) break;
    }
    EXPECT_EQ(commands.drain().size(), name.empty() ? 1U : 0U);
    return name;
  }
  static CarveMessage carve_at(glm::vec3 centre_m, float radius_m = 1.0F) {
    return {{.shape = sphere(centre_m, radius_m), .impact_m = centre_m}, 7};
  }

  static constexpr uint32_t marker = 99;
  std::string words;  ///< of the last refusal
};

TEST_F(ReachTest, carvers_and_builders_edit_near_their_eye_and_administrators_anywhere) {
  start();
  const Shape far = sphere({4000.0F, 0.0F, 0.0F}, 1.0F);
  const auto carver = join(token(Role::carver), Role::carver);
  EXPECT_EQ(asked(*carver, carve_at({0.0F, 0.0F, 60.0F})), "");
  EXPECT_EQ(asked(*carver, CarveMessage{{.shape = far}, 1}), "reach");
  EXPECT_TRUE(holds(words, "64 m (reach)")) << words;
  const auto builder = join(token(Role::builder), Role::builder);
  EXPECT_EQ(asked(*builder, FillMessage{{far}, 2}), "reach");
  EXPECT_EQ(asked(*builder, PaintMessage{{far, material::ice}, 3}), "reach");
  EXPECT_EQ(asked(*builder, FillMessage{{sphere({0.0F, 0.0F, 60.0F}, 1.0F)}, 4}), "");
  const auto administrator = join(the_admin_token, Role::admin);
  EXPECT_EQ(asked(*administrator, CarveMessage{{.shape = far}, 5}), "");
}

TEST_F(ReachTest, it_goes_to_the_nearest_point_of_the_edit) {
  start();
  const auto carver = join(token(Role::carver), Role::carver);
  EXPECT_EQ(asked(*carver, carve_at({70.0F, 0.0F, 0.0F}, 7.0F)), "") << "63 m";
  EXPECT_EQ(asked(*carver, carve_at({72.0F, 0.0F, 0.0F}, 7.0F)), "reach") << "65 m";
}

TEST_F(ReachTest, the_eye_is_the_one_that_was_told_last) {
  start();
  const auto carver = join(token(Role::carver), Role::carver);
  const CarveMessage far = carve_at({4000.0F, 0.0F, 0.0F}), near = carve_at({0.0F, 0.0F, 0.0F});
  ASSERT_TRUE(carver->send(InterestMessage{{3990.0F, 0.0F, 0.0F}, 32.0F}));
  EXPECT_EQ(asked(*carver, far), "");
  EXPECT_EQ(asked(*carver, near), "reach");
  ASSERT_TRUE(carver->send(CursorMessage{{1.0F, 2.0F, 3.0F}, {0.0F, 0.0F, 0.0F}}));
  EXPECT_EQ(asked(*carver, near), "");
  EXPECT_EQ(asked(*carver, far), "reach");
  HelloMessage there = hello(token(Role::carver));
  there.eye_m = {4000.0F, 0.0F, 0.0F};
  RawClient other(server->port());
  ASSERT_TRUE(other.send(there));
  ASSERT_TRUE(other.receive_as<WelcomeMessage>());
  EXPECT_EQ(asked(other, far), "");
}

TEST_F(ReachTest, who_never_told_an_eye_is_at_the_origin) {
  start();
  RawClient silent(server->port());
  HelloMessage nowhere = hello(token(Role::carver));
  nowhere.eye_m = {};
  ASSERT_TRUE(silent.send(nowhere));
  ASSERT_TRUE(silent.receive_as<WelcomeMessage>());
  EXPECT_EQ(asked(silent, carve_at({30.0F, 0.0F, 0.0F})), "");
  EXPECT_EQ(asked(silent, carve_at({300.0F, 0.0F, 0.0F})), "reach");
}

TEST_F(ReachTest, a_server_says_how_far) {
  config.service.reach_m = 10.0;
  start();
  const auto carver = join(token(Role::carver), Role::carver);
  EXPECT_EQ(asked(*carver, carve_at({20.0F, 0.0F, 0.0F})), "reach");
  EXPECT_TRUE(holds(words, "10 m (reach)")) << words;
}

}  // namespace
}  // namespace scree
