// Who is in the world, and what they said, as far as it is still told. Time is an argument (seconds).
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "proto/talk.h"

namespace scree {

class Conversation {
 public:
  /// With another server, or again: nobody is known yet.
  void begin() { persons_ = {}; }
  void apply(const PersonsMessage& persons) { persons_ = persons; }
  void apply(const SaidMessage& said, double now_s);

  const PersonsMessage& persons() const { return persons_; }
  /// The lines of the last seconds, oldest first, "Ann: mind the edge"; with `all`, the last few however old.
  std::vector<std::string> lines(double now_s, bool all) const;

 private:
  struct Line {
    std::string text;
    double at_s = 0.0;
  };

  PersonsMessage persons_;
  std::deque<Line> lines_;
};

}  // namespace scree
