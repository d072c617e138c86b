#include "client/render/scene/material_texels.h"

#include <algorithm>
#include <array>

#include "client/render/scene/limits.h"
#include "shared/base/check.h"

namespace scree {
namespace {

/// The pixels that a texel covers along an axis: one at least.
struct Covered {
  int lo, hi;
};
Covered covered(int texel, int pixels) {
  const auto at = [&](int i) { return static_cast<int>(int64_t{i} * pixels / limits::material_image_side); };
  return {at(texel), std::max(at(texel + 1), at(texel) + 1)};
}

}  // namespace

MaterialTexels resampled(std::span<const uint8_t> rgb, int width, int height) {
  CHECK(width > 0 && height > 0);
  CHECK(rgb.size() == static_cast<size_t>(width) * static_cast<size_t>(height) * 3);
  constexpr int side = limits::material_image_side;
  MaterialTexels texels;
  texels.reserve(size_t{side} * side * 4);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const Covered rows = covered(y, height), columns = covered(x, width);
      std::array<uint64_t, 3> sum{};
      for (int row = rows.lo; row < rows.hi; ++row) {
        const uint8_t* pixel =
            &rgb[(static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(columns.lo)) *
                 3];
        for (int i = 0; i < 3 * (columns.hi - columns.lo); ++i) sum[static_cast<size_t>(i % 3)] += pixel[i];
      }
      const auto count = static_cast<uint64_t>((rows.hi - rows.lo) * (columns.hi - columns.lo));
      for (const uint64_t part : sum) texels.push_back(static_cast<uint8_t>((part + count / 2) / count));
      texels.push_back(255);
    }
  return texels;
}

}  // namespace scree
