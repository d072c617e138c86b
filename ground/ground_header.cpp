#include "ground/ground_header.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

#include "crypto/sha256.h"
#include "proto/byte_stream.h"
#include "proto/palette_codec.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr uint64_t file_kind = 0x444E'4745'4552'4353ULL;  // "SCREEGND"
constexpr uint32_t newest_format = 2;

/// All that makes the ground what it is.
std::vector<uint8_t> fields_of(const GroundHeader& header) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  const HeightLayout& layout = header.ground.layout;
  writer.u64(file_kind);
  writer.u32(header.format);
  writer.u32(static_cast<uint32_t>(layout.columns));
  writer.u32(static_cast<uint32_t>(layout.rows));
  writer.f32(layout.cell_m);
  writer.u32(static_cast<uint32_t>(layout.lowest));
  writer.u32(static_cast<uint32_t>(layout.highest));
  writer.f32(layout.layers.soil_below_m);
  writer.f32(layout.layers.ice_above_m);
  writer.f32(header.zero_m);
  bytes.insert(bytes.end(), header.ground.top.begin(), header.ground.top.end());
  const BrickGround bricks = header.ground.bricks.value_or(BrickGround{});
  writer.u32(header.ground.bricks ? 1 : 0);
  writer.f32(bricks.layout.voxel_size_m);
  for (const ChunkCoord corner : {bricks.layout.lo, bricks.layout.hi})
    for (const int32_t number : {corner.x, corner.y, corner.z}) writer.u32(static_cast<uint32_t>(number));
  bytes.insert(bytes.end(), bricks.root.begin(), bricks.root.end());
  if (header.format == 1) return bytes;
  writer.u32(header.palette_bytes);
  bytes.insert(bytes.end(), header.palette.begin(), header.palette.end());
  return bytes;
}

Digest read_digest(ByteReader& reader, const char* what) {
  Digest digest{};
  const std::span<const uint8_t> bytes = reader.read_bytes(sizeof(Digest), what);
  if (bytes.size() == digest.size()) std::ranges::copy(bytes, digest.begin());
  return digest;
}

std::optional<BrickGround> read_bricks(ByteReader& reader) {
  const uint32_t number = reader.u32("whether chunks are stored");
  const bool any = number == 1;
  if (number > 1) reader.refuse(fmt::format("whether chunks are stored is {}", number));
  BrickGround bricks;
  bricks.layout.voxel_size_m = reader.f32("voxels of the stored chunks");
  for (ChunkCoord* corner : {&bricks.layout.lo, &bricks.layout.hi})
    for (int32_t* number : {&corner->x, &corner->y, &corner->z})
      *number = std::bit_cast<int32_t>(reader.u32("box of the stored chunks"));
  bricks.root = read_digest(reader, "hash of the stored chunks");
  if (!any && bricks != BrickGround{}) reader.refuse("stored chunks of which there are none");
  return any ? std::optional(bricks) : std::nullopt;
}

Result<void> read_palette_name(ByteReader& reader, GroundHeader& header) {
  header.palette_bytes = reader.u32("bytes of the palette");
  header.palette = read_digest(reader, "hash of the palette");
  if (header.palette_bytes > palette_bytes_max)
    return fail(fmt::format("its palette has {} bytes, more than {} (palette_bytes_max)",
                            header.palette_bytes, palette_bytes_max));
  return {};
}

}  // namespace

std::vector<uint8_t> encode(const GroundHeader& header) {
  std::vector<uint8_t> bytes = fields_of(header);
  const Digest name = name_of(header);
  bytes.insert(bytes.end(), name.begin(), name.end());
  ByteWriter(bytes).u64(header.index_begins);
  ByteWriter(bytes).u64(header.chunk_index_begins);
  CHECK(bytes.size() <= header_bytes);
  bytes.resize(header_bytes);
  return bytes;
}

Result<GroundHeader> decode_header(std::span<const uint8_t> bytes) {
  if (bytes.size() < header_bytes) return fail("it is too short for a ground file");
  ByteReader reader(bytes.first(header_bytes), "the header");
  if (reader.u64("kind") != file_kind) return fail("it is not a ground file: scree import makes one");
  GroundHeader header;
  header.format = reader.u32("format");
  if (header.format < 1 || header.format > newest_format)
    return fail(fmt::format("it is a ground file of format {}, this program reads formats 1 to {}",
                            header.format, newest_format));
  HeightLayout& layout = header.ground.layout;
  layout.columns = std::bit_cast<int32_t>(reader.u32("columns"));
  layout.rows = std::bit_cast<int32_t>(reader.u32("rows"));
  layout.cell_m = reader.f32("cell");
  layout.lowest = std::bit_cast<int32_t>(reader.u32("lowest"));
  layout.highest = std::bit_cast<int32_t>(reader.u32("highest"));
  layout.layers.soil_below_m = reader.f32("soil below");
  layout.layers.ice_above_m = reader.f32("ice above");
  header.zero_m = reader.f32("zero");
  header.ground.top = read_digest(reader, "hash");
  header.ground.bricks = read_bricks(reader);
  if (header.format > 1) TRY(read_palette_name(reader, header));
  const Digest name = read_digest(reader, "name");
  header.index_begins = reader.u64("index");
  header.chunk_index_begins = reader.u64("index of stored chunks");
  if (reader.failed()) return tl::unexpected(reader.error());
  if (name != name_of(header)) return fail("it is damaged: its header does not have its hash");
  TRY(validate(layout));
  if (header.ground.bricks) TRY(validate(header.ground.bricks->layout));
  return header;
}

Digest name_of(const GroundHeader& header) {
  return sha256(fields_of(header));
}

size_t index_of(const HeightLayout& layout, TileKey key) {
  size_t index = 0;
  for (int level = 0; level < key.level; ++level)
    index += static_cast<size_t>(HeightLayout::tiles_on(level, layout.columns)) *
             static_cast<size_t>(HeightLayout::tiles_on(level, layout.rows));
  return index +
         static_cast<size_t>(key.z) * static_cast<size_t>(HeightLayout::tiles_on(key.level, layout.columns)) +
         static_cast<size_t>(key.x);
}

}  // namespace scree
