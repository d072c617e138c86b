// zstd, as all that is packed for the wire and for files takes it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scree {

/// Appends one zstd frame of the content. `level`: zstd's own; higher is smaller and takes longer.
void append_compressed(std::vector<uint8_t>& bytes, std::span<const uint8_t> content, int level);

}  // namespace scree
