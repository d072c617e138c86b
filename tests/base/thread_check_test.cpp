// ThreadCheck: the first caller's thread is the only one that passes, until it lets go.
#include "shared/base/thread_check.h"

#include <gtest/gtest.h>
#include <thread>

namespace scree {
namespace {

bool passes_on_another_thread(ThreadCheck& check) {
  bool passes = false;
  std::thread([&] { passes = check.is_the_same(); }).join();
  return passes;
}

TEST(ThreadCheck, only_the_thread_of_the_first_call_passes) {
  ThreadCheck check;
  EXPECT_TRUE(check.is_the_same());
  EXPECT_FALSE(passes_on_another_thread(check));
  EXPECT_TRUE(check.is_the_same()) << "a refused caller does not take over";
}

TEST(ThreadCheck, the_thread_that_makes_the_object_need_not_use_it) {
  ThreadCheck check;
  std::thread user([&] { EXPECT_TRUE(check.is_the_same()); });
  user.join();
  EXPECT_FALSE(check.is_the_same());
}

TEST(ThreadCheck, the_owner_lets_go_and_the_next_caller_owns) {
  ThreadCheck check;
  EXPECT_TRUE(check.is_the_same());
  std::thread([&] { EXPECT_FALSE(check.release()) << "it is not this thread's"; }).join();
  EXPECT_FALSE(passes_on_another_thread(check));
  EXPECT_TRUE(check.release());
  EXPECT_TRUE(passes_on_another_thread(check));
  EXPECT_FALSE(check.is_the_same()) << "that thread owns it now";
}

TEST(ThreadCheck, who_owns_nothing_lets_go_of_nothing) {
  ThreadCheck check;
  EXPECT_TRUE(check.release());
  EXPECT_TRUE(check.release());
}

}  // namespace
}  // namespace scree
