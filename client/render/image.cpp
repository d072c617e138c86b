#include "client/render/image.h"

#include <cstddef>
#include <limits>

#include "client/render/gl/gl.h"

namespace scree {

Image read_pixels(int width, int height) {
  std::vector<uint8_t> rgba(static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  Image image{width, height, {}};
  image.rgb.reserve(rgba.size() / 4 * 3);
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const auto at = (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * 4;
      image.rgb.insert(image.rgb.end(), {rgba[at], rgba[at + 1], rgba[at + 2]});
    }
  }
  return image;
}

// Undoes the projection: from 0..1 to metres along the view's axis.
DepthImage read_depths(const glm::mat4& projection, int width, int height) {
  std::vector<float> depths(static_cast<size_t>(width) * static_cast<size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  DepthImage image{width, height, {}};
  image.metres.reserve(depths.size());
  const float scale = projection[2][2], offset = projection[3][2];
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const float depth =
          depths[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
      image.metres.push_back(depth >= 1.0F ? std::numeric_limits<float>::infinity()
                                           : offset / (2.0F * depth - 1.0F + scale));
    }
  }
  return image;
}

}  // namespace scree
