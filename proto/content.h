// Messages about content, which is bytes that their SHA-256 names: the palette and its images
// (proto/content.proto).
#pragma once

#include <cstdint>
#include <vector>

#include "shared/base/digest.h"

namespace scree {

/// Asks for bytes by their digests.
struct AskContentMessage {
  std::vector<Digest> wanted;
};

/// The next part of what was asked for.
struct ContentMessage {
  Digest digest{};
  uint32_t total = 0;  ///< bytes of the whole; 0: the server does not have it
  uint32_t offset = 0;
  std::vector<uint8_t> part{};
};

/// The world's palette is another one than before.
struct PaletteChangedMessage {
  Digest palette{};
};

}  // namespace scree
