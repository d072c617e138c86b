// The flow of loads, against all cuts of small networks.
#include "shared/falling/load_flow.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "shared/base/random.h"

namespace scree {
namespace {

struct Network {
  struct Link {
    uint32_t a, b;
    int64_t forth, back;
  };
  std::vector<int64_t> loads;
  std::vector<Link> links;
  uint32_t grounded = 0;  ///< bits

  explicit Network(uint64_t random_seed) {
    Random random(random_seed);
    const auto below = [&](uint32_t n) {
      return static_cast<uint32_t>(random.unit() * static_cast<float>(n));
    };
    const uint32_t nodes = 2 + below(8);
    for (uint32_t i = 0; i < nodes; ++i) loads.push_back(below(20));
    grounded = 1U << below(nodes);
    for (uint32_t i = 0; i < 2 * nodes; ++i) {
      const uint32_t a = below(nodes), b = below(nodes);
      if (a != b) links.push_back({a, b, below(30), below(30)});
    }
  }

  static bool holds(uint32_t set, uint32_t node) { return (set >> node & 1U) != 0; }
  /// Load of a set of nodes over what the links out of it carry. Link by link and in two branches: g++ 12
  /// miscompiles `a ? forth : back` here at -O1 with -fsanitize=thread.
  int64_t excess(uint32_t set) const {
    int64_t sum = 0;
    for (uint32_t i = 0; i < loads.size(); ++i)
      if (holds(set, i)) sum += loads[i];
    for (const Link& link : links) {
      if (holds(set, link.a) && !holds(set, link.b)) sum -= link.forth;
      if (holds(set, link.b) && !holds(set, link.a)) sum -= link.back;
    }
    return sum;
  }
  int64_t most_excess() const {
    int64_t most = 0;
    for (uint32_t set = 0; set < 1U << loads.size(); ++set)
      if ((set & grounded) == 0) most = std::max(most, excess(set));
    return most;
  }
};

TEST(support, the_flow_of_loads_finds_the_most_overloaded_of_all_sets) {
  int overloaded = 0;
  for (uint64_t random_seed = 0; random_seed < 500; ++random_seed) {
    const Network network(random_seed);
    LoadFlow flow;
    for (const int64_t load : network.loads) flow.add_node(load);
    for (uint32_t i = 0; i < network.loads.size(); ++i)
      if ((network.grounded >> i & 1U) != 0) flow.ground(i);
    for (const auto& link : network.links) flow.link(link.a, link.b, link.forth, link.back);
    ASSERT_TRUE(flow.run(1'000'000)) << random_seed;
    uint32_t set = 0;
    for (uint32_t i = 0; i < network.loads.size(); ++i) set |= flow.overloaded(i) ? 1U << i : 0U;
    ASSERT_EQ(set & network.grounded, 0U) << random_seed;
    ASSERT_EQ(network.excess(set), network.most_excess()) << random_seed;
    overloaded += network.most_excess() > 0 ? 1 : 0;
  }
  EXPECT_GT(overloaded, 50);
  EXPECT_LT(overloaded, 450);
}

TEST(support, a_flow_without_steps_knows_nothing) {
  LoadFlow flow;
  const uint32_t top = flow.add_node(5), foot = flow.add_node(0);
  flow.link(top, foot, 10, 10);
  flow.ground(foot);
  EXPECT_FALSE(flow.run(0));
}

}  // namespace
}  // namespace scree
