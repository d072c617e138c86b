// Images as files.
#pragma once

#include <string>

#include "client/render/renderer.h"

namespace scree {

/// Writes beside the file and renames, so that nobody ever reads half an image.
Result<void> write_png(const std::string& file, const Image& image);

}  // namespace scree
