// Whether a PNG can be decoded to its last pixel. libpng's home on the server's side. Any thread.
#pragma once

#include <cstdint>
#include <span>

#include "shared/base/result.h"

namespace scree {

/// Decodes an image that check_image() let through, and forgets its pixels: up to 64 MiB for that time. The
/// error says that it is damaged, and how. Bytes after the end of the PNG are no damage.
Result<void> check_pixels(std::span<const uint8_t> png);

}  // namespace scree
