// Which machine figures are of.
#pragma once

#include <string>

namespace scree {

struct Machine {
  std::string processor{};
  unsigned threads = 0;  ///< that this process may use
  double memory_gib = 0.0;
  std::string compiler{};
  std::string system{};  ///< kernel's name and release
};

Machine this_machine();

/// Cores that the calling thread may use; at least one.
unsigned usable_cores();

/// Short, fit for a file's name, the same for equal machines: "intel-xeon-platinum-8375c-2".
std::string slug_of(const Machine& machine);

}  // namespace scree
