#include "proto/stored_codec.h"

#include <algorithm>
#include <fmt/format.h>
#include <zstd.h>

#include "proto/compressed.h"
#include "proto/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr int compression_level = 9;  // chunks are packed once, and sent often
constexpr size_t head_bytes = 2 * chunk_brick_count;
constexpr size_t content_bytes_max = head_bytes + 2 * chunk_brick_count * brick_voxels;
enum Form : uint8_t { air = 0, rock = 1, codes = 2 };
/// With a form: each voxel has its own material, after all codes.
constexpr uint8_t each_its_own = 4;

/// Each code less the one before: distances change little along a row.
void write_codes(const Brick& brick, std::vector<uint8_t>& content) {
  uint8_t before = 0;
  for (const Code code : brick.codes) {
    content.push_back(static_cast<uint8_t>(static_cast<uint8_t>(code) - before));
    before = static_cast<uint8_t>(code);
  }
}

Result<Brick> read_codes(std::span<const uint8_t> content) {
  Brick brick;
  uint8_t before = 0;
  for (size_t i = 0; i < brick.codes.size(); ++i) {
    before = static_cast<uint8_t>(before + content[i]);
    brick.codes[i] = static_cast<Code>(before);
    if (brick.codes[i] == Code{-128}) return fail("stored chunk: a code is -128, beyond ±127");
  }
  return brick;
}

std::vector<uint8_t> content_of(const GeneratedChunk& chunk) {
  std::vector<uint8_t> content;
  for (size_t i = 0; i < chunk_brick_count; ++i) {
    const Brick* uniform = uniform_equivalent(*chunk.bricks[i]);
    const Form form = uniform == nullptr ? codes : (uniform == &air_brick() ? air : rock);
    const bool one = chunk.materials(static_cast<int>(i)).is_uniform();
    content.push_back(static_cast<uint8_t>(one ? form : form | each_its_own));
  }
  for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
    const BrickMaterials materials = chunk.materials(i);
    content.push_back(materials.is_uniform() ? materials.uniform() : ground_own);
  }
  for (const Brick* brick : chunk.bricks)
    if (uniform_equivalent(*brick) == nullptr) write_codes(*brick, content);
  for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
    if (chunk.materials(i).is_uniform()) continue;
    const VoxelMaterials voxels = chunk.materials(i).unpacked();
    content.insert(content.end(), voxels.begin(), voxels.end());
  }
  return content;
}

Result<std::vector<uint8_t>> decompressed(std::span<const uint8_t> packed) {
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size < head_bytes || size > content_bytes_max)  // also what declares none
    return fail("stored chunk: the compressed bricks do not declare their size");
  const size_t frame = ZSTD_findFrameCompressedSize(packed.data(), packed.size());
  if (ZSTD_isError(frame) != 0U || frame != packed.size())
    return fail("stored chunk: the compressed bricks are cut short or followed by more");
  std::vector<uint8_t> content(size);
  const size_t got = ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0U || got != content.size())
    return fail("stored chunk: the compressed bricks are damaged");
  return content;
}

/// The bricks' materials; those of single voxels begin at `next`, and are the last of the content.
Result<ChunkMaterials> materials_of(std::span<const uint8_t> content, size_t next) {
  ChunkMaterials materials;
  for (size_t i = 0; i < chunk_brick_count; ++i) {
    const VoxelMaterial one = content[chunk_brick_count + i];
    if ((content[i] & each_its_own) == 0) {
      materials[i] = BrickMaterials(one);
      continue;
    }
    if (one != ground_own) return fail("stored chunk: a brick has one material, and each voxel its own");
    if (content.size() - next < brick_voxels) return fail("stored chunk: a brick's materials are missing");
    VoxelMaterials voxels;
    std::ranges::copy(content.subspan(next, brick_voxels), voxels.begin());
    materials[i] = BrickMaterials(voxels);
    if (materials[i].is_uniform())
      return fail("stored chunk: voxels with materials of their own are all of one");
    next += brick_voxels;
  }
  if (next != content.size()) return fail("stored chunk: more codes or materials than bricks");
  return materials;
}

Result<GeneratedChunk> chunk_of_content(std::span<const uint8_t> content) {
  std::array<Brick, chunk_brick_count> bricks;
  size_t next = head_bytes;
  for (size_t i = 0; i < chunk_brick_count; ++i) {
    const int form = content[i] & ~each_its_own;
    if (form > codes) return fail("stored chunk: a brick is of an unknown kind");
    if (form != codes) {
      bricks[i] = form == air ? air_brick() : solid_brick();
      continue;
    }
    if (content.size() - next < brick_voxels) return fail("stored chunk: a brick's codes are missing");
    const auto brick = TRY(read_codes(content.subspan(next, brick_voxels)));
    bricks[i] = brick;
    next += brick_voxels;
  }
  GeneratedChunk chunk = chunk_of_bricks(bricks);
  const auto materials = TRY(materials_of(content, next));
  chunk.stored_materials = stored_materials_of(materials);
  return chunk;
}

}  // namespace

std::vector<uint8_t> pack_chunk(TileKey key, const BrickLayout& layout, const ChunkChildren& children,
                                const GeneratedChunk* chunk) {
  CHECK(layout.holds(key) && (chunk == nullptr) == (key == layout.root()));
  std::vector<uint8_t> bytes;
  if (key.level > 0) {
    bytes.push_back(0);
    for (size_t i = 0; i < children.size(); ++i) {
      if (!children[i]) continue;
      bytes.front() = static_cast<uint8_t>(bytes.front() | (1U << i));
      bytes.insert(bytes.end(), children[i]->begin(), children[i]->end());
    }
  }
  if (chunk == nullptr) return bytes;
  const std::vector<uint8_t> content = content_of(*chunk);
  append_compressed(bytes, content, compression_level);
  CHECK(bytes.size() <= limits::tile_bytes_max);
  return bytes;
}

Result<UnpackedChunk> unpack_chunk(std::span<const uint8_t> bytes, TileKey key, const BrickLayout& layout) {
  if (bytes.size() > limits::tile_bytes_max)
    return fail(fmt::format("stored chunk: of {} bytes (limits.tile_bytes_max)", bytes.size()));
  UnpackedChunk unpacked;
  if (key.level > 0) {
    if (bytes.empty()) return fail("stored chunk: it is empty");
    const uint8_t mask = bytes.front();
    bytes = bytes.subspan(1);
    const std::array<TileKey, 8> places = layout.children(key);
    for (size_t i = 0; i < places.size(); ++i) {
      if (((mask >> i) & 1U) == 0) continue;
      if (!layout.holds(places[i])) return fail("stored chunk: it names one outside of the layout");
      if (bytes.size() < sizeof(Digest)) return fail("stored chunk: the hashes are cut short");
      std::copy_n(bytes.begin(), sizeof(Digest), unpacked.children[i].emplace().begin());
      bytes = bytes.subspan(sizeof(Digest));
    }
  }
  if (key == layout.root()) {
    if (!bytes.empty()) return fail("stored chunk: the root is followed by more");
    unpacked.chunk = uniform_chunk(air_brick());
    return unpacked;
  }
  const auto content = TRY(decompressed(bytes));
  auto chunk = TRY(chunk_of_content(content));
  unpacked.chunk = std::move(chunk);
  return unpacked;
}

}  // namespace scree
