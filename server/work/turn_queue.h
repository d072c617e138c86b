// Work that waits, of several who take turns (fair_turns.h): each one's in the order in which it came. So
// work of one delays that of another by a turn, however much of it there is. Part of the simulation:
// deterministic, no clock. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "server/work/fair_turns.h"
#include "shared/base/check.h"

namespace scree {

/// `Item` has a member cost_us: microseconds that its next turn will cost, not negative; 0 where that is not
/// known before.
template <typename Item>
class TurnQueue {
 public:
  /// What waits for one of them; never empty.
  struct Line {
    std::deque<Item> items;
    float waiting_us = 0.0F;  ///< sum of their costs
  };

  void push(uint64_t who, Item item) {
    Line& line = lines_[who];
    if (line.items.empty()) turns_.wait(who, in_ns(item.cost_us));
    line.waiting_us += item.cost_us;
    line.items.push_back(std::move(item));
    ++size_;
  }

  /// Whether nothing waits but that of those who were passed over.
  bool empty() const { return turns_.empty(); }
  /// Whose turn it is, and the first that waits for him. Must not be empty().
  uint64_t whose() const { return turns_.next(); }
  const Item& next() const { return lines_.at(whose()).items.front(); }
  Item& next() { return lines_.at(whose()).items.front(); }

  /// Removes the next one, and charges him whose it was.
  Item pop(float charged_us) {
    const auto line = lines_.find(whose());
    CHECK(line != lines_.end() && charged_us >= 0.0F);
    Item item = std::move(line->second.items.front());
    line->second.items.pop_front();
    line->second.waiting_us -= item.cost_us;
    --size_;
    const bool more = !line->second.items.empty();
    turns_.charge(in_ns(charged_us), more ? FairTurns::Then::waits : FairTurns::Then::leaves);
    if (more) turns_.expect(line->first, in_ns(line->second.items.front().cost_us));
    if (!more) lines_.erase(line);  // no rounding of waiting_us is carried over
    return item;
  }
  /// Charges him whose turn it is; the same item waits for its next turn.
  void go_on(float charged_us, float cost_us) {
    CHECK(charged_us >= 0.0F);
    const uint64_t who = whose();
    Line& line = lines_.at(who);
    line.waiting_us += cost_us - line.items.front().cost_us;
    line.items.front().cost_us = cost_us;
    turns_.charge(in_ns(charged_us), FairTurns::Then::waits);
    turns_.expect(who, in_ns(cost_us));
  }
  /// Leaves him whose turn it is out until bring_back() or begin_tick().
  void pass_over() { turns_.pass_over(); }
  void bring_back() { turns_.bring_back(); }
  void begin_tick() {
    turns_.bring_back();
    turns_.forget_the_idle();
  }

  /// Removes what waits for one of them, and returns it in order. It costs nothing.
  std::deque<Item> drop(uint64_t who) {
    bring_back();
    const auto line = lines_.find(who);
    if (line == lines_.end()) return {};
    std::deque<Item> dropped = std::move(line->second.items);
    size_ -= dropped.size();
    turns_.leave(who);
    lines_.erase(line);
    return dropped;
  }
  /// Removes what `is_gone` says, which gets each item that waits. It costs nothing.
  template <typename IsGone>
  void erase_if(const IsGone& is_gone) {
    bring_back();
    for (auto line = lines_.begin(); line != lines_.end();) {
      auto& [who, waiting] = *line;
      for (const Item& item : waiting.items)
        if (is_gone(item)) waiting.waiting_us -= item.cost_us;
      size_ -= std::erase_if(waiting.items, is_gone);
      if (!waiting.items.empty()) {
        turns_.expect(who, in_ns(waiting.items.front().cost_us));
        ++line;
      } else {
        turns_.leave(who);
        line = lines_.erase(line);
      }
    }
  }
  /// Removes all. What each was charged stands.
  void clear() {
    bring_back();
    for (const auto& [who, line] : lines_) turns_.leave(who);
    lines_.clear();
    size_ = 0;
  }

  /// Number of items that wait, in all.
  size_t size() const { return size_; }
  /// What waits, by whose it is.
  const std::map<uint64_t, Line>& lines() const { return lines_; }
  std::map<uint64_t, Line>& lines() { return lines_; }
  bool waits(uint64_t who) const { return lines_.contains(who); }
  /// Whether something waits for another one than this.
  bool others_wait(uint64_t who) const { return lines_.size() > (waits(who) ? 1U : 0U); }

  TurnsValue turns() const { return turns_.value(); }
  /// Goes on with these turns, by which those wait for whom something does.
  void restore_turns(const TurnsValue& value) {
    turns_.restore(value, [this](uint64_t who) { return in_ns(lines_.at(who).items.front().cost_us); });
  }

 private:
  std::map<uint64_t, Line> lines_;
  FairTurns turns_;
  size_t size_ = 0;
};

}  // namespace scree
