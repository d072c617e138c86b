// The size of a picture, as --size takes it.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// Pixels.
struct PictureSize {
  int width = 1280;
  int height = 720;
};

/// "1280x720". At least one pixel, and at most limits::image_side_max, a side; the error says what is wrong
/// with the text.
Result<PictureSize> parse_size(const std::string& text);

}  // namespace scree
