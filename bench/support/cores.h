// Which of this machine's cores threads run on.
#pragma once

#include <memory>

namespace scree {

/// Lets the calling thread, and threads and processes that it starts, run on some of the cores that it may
/// use: the first `count`, or all but those; until this ends. Where no other is left, or the system refuses:
/// all; usable_cores() (bench/support/machine.h) says how many.
class OnCores {
 public:
  enum class Which { first, others };
  OnCores(unsigned count, Which which);
  ~OnCores();
  OnCores(const OnCores&) = delete;
  OnCores& operator=(const OnCores&) = delete;

 private:
  struct Saved;
  std::unique_ptr<Saved> saved_;
};

}  // namespace scree
