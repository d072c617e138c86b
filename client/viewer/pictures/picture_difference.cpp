#include "client/viewer/pictures/picture_difference.h"

#include <cmath>

namespace scree {

Result<double> picture_difference(const Image& a, const Image& b) {
  const auto size_of = [](const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
  };
  if (a.width != b.width || a.height != b.height)
    return fail("a picture of " + size_of(a) + " pixels cannot be compared with one of " + size_of(b));
  uint64_t sum = 0;
  for (size_t i = 0; i < a.rgb.size(); ++i) {
    const int difference = int{a.rgb[i]} - int{b.rgb[i]};
    sum += static_cast<uint64_t>(difference * difference);
  }
  return std::sqrt(static_cast<double>(sum) / static_cast<double>(a.rgb.size())) / 255.0;
}

}  // namespace scree
