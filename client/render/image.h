// Pictures and depths that were drawn, and how they are read back. Reading needs the GL context current.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <vector>

namespace scree {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;  ///< rows from the top, 3 bytes a pixel
};

/// Distances of the drawn surfaces.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> metres;  ///< rows from the top, along the camera's forward(); infinity: sky
};

/// Reads the framebuffer that is bound.
Image read_pixels(int width, int height);
/// Likewise, of what was drawn by that projection of a perspective.
DepthImage read_depths(const glm::mat4& projection, int width, int height);

}  // namespace scree
