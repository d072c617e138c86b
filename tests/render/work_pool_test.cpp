// Jobs of drawing where a program has no threads.
#include "client/render/scene/work_pool.h"

#include <gtest/gtest.h>
#include <vector>

namespace scree {
namespace {

TEST(WorkPool, without_threads_its_owner_runs_the_jobs_urgent_ones_first) {
  WorkPool pool(0);
  std::vector<int> done;
  for (int i = 0; i < 3; ++i) pool.submit(WorkPool::Urgency::load, [&, i] { done.push_back(i); });
  pool.submit(WorkPool::Urgency::edit, [&] { done.push_back(9); });
  EXPECT_TRUE(done.empty());
  EXPECT_TRUE(pool.run_for(0.0));
  EXPECT_TRUE(done.empty());
  EXPECT_TRUE(pool.run_for(1e-9));
  EXPECT_EQ(done, std::vector{9}) << "one job at least, and no more than there is time for";
  EXPECT_FALSE(pool.run_for(60.0));
  EXPECT_EQ(done, (std::vector{9, 0, 1, 2}));
  pool.run_for(60.0);
  EXPECT_EQ(done.size(), 4U);
}

TEST(WorkPool, without_threads_what_waits_at_the_end_is_dropped) {
  bool ran = false;
  WorkPool(0).submit(WorkPool::Urgency::edit, [&] { ran = true; });
  EXPECT_FALSE(ran);
}

}  // namespace
}  // namespace scree
