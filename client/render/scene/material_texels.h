// Images of materials as the GPU gets them. No GL in here.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "shared/base/digest.h"

namespace scree {

/// limits::material_image_side² pixels of 4 bytes, rows from the top.
using MaterialTexels = std::vector<uint8_t>;

/// Those that have come, by the SHA-256 of their files. None is null.
using MaterialTexelSet = std::map<Digest, std::shared_ptr<const MaterialTexels>>;

/// An image of `width` × `height` pixels of 3 bytes, not empty, in that size: each texel is the mean of the
/// pixels that it covers. Any thread.
MaterialTexels resampled(std::span<const uint8_t> rgb, int width, int height);

}  // namespace scree
