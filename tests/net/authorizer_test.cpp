// What a client may do: by tokens, bans, and the machine that it comes from.
#include "server/doors/authorizer.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

constexpr uint64_t today_s = 2'000'000'000;

class AuthorizerTest : public ::testing::Test {
 protected:
  void open(const std::string& admin_token) {
    authorizer.emplace(config, admin_token, door);
    ASSERT_TRUE(authorizer->open());
  }
  auto grant(const Caller& caller, const std::string& token, double now_s = 10.0) {
    return authorizer->grant_to(caller, token, "Ann", now_s, today_s);
  }

  AccessConfig config;
  Door door{Door::Rules{}};
  std::optional<Authorizer> authorizer;
  const Caller far{"10.0.0.1", "10.0.0.1"};
  const Caller here{door_address("127.0.0.1"), "127.0.0.1"};
};

TEST_F(AuthorizerTest, without_a_token_a_client_is_what_the_server_says_under_its_own_name) {
  open("the-admin-token");
  const auto granted = grant(far, "");
  ASSERT_TRUE(granted);
  EXPECT_EQ(granted->role, Role::builder);
  EXPECT_EQ(granted->name, "Ann");
}

TEST_F(AuthorizerTest, the_admin_token_makes_an_administrator_and_a_wrong_one_costs_a_wait) {
  open("the-admin-token");
  EXPECT_EQ(grant(far, "the-admin-token")->role, Role::admin);
  EXPECT_EQ(grant(far, "a-wrong-token").error().reason, Refusal::admin_token_wrong);
  EXPECT_EQ(grant(far, "the-admin-token").error().reason, Refusal::token_guesses);
  EXPECT_EQ(grant(far, "a-wrong-token").error().reason, Refusal::admin_token_wrong) << "it is known as wrong";
  EXPECT_TRUE(grant(here, "the-admin-token")) << "another address waits for nothing";
  EXPECT_TRUE(grant(far, "the-admin-token", 10.0 + limits::guess_wait_min_s));
}

TEST_F(AuthorizerTest, a_server_with_tls_alone_refuses_a_client_without_it) {
  open("");
  config.tls_required = true;
  EXPECT_EQ(grant(far, "").error().reason, Refusal::tls_required);
  EXPECT_TRUE(grant({far.address, far.ip, true, false}, ""));
}

TEST_F(AuthorizerTest, a_ban_holds_for_its_address_and_time_and_for_no_administrator) {
  open("the-admin-token");
  ASSERT_TRUE(authorizer->bans().add(*ban_key(far.ip), {today_s + 1, "shouting"}, today_s));
  const auto refused = grant(far, "");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().reason, Refusal::banned);
  EXPECT_EQ(refused.error().message, "this address is banned from the server: shouting");
  EXPECT_TRUE(grant({"10.0.0.2", "10.0.0.2"}, ""));
  EXPECT_TRUE(grant(far, "the-admin-token"));
  EXPECT_TRUE(authorizer->grant_to(far, "", "Ann", 10.0, today_s + 2));
}

TEST_F(AuthorizerTest, where_nobody_can_administer_this_machine_controls_a_replay_and_nothing_else) {
  open("");
  EXPECT_TRUE(authorizer->may_administer(Role::viewer, here, true));
  Caller proxied = here;
  proxied.relayed = true;
  for (const Caller& caller : {far, proxied})
    EXPECT_EQ(authorizer->may_administer(Role::viewer, caller, true).error().reason, Refusal::no_admin_token);
  EXPECT_EQ(authorizer->may_administer(Role::viewer, here, false).error().reason, Refusal::no_admin_token);
  open("the-admin-token");
  EXPECT_EQ(authorizer->may_administer(Role::builder, here, true).error().reason, Refusal::role);
  EXPECT_TRUE(authorizer->may_administer(Role::admin, far, false));
}

}  // namespace
}  // namespace scree
