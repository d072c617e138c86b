#include "content/files/png_pixels.h"

#include <png.h>
#include <vector>

#include "shared/base/text.h"

namespace scree {

namespace {

/// Bytes of libpng's words in an error; its own limit is 63.
constexpr size_t shown_bytes_max = 64;

}  // namespace

Result<void> check_pixels(std::span<const uint8_t> png) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  bool whole = png_image_begin_read_from_memory(&image, png.data(), png.size()) != 0;
  if (whole) {
    image.format = PNG_FORMAT_RGBA;
    std::vector<uint8_t> pixels(PNG_IMAGE_SIZE(image));
    whole = png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0;
  }
  const std::string words = showable(image.message, shown_bytes_max);
  png_image_free(&image);
  if (!whole) return fail("the image is damaged: " + words);
  return {};
}

}  // namespace scree
