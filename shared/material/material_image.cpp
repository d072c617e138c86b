#include "shared/material/material_image.h"

#include <algorithm>
#include <array>
#include <string>

namespace scree {

namespace {

/// The signature, then the length and the name of the first chunk.
constexpr std::array<uint8_t, 16> png_begins{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n',
                                             0,    0,   0,   13,  'I',  'H',  'D',  'R'};
constexpr size_t png_header_bytes = png_begins.size() + 13;

uint32_t big_endian(std::span<const uint8_t> bytes) {
  return uint32_t{bytes[0]} << 24U | uint32_t{bytes[1]} << 16U | uint32_t{bytes[2]} << 8U | bytes[3];
}

}  // namespace

Result<ImageSize> check_image(std::span<const uint8_t> bytes) {
  if (bytes.size() > limits::image_bytes_max)
    return fail("the image has " + std::to_string((bytes.size() + 1023) >> 10U) + " KiB, over the limit of " +
                std::to_string(limits::image_bytes_max >> 10U) + " KiB");
  if (bytes.size() < png_header_bytes ||
      !std::ranges::equal(bytes.first(png_begins.size()), std::span(png_begins)))
    return fail("the image is no PNG");
  const ImageSize size{big_endian(bytes.subspan(png_begins.size(), 4)),
                       big_endian(bytes.subspan(png_begins.size() + 4, 4))};
  if (size.width == 0 || size.height == 0) return fail("the image is a PNG without pixels");
  if (size.width > limits::image_side_max || size.height > limits::image_side_max)
    return fail("the image has " + std::to_string(size.width) + " × " + std::to_string(size.height) +
                " pixels, over the limit of " + std::to_string(limits::image_side_max) + " × " +
                std::to_string(limits::image_side_max));
  return size;
}

}  // namespace scree
