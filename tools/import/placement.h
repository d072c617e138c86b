// Where a solid of a file is put in the world: its coordinates times the scale, turned if its z points up,
// then moved. Metres.
#pragma once

#include <array>

namespace scree {

struct Placement {
  double scale = 1.0;
  bool z_up = false;
  std::array<double, 3> at_m{};

  bool is_identity() const { return scale == 1.0 && !z_up && at_m == std::array<double, 3>{}; }
};

}  // namespace scree
