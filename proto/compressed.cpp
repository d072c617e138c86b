#include "proto/compressed.h"

#include <zstd.h>

#include "shared/base/check.h"

namespace scree {

void append_compressed(std::vector<uint8_t>& bytes, std::span<const uint8_t> content, int level) {
  const size_t start = bytes.size();
  bytes.resize(start + ZSTD_compressBound(content.size()));
  const size_t written =
      ZSTD_compress(bytes.data() + start, bytes.size() - start, content.data(), content.size(), level);
  CHECK(ZSTD_isError(written) == 0U);
  bytes.resize(start + written);
}

}  // namespace scree
