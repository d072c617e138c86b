#include "shared/falling/load_flow.h"

#include <algorithm>
#include <numeric>

namespace scree {

uint32_t LoadFlow::add_node(int64_t load) {
  CHECK(load >= 0);
  nodes_.push_back({load});
  return static_cast<uint32_t>(nodes_.size() - 1);
}

void LoadFlow::ground(uint32_t node) {
  CHECK(node < nodes_.size());
  nodes_[node].grounded = true;
}

void LoadFlow::add_arc(uint32_t from, uint32_t to, int64_t room) {
  arcs_.push_back({to, nodes_[from].first, room});
  nodes_[from].first = static_cast<uint32_t>(arcs_.size() - 1);
}

void LoadFlow::link(uint32_t a, uint32_t b, int64_t forth, int64_t back) {
  CHECK(a != b && a < nodes_.size() && b < nodes_.size());
  CHECK(forth >= 0 && back >= 0);
  add_arc(a, b, forth);
  add_arc(b, a, back);
}

void LoadFlow::measure() {
  for (Node& node : nodes_) node.label = node.grounded ? 0 : unreachable();
  std::vector<uint32_t> ahead;
  for (uint32_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].grounded) ahead.push_back(i);
  for (size_t i = 0; i < ahead.size(); ++i) {
    const uint32_t label = nodes_[ahead[i]].label + 1;
    for (uint32_t arc = nodes_[ahead[i]].first; arc != none; arc = arcs_[arc].next) {
      Node& from = nodes_[arcs_[arc].to];
      if (arcs_[arc ^ 1U].room == 0 || from.label != unreachable()) continue;
      from.label = label;
      ahead.push_back(arcs_[arc].to);
    }
  }
}

void LoadFlow::activate(uint32_t node) {
  const Node& at = nodes_[node];
  if (at.grounded || at.label >= unreachable()) return;
  active_[at.label].push_back(node);
  highest_ = std::max(highest_, at.label);
}

/// No node has this label any more: the nodes above it cannot reach the ground.
void LoadFlow::close_gap(uint32_t label) {
  for (Node& node : nodes_) {
    if (node.label <= label || node.label >= unreachable()) continue;
    CHECK_DEBUG(with_label_[node.label] > 0);
    --with_label_[node.label];
    node.label = unreachable();
  }
}

void LoadFlow::relabel(uint32_t node, size_t& steps) {
  Node& at = nodes_[node];
  uint32_t label = unreachable();
  for (uint32_t arc = at.first; arc != none; arc = arcs_[arc].next) {
    if (steps > 0) --steps;
    if (arcs_[arc].room > 0) label = std::min(label, nodes_[arcs_[arc].to].label + 1);
  }
  const uint32_t left = at.label;
  --with_label_[left];
  at.label = std::min(label, unreachable());
  CHECK_DEBUG(at.label > left);  // labels only grow, which bounds the number of relabels
  at.at = at.first;
  if (at.label < unreachable()) ++with_label_[at.label];
  if (with_label_[left] == 0) close_gap(left);
}

void LoadFlow::discharge(uint32_t node, size_t& steps) {
  Node& at = nodes_[node];
  while (at.load > 0 && at.label < unreachable() && steps > 0) {
    if (at.at == none) {
      relabel(node, steps);
      continue;
    }
    --steps;
    Arc& arc = arcs_[at.at];
    Node& to = nodes_[arc.to];
    if (arc.room == 0 || at.label != to.label + 1) {
      at.at = arc.next;
      continue;
    }
    const int64_t passed = std::min(at.load, arc.room);
    CHECK_DEBUG(passed > 0);
    const bool was_idle = to.load == 0;
    arc.room -= passed;
    arcs_[at.at ^ 1U].room += passed;
    at.load -= passed;
    to.load += passed;
    if (was_idle) activate(arc.to);
  }
}

int64_t LoadFlow::total_load() const {
  return std::accumulate(nodes_.begin(), nodes_.end(), int64_t{0},
                         [](int64_t sum, const Node& node) { return sum + node.load; });
}

int64_t LoadFlow::left() const {
  int64_t left = 0;
  for (const Node& node : nodes_)
    if (!node.grounded) left += node.load;
  return left;
}

/// All that load which is left could still flow to: such a set holds all of it, and nothing more fits out.
std::vector<bool> LoadFlow::smallest_overloaded() const {
  CHECK_EQ(held_.size(), nodes_.size());
  std::vector<bool> inside(nodes_.size(), false);
  std::vector<uint32_t> ahead;
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].grounded || nodes_[i].load == 0) continue;
    inside[i] = true;
    ahead.push_back(i);
  }
  while (!ahead.empty()) {
    const uint32_t node = ahead.back();
    ahead.pop_back();
    for (uint32_t arc = nodes_[node].first; arc != none; arc = arcs_[arc].next) {
      const uint32_t to = arcs_[arc].to;
      if (arcs_[arc].room == 0 || inside[to]) continue;
      inside[to] = true;
      ahead.push_back(to);
    }
  }
  return inside;
}

bool LoadFlow::run(size_t steps) {
  const int64_t total = total_load();
  active_.assign(unreachable() + 1, {});
  with_label_.assign(unreachable() + 1, 0);
  measure();
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    ++with_label_[nodes_[i].label];
    nodes_[i].at = nodes_[i].first;
    if (nodes_[i].load > 0) activate(i);
  }
  while (steps > 0) {
    while (highest_ > 0 && active_[highest_].empty()) --highest_;
    if (active_[highest_].empty()) break;
    const uint32_t node = active_[highest_].back();
    active_[highest_].pop_back();
    // A gap may have lifted it meanwhile; then it is overloaded.
    if (nodes_[node].label == highest_) discharge(node, steps);
  }
  CHECK_EQ(total_load(), total);
  if (steps == 0) return false;
  measure();
  held_.resize(nodes_.size());
  for (size_t i = 0; i < nodes_.size(); ++i) held_[i] = nodes_[i].label < unreachable();
  return true;
}

}  // namespace scree
