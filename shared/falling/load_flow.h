// The load in a network of supports that reaches the ground: nodes with a load each, links with a capacity
// each way, and nodes that stand on the ground. Where the capacities are too small, the overloaded nodes are
// those beyond the least cut (max-flow and min-cut, Ford and Fulkerson 1956). Their load is more than their
// links to the rest can carry, and no other set of nodes has a larger excess.
//
// Push-relabel (Goldberg and Tarjan 1988), highest label first, starting from the true distances to the
// ground: a load that can flow straight down takes one push a link. Integers, so exact. Invariant: loads are
// moved, never made or lost. Deterministic. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shared/base/check.h"

namespace scree {

class LoadFlow {
 public:
  /// Returns the node's index, from 0 up. The load must not be negative.
  uint32_t add_node(int64_t load);
  /// The node stands on the ground: it takes any load.
  void ground(uint32_t node);
  /// Links two nodes; capacities from `a` to `b` and back, not negative.
  void link(uint32_t a, uint32_t b, int64_t forth, int64_t back);

  /// Computes the flow. False when `steps` did not suffice: then nothing is known. A step is a look at one
  /// link.
  bool run(size_t steps);
  /// After run() returned true: whether a part of the load on the node cannot reach the ground.
  bool overloaded(uint32_t node) const {
    CHECK(node < held_.size());
    return !held_[node];
  }
  /// After run() returned true: the part of all load that cannot reach the ground.
  int64_t left() const;
  /// After run() returned true: of all sets of nodes whose load is so much more than their links to the rest
  /// can carry, the smallest; by node. Where the same load passes several sections that are equally weak, it
  /// ends at the one nearest to the load.
  std::vector<bool> smallest_overloaded() const;

 private:
  static constexpr uint32_t none = UINT32_MAX;
  struct Node {
    int64_t load = 0;  ///< not passed on yet
    uint32_t label = 0;
    uint32_t first = none;  ///< of its arcs
    uint32_t at = none;     ///< arc at which to go on
    bool grounded = false;
  };
  /// The index of its reverse differs in the last bit.
  struct Arc {
    uint32_t to = 0;
    uint32_t next = none;
    int64_t room = 0;
  };

  int64_t total_load() const;
  uint32_t unreachable() const { return static_cast<uint32_t>(nodes_.size()) + 1; }
  void add_arc(uint32_t from, uint32_t to, int64_t room);
  /// Labels become the distances to the ground, over arcs with room.
  void measure();
  void activate(uint32_t node);
  void discharge(uint32_t node, size_t& steps);
  void relabel(uint32_t node, size_t& steps);
  void close_gap(uint32_t label);

  std::vector<Node> nodes_;
  std::vector<Arc> arcs_;
  std::vector<std::vector<uint32_t>> active_;  ///< by label: nodes with load to pass on
  std::vector<uint32_t> with_label_;           ///< how many nodes have it
  uint32_t highest_ = 0;
  std::vector<bool> held_;
};

}  // namespace scree
