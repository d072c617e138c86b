// Images as files.
#pragma once

#include <span>
#include <string>

#include "client/render/renderer.h"

namespace scree {

/// Writes a temporary file and renames it, so that no reader gets half an image.
Result<void> write_png(const std::string& file, const Image& image);

/// The picture of that frame in a folder: 000000.png is the first.
Result<void> write_frame(const std::string& folder, size_t frame, const Image& image);

/// Reads a picture of at most limits::image_side_max pixels a side; transparency is lost.
Result<Image> read_png(const std::string& file);

/// The same of the bytes of a file.
Result<Image> decode_png(std::span<const uint8_t> bytes);

}  // namespace scree
