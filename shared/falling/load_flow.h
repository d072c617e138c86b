// How much of the load in a network of supports reaches the ground: nodes with a load each, links that carry
// so much each way, and nodes that stand on the ground. Where not all of it does, the overloaded nodes are
// those beyond the least cut: whatever they weigh, the links around them cannot carry it, and no other set
// of nodes has more load over what its links carry (max-flow and min-cut, Ford and Fulkerson 1956).
//
// Push-relabel (Goldberg and Tarjan 1988), highest label first, from the true distances to the ground: loads
// that find their way straight down take one push a link. Integers, so exact. Deterministic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scree {

class LoadFlow {
 public:
  uint32_t add_node(int64_t load);
  /// Stands on the ground: takes any load.
  void ground(uint32_t node);
  /// What may flow from `a` to `b`, and back. Not negative.
  void link(uint32_t a, uint32_t b, int64_t forth, int64_t back);

  /// False when `steps` were not enough: then nothing is known. A step is a look at one link.
  bool run(size_t steps);
  /// After run(): whether its load, or that of those leaning on it, does not all reach the ground.
  bool overloaded(uint32_t node) const { return !held_[node]; }

 private:
  static constexpr uint32_t none = UINT32_MAX;
  struct Node {
    int64_t load = 0;  ///< not passed on yet
    uint32_t label = 0;
    uint32_t first = none;  ///< of its arcs
    uint32_t at = none;     ///< arc at which to go on
    bool grounded = false;
  };
  /// Its reverse is the one with the other last bit.
  struct Arc {
    uint32_t to = 0;
    uint32_t next = none;
    int64_t room = 0;
  };

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
