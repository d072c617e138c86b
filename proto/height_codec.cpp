#include "proto/height_codec.h"

#include <algorithm>
#include <fmt/format.h>
#include <zstd.h>

#include "proto/compressed.h"
#include "proto/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr int compression_level = 9;  // tiles are packed once, and sent often
constexpr size_t planes = sizeof(int32_t);
constexpr size_t content_bytes = planes * tile_sample_count;

/// left + above − above left, mod 2^32.
uint32_t predicted(const std::array<int32_t, tile_sample_count>& heights, int x, int z) {
  const auto at = [&](int i, int j) {
    return i < 0 || j < 0 ? 0U : static_cast<uint32_t>(heights[HeightTile::index(i, j)]);
  };
  return at(x - 1, z) + at(x, z - 1) - at(x - 1, z - 1);
}

uint32_t fold(uint32_t residual) {
  return (residual << 1U) ^ (0U - (residual >> 31U));
}

uint32_t unfold(uint32_t folded) {
  return (folded >> 1U) ^ (0U - (folded & 1U));
}

Result<std::vector<uint8_t>> content_of(std::span<const uint8_t> packed) {
  if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != content_bytes)
    return fail(fmt::format("tile: the compressed heights do not declare {} bytes", content_bytes));
  const size_t frame = ZSTD_findFrameCompressedSize(packed.data(), packed.size());
  if (ZSTD_isError(frame) != 0U || frame != packed.size())
    return fail("tile: the compressed heights are cut short or followed by more");
  std::vector<uint8_t> content(content_bytes);
  const size_t got = ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0U || got != content.size())
    return fail("tile: the compressed heights are damaged");
  return content;
}

}  // namespace

std::vector<uint8_t> pack_tile(const std::vector<Digest>& children, const HeightTile& tile) {
  std::vector<uint8_t> content(content_bytes);
  for (int z = 0; z < tile_samples; ++z)
    for (int x = 0; x < tile_samples; ++x) {
      const size_t i = HeightTile::index(x, z);
      const uint32_t folded = fold(static_cast<uint32_t>(tile.heights[i]) - predicted(tile.heights, x, z));
      for (size_t plane = 0; plane < planes; ++plane)
        content[plane * tile_sample_count + i] = static_cast<uint8_t>(folded >> (8U * plane));
    }
  std::vector<uint8_t> bytes;
  for (const Digest& child : children) bytes.insert(bytes.end(), child.begin(), child.end());
  append_compressed(bytes, content, compression_level);
  CHECK(bytes.size() <= limits::tile_bytes_max);
  return bytes;
}

Result<UnpackedTile> unpack_tile(std::span<const uint8_t> bytes, TileKey key, const HeightLayout& layout) {
  UnpackedTile unpacked;
  unpacked.children.resize(layout.children(key).size());
  const size_t start = unpacked.children.size() * sizeof(Digest);
  if (bytes.size() < start || bytes.size() > limits::tile_bytes_max)
    return fail(fmt::format("tile: of {} bytes (limits.tile_bytes_max)", bytes.size()));
  for (size_t i = 0; i < unpacked.children.size(); ++i)
    std::copy_n(bytes.data() + i * sizeof(Digest), sizeof(Digest), unpacked.children[i].begin());
  const auto content = TRY(content_of(bytes.subspan(start)));
  for (int z = 0; z < tile_samples; ++z)
    for (int x = 0; x < tile_samples; ++x) {
      const size_t i = HeightTile::index(x, z);
      uint32_t folded = 0;
      for (size_t plane = 0; plane < planes; ++plane)
        folded |= static_cast<uint32_t>(content[plane * tile_sample_count + i]) << (8U * plane);
      const auto height = static_cast<int32_t>(unfold(folded) + predicted(unpacked.tile.heights, x, z));
      if (height < layout.lowest || height > layout.highest)
        return fail("tile: a height is beyond those that the model is said to have");
      unpacked.tile.heights[i] = height;
    }
  return unpacked;
}

}  // namespace scree
