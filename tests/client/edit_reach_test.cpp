// The server's reach, as clients read it from a status.
#include "client/session/edit_reach.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(EditReach, is_the_servers_setting_for_all_but_administrators) {
  StatusMessage status;
  status.settings = {{"pieces-max", "2000"}, {"reach", "12.5"}, {"spawn", "auto"}};
  EXPECT_EQ(edit_reach_m(status, Role::builder), 12.5F);
  EXPECT_EQ(edit_reach_m(status, Role::carver), 12.5F);
  EXPECT_FALSE(edit_reach_m(status, Role::admin));
}

TEST(EditReach, is_unknown_where_the_server_does_not_say_it) {
  EXPECT_FALSE(edit_reach_m(std::nullopt, Role::builder));
  StatusMessage status;
  EXPECT_FALSE(edit_reach_m(status, Role::builder));
  status.settings = {{"reach", "anywhere"}};
  EXPECT_FALSE(edit_reach_m(status, Role::builder));
}

}  // namespace
}  // namespace scree
