#include "client/render/levels/air_distances.h"

#include <algorithm>
#include <array>

namespace scree {
namespace {

struct Near {
  VoxelCoord off;
  int way;  ///< codes, rounded down: a step may be short, but not long
};

/// Half of a sample's 26 neighbours; the other half lies opposite. The first twelve lie in rows before its
/// own.
constexpr std::array<Near, 13> nearby{{{{-1, -1, -1}, 73},
                                       {{-1, -1, 0}, 59},
                                       {{-1, -1, 1}, 73},
                                       {{-1, 0, -1}, 59},
                                       {{-1, 0, 0}, 42},
                                       {{-1, 0, 1}, 59},
                                       {{-1, 1, -1}, 73},
                                       {{-1, 1, 0}, 59},
                                       {{-1, 1, 1}, 73},
                                       {{0, -1, -1}, 59},
                                       {{0, -1, 0}, 42},
                                       {{0, -1, 1}, 59},
                                       {{0, 0, -1}, 42}}};

/// One pass of a chamfer distance (Borgefors 1986), from the first sample on or from the last.
void pass(Window& window, int sign) {
  const VoxelCoord size = window.box.size();
  const auto step = [sign](int i, int count) { return sign > 0 ? i : count - 1 - i; };
  const auto inside = [](int v, int count) { return v >= 0 && v < count; };
  for (int i = 0; i < size.x; ++i)
    for (int j = 0; j < size.y; ++j) {
      const int x = step(i, size.x), y = step(j, size.y);
      Code* row = window.codes.data() + (x * size.y + y) * size.z;
      for (const Near& near : nearby) {
        const int from_x = x + sign * near.off.x, from_y = y + sign * near.off.y, by = sign * near.off.z;
        if (!inside(from_x, size.x) || !inside(from_y, size.y)) continue;
        const Code* from = window.codes.data() + (from_x * size.y + from_y) * size.z;
        for (int k = 0; k < size.z; ++k) {
          const int z = step(k, size.z);
          if (row[z] < 0 || !inside(z + by, size.z)) continue;
          // What is not negative stays so: no air becomes rock.
          const int most = std::max(from[z + by] + near.way, 0);
          if (most < row[z]) row[z] = static_cast<Code>(most);
        }
      }
    }
}

}  // namespace

void lower_air(Window& window) {
  pass(window, 1);
  pass(window, -1);
}

}  // namespace scree
