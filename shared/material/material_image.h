// Images of materials, as the bytes of PNG files: what server and client check before anything decodes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shared/base/result.h"

namespace scree {

namespace limits {

/// Bytes of an image's file, and pixels along a side: 4,096 pixels over a metre are a quarter of a millimetre
/// each, and decoded they take 64 MiB. Above: refused, before they are read or decoded.
inline constexpr size_t image_bytes_max = size_t{4} << 20;
inline constexpr uint32_t image_side_max = 4096;

/// Bytes of all images of a palette: every client fetches them. Above: refused.
inline constexpr size_t palette_images_bytes_max = size_t{64} << 20;

}  // namespace limits

struct ImageSize {
  uint32_t width = 0;
  uint32_t height = 0;

  bool operator==(const ImageSize&) const = default;
};

/// Reads the header of a PNG (ISO/IEC 15948, 5.2 and 11.2.2). Refuses other files and images beyond the
/// limits. The rest of the file may be damaged all the same: only a decoder knows. Any thread.
Result<ImageSize> check_image(std::span<const uint8_t> bytes);

}  // namespace scree
